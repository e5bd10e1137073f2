"""The stereographic panorama: all around in one picture without a rim. Centerd on the ground it is a "little planet".

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
from .parts.film import Window
from .parts.pitched import Pitched
from .parts.settings import number, positive


@dataclass(frozen=True)
class StereographicPanorama(Pitched, FisheyeStereographic):
    """A stereographic fisheye without a rim, pitched."""

    key = "STEREOGRAPHIC_PANORAMA"

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> StereographicPanorama:
        """Build it from ``fov``, ``elevation`` and shift; InputError for an angle without meaning."""
        window = Window.inscribed_circle(raw, raster, tan(positive(raw, "fov", WIDEST, "deg") / 4))
        return cls(window, rim=inf, elevation=number(raw, "elevation", -pi / 2, pi / 2, "deg"))
