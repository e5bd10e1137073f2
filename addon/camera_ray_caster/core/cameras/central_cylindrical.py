"""The central cylindrical panorama: Blender's CENTRAL_CYLINDRICAL, the world seen from the middle of a tube.

Formula: the frame spans the longitudes u_min .. u_max and the heights v_min .. v_max on a tube of the given radius.
With h = height / radius, the direction is (sin lon, h, -cos lon) / sqrt(1 + h^2). Vertical lines stay straight.
Singular: the directions straight up and down, which no row reaches.
Reference: Blender manual, Cameras > Panoramic; Snyder (1987), page 105; rays read out of Cycles.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..records import BlenderCamera, Raster
from .model import Step
from .parts.film import SHIFT
from .parts.meridians import RAY, Meridians, longitude, longitudes
from .parts.settings import ABOVE_ZERO, CAMERA, Number, span

PREFIX = "central_cylindrical_"
LONGITUDES = longitudes(PREFIX + "range_u_")
HEIGHTS = tuple(
    Number(
        PREFIX + f"range_v_{end}", label, f"Height of the frame's {side} edge on the cylinder", low, unit="length",
        owner=CAMERA, partner=PREFIX + f"range_v_{other}",
    )
    for end, other, label, side, low in (
        ("min", "max", "Min Height", "lower", -1.0),
        ("max", "min", "Max Height", "upper", 1.0),
    )
)  # fmt: skip
TUBE = Number(
    PREFIX + "radius", "Cylinder Radius", "Radius of the cylinder", 1.0, ABOVE_ZERO, unit="length", owner=CAMERA
)


@dataclass(frozen=True)
class CentralCylindrical(Meridians):
    """A panorama whose height on the image plane is the tangent of the latitude."""

    key = "CENTRAL_CYLINDRICAL"
    label = "Central Cylindrical"
    description = "The world seen from the center of a cylinder: vertical lines stay straight"
    group = "Blender's Own"
    SETTINGS = (*LONGITUDES, *HEIGHTS, TUBE, *SHIFT)
    FORMULA = (
        longitude("u_min", "u_max"),
        Step("Height on the cylinder over its radius", "h = (v_min + (y/H + shift_y) (v_max - v_min)) / radius"),
        Step("Latitude", "lat = atan(h)"),
        RAY,
    )

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> CentralCylindrical:
        """Build the camera from ranges, radius and shift. Raises InputError for an empty range or a radius of 0."""
        radius, (low, high) = TUBE.read(raw), span(raw, *HEIGHTS)
        return cls.over_frame(raw, raster, span(raw, *LONGITUDES), (low / radius, high / radius))

    def latitude(self, height):
        cosine = 1 / np.hypot(1.0, height)
        return cosine, height * cosine

    def height(self, cosine, sine):
        """See Meridians; NaN straight up and down."""
        return np.where(cosine > 0, sine / np.where(cosine > 0, cosine, 1.0), np.nan)
