"""The cylindrical panorama over chosen angles, as stitched photographs have it.

Formula: longitudes from ``pan_min`` to ``pan_max`` across, up to whole turns and more; up, the tangent of the latitude,
from that of ``latitude_bottom`` to that of ``latitude_top``: vertical lines stay straight, and so does the horizon.
Singular: straight up and down, which no row reaches.
Reference: Snyder (1987), page 105; R. Szeliski, Image Alignment and Stitching (2006), section 2.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import radians, tan

from ..records import BlenderCamera, Raster
from .central_cylindrical import CentralCylindrical
from .parts.settings import span

STEEPEST = radians(89)


@dataclass(frozen=True)
class Cylindrical(CentralCylindrical):
    """Height is the tangent of the latitude."""

    key = "CYLINDRICAL"

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Cylindrical:
        """Build it from the angles and shift; InputError where they are equal or too steep."""
        low, high = span(raw, "latitude_bottom", "latitude_top", -STEEPEST, STEEPEST, "deg")
        return cls.over_frame(raw, raster, span(raw, "pan_min", "pan_max", unit="deg"), (tan(low), tan(high)))
