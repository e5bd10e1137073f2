"""The stereographic panorama: all directions in one picture without a rim. Centered on the ground, a "little planet".

Assumption: circles are round, whatever the pixel aspect; the lens is turned up by ``elevation`` from the viewing
direction. At -90 degrees the ground is in the middle and the front on top; at 90 degrees the sky is in the middle and
the front at the bottom.
Formula: tan(theta / 2) = r tan(fov / 4) with r = 1 at the nearer sides of the frame; every pixel has a ray.
Singular: the point opposite to the lens's axis, whose image is infinitely far out.
Reference: Snyder (1987), chapter 21; D. German et al., Flattening the Viewable Sphere (2007).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, pi

from ..maths.recording import tan
from ..records import BlenderCamera, Raster
from .fisheye_stereographic import WIDEST, FisheyeStereographic
from .model import IN_RAYS, Step
from .parts.film import SHIFT, Window
from .parts.pitched import LENS_RAY, PITCH, Pitched
from .parts.radial import FOV, ROUND_PLANE
from .parts.settings import Number

ELEVATION = Number(
    "elevation", "Elevation", "Elevation of the picture's center; -90 degrees looks down and shows a little planet",
    -pi / 2, -pi / 2, pi / 2, "angle", 4,
)  # fmt: skip


@dataclass(frozen=True)
class StereographicPanorama(Pitched, FisheyeStereographic):
    """A stereographic fisheye without a rim, pitched."""

    key = "STEREOGRAPHIC_PANORAMA"
    label = "Panorama Stereographic"
    description = "All directions; looking down, it shows a little planet"
    group = "Panorama"
    number = 9
    polynomials = IN_RAYS
    SETTINGS = (FOV, ELEVATION, *SHIFT)
    FORMULA = (
        ROUND_PLANE,
        Step("Angle from the axis", "theta = 2 atan(rho tan(fov / 4)), rho = sqrt(a² + b²)"),
        LENS_RAY,
        PITCH,
        Step("Elevation of the axis", "e = elevation"),
    )

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> StereographicPanorama:
        window = Window.inscribed_circle(raw, raster, tan(FOV.read(raw, high=WIDEST) / 4))
        return cls(raster.size, window, rim=inf, elevation=ELEVATION.read(raw))
