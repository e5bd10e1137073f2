"""Passes of scenes that were read at one frame only."""

from camera_ray_caster.core.casting.flow import FRAMES
from camera_ray_caster.core.casting.passes import PASSES

STILL = tuple(name for name in PASSES if name not in FRAMES)
"""Those that look into no other frame."""
