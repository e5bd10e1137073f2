"""The stereographic panorama: all around in one picture without a rim. Centered on the ground it is a "little planet".

Assumption: round pixels; the lens looks ``elevation`` above the viewing direction: at -90 degrees the ground lies in
the middle and the front on top, at 90 degrees the sky and the front at the bottom.
Formula: tan(theta / 2) = r tan(fov / 4) with r = 1 at the nearer sides of the frame; every pixel has a ray.
Singular: the point opposite to the lens's axis, which lies infinitely far out.
Reference: Snyder (1987), chapter 21; D. German et al., Flattening the Viewable Sphere (2007).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, pi, tan

from ..records import BlenderCamera, Raster
from .fisheye_stereographic import WIDEST, FisheyeStereographic
from .model import Step
from .parts.film import SHIFT, Window
from .parts.pitched import PITCH, Pitched
from .parts.radial import FOV, RAY, ROUND_PLANE
from .parts.settings import Number

ELEVATION = Number(
    "elevation", "Elevation", "Of the picture's center: -90 degrees is the ground, a little planet",
    -pi / 2, -pi / 2, pi / 2, "angle", 4,
)  # fmt: skip


@dataclass(frozen=True)
class StereographicPanorama(Pitched, FisheyeStereographic):
    """A stereographic fisheye without a rim, pitched."""

    key = "STEREOGRAPHIC_PANORAMA"
    label = "Panorama Stereographic"
    description = "All around; looking down, a little planet"
    group = "Panorama"
    number = 9
    by_polynomials = True
    SETTINGS = (FOV, ELEVATION, *SHIFT)
    FORMULA = (
        ROUND_PLANE,
        Step("Angle from the axis", "theta = 2 atan(r tan(fov / 4)), r = sqrt(a² + b²)"),
        RAY,
        PITCH,
    )

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> StereographicPanorama:
        """Build it from ``fov``, ``elevation`` and shift; InputError for an angle without meaning."""
        window = Window.inscribed_circle(raw, raster, tan(FOV.read(raw, high=WIDEST) / 4))
        return cls(raster.size, window, rim=inf, elevation=ELEVATION.read(raw))
