"""Passes of scenes that were read at one frame only."""

from camera_ray_caster.core.casting.pass_needs import WITHOUT_PIXEL
from camera_ray_caster.core.casting.passes import PASSES

STILL = tuple(name for name, declared in PASSES.items() if not declared.frames)
"""Those that look into no other frame."""


def passes_of(model, passes=tuple(PASSES)):
    """Those of some passes that a model has: single beams have neither areas nor flow."""
    return passes if model.differentiable else tuple(name for name in passes if name not in WITHOUT_PIXEL)
