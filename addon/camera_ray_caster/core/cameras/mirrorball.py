"""The mirror ball: Blender's MIRRORBALL, the picture that a parallel camera takes of a small chrome sphere.

Assumption: the sphere's picture is stretched to the frame. Each ray is a reflected ray of a parallel camera that stands
ahead in the viewing direction and looks back at the sphere.
Formula: theta = 2 asin(r) with r = 1 at the rim: an equisolid fisheye of 360 degrees over an ellipse.
Singular: the rim, which shows the one point straight behind the eye.
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
    description = "All directions, as reflected by a small chrome sphere"
    SETTINGS = SHIFT
    FORMULA = (WHOLE_PLANE, RADIUS, Step("Angle from the axis", "theta = 2 asin(rho)"), RAY)

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Mirrorball:
        return cls(raster.size, Window.over_frame(raw, raster, (-1.0, 1.0), (-1.0, 1.0)), 1.0)

    def aperture(self, raw: BlenderCamera, pose: Pose) -> Aperture | None:
        """Return the thin lens in the mirrored space that Cycles uses for this panorama alone."""
        lens = super().aperture(raw, pose)
        return lens and replace(lens, rotation=-lens.rotation, axis=SIDEWAYS)
