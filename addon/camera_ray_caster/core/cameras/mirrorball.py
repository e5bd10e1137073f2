"""The mirror ball: Blender's MIRRORBALL, the picture that a parallel camera takes of a small chrome sphere.

Assumption: the sphere fills the frame, squeezed to it; each ray is the one that leaves the sphere after its reflection,
with the camera looking from where the viewing direction points to.
Formula: theta = 2 asin(r) with r = 1 at the rim: an equisolid fisheye of 360 degrees over an ellipse.
Singular: the rim, all of which is the point straight behind the eye.
Reference: P. Debevec, Rendering Synthetic Objects into Real Scenes (1998); rays read out of Cycles.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from ..records import BlenderCamera, Pose, Raster
from .fisheye_equisolid import FisheyeEquisolid
from .model import Step
from .parts.aperture import SIDEWAYS, Aperture
from .parts.film import SHIFT, Window
from .parts.radial import RADIUS, RAY, WHOLE_PLANE


@dataclass(frozen=True)
class Mirrorball(FisheyeEquisolid):
    """An equisolid fisheye over the whole frame."""

    key = "MIRRORBALL"
    label = "Mirror Ball"
    description = "All around, as a small chrome sphere shows it"
    SETTINGS = SHIFT
    FORMULA = (WHOLE_PLANE, RADIUS, Step("Angle from the axis", "theta = 2 asin(r)"), RAY)

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Mirrorball:
        """Build it from the shift alone."""
        return cls(raster.size, Window.over_frame(raw, raster, (-1.0, 1.0), (-1.0, 1.0)), 1.0)

    def aperture(self, raw: BlenderCamera, pose: Pose) -> Aperture | None:
        """Return the thin lens as Cycles has it for this one panorama: in a mirrored space of its own."""
        lens = super().aperture(raw, pose)
        return lens and replace(lens, rotation=-lens.rotation, axis=SIDEWAYS)
