"""The cylindrical panorama over chosen angles, as stitched photographs have it.

Formula: longitudes from ``pan_min`` to ``pan_max`` across, up to whole turns and more; up, the tangent of the latitude,
from that of ``latitude_bottom`` to that of ``latitude_top``: vertical lines stay straight, and so does the horizon.
Singular: straight up and down, which no row reaches.
Reference: Snyder (1987), page 105; R. Szeliski, Image Alignment and Stitching (2006), section 2.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, radians, tan

from ..records import BlenderCamera, Raster
from .central_cylindrical import CentralCylindrical
from .model import Step
from .parts.film import SHIFT
from .parts.meridians import RAY, longitude
from .parts.settings import Number, span

STEEPEST, WIDEST = radians(89), 10 * pi
PAN = (
    Number("pan_min", "Pan Min", "Longitude of the picture's left edge, 0 is ahead", -pi, -WIDEST, WIDEST, "angle", 4),
    Number("pan_max", "Max", "Longitude of the picture's right edge, 0 is ahead", pi, -WIDEST, WIDEST, "angle", 4),
)
LATITUDES = (
    Number(
        "latitude_bottom", "Latitude Bottom", "Of the picture's lower edge", -pi / 4, -STEEPEST, STEEPEST, "angle", 4
    ),
    Number("latitude_top", "Top", "Of the picture's upper edge", pi / 4, -STEEPEST, STEEPEST, "angle", 4),
)


@dataclass(frozen=True)
class Cylindrical(CentralCylindrical):
    """Height is the tangent of the latitude."""

    key = "CYLINDRICAL"
    label = "Panorama Cylindrical"
    description = "Over chosen angles; vertical lines and the horizon stay straight"
    group = "Panorama"
    number = 8
    SETTINGS = (*PAN, *LATITUDES, *SHIFT)
    FORMULA = (
        longitude("pan_min", "pan_max"),
        Step("Tangent of the latitude", "h = tan(bottom) + (y/H + shift_y) (tan(top) - tan(bottom))"),
        Step("Latitude", "lat = atan(h)"),
        RAY,
    )

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Cylindrical:
        """Build it from the angles and shift; InputError where they are equal or too steep."""
        low, high = span(raw, *LATITUDES)
        return cls.over_frame(raw, raster, span(raw, *PAN), (tan(low), tan(high)))
