"""The mirror ball: Blender's MIRRORBALL, the picture that a parallel camera takes of a small chrome sphere.

Assumption: the sphere fills the frame, squeezed to it; each ray is the one that leaves the sphere after its reflection,
with the camera looking from where the viewing direction points to.
Formula: theta = 2 asin(r) with r = 1 at the rim: an equisolid fisheye of 360 degrees over an ellipse.
Singular: the rim, all of which is the point straight behind the eye.
Reference: P. Debevec, Rendering Synthetic Objects into Real Scenes (1998); rays read out of Cycles.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..records import BlenderCamera, Raster
from .fisheye_equisolid import FisheyeEquisolid
from .parts.film import Window


@dataclass(frozen=True)
class Mirrorball(FisheyeEquisolid):
    """An equisolid fisheye over the whole frame."""

    key = "MIRRORBALL"

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Mirrorball:
        """Build it from the shift alone."""
        return cls(Window.over_frame(raw, raster, (-1.0, 1.0), (-1.0, 1.0)), 1.0)
