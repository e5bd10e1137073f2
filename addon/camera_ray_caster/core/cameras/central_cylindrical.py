"""The central cylindrical panorama: Blender's CENTRAL_CYLINDRICAL, the world seen from the middle of a tube.

Formula: the frame spans the longitudes u_min .. u_max and the heights v_min .. v_max on a tube of the given radius;
with h = height / radius the direction is (sin lon, h, -cos lon) / sqrt(1 + h^2). Vertical lines stay straight.
Singular: straight up and down, which no row reaches.
Reference: Blender manual, Cameras > Panoramic; Snyder (1987), page 105; rays read out of Cycles.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..records import BlenderCamera, Raster
from .parts.meridians import Meridians
from .parts.settings import positive, span


@dataclass(frozen=True)
class CentralCylindrical(Meridians):
    """Height is the tangent of the latitude."""

    key = "CENTRAL_CYLINDRICAL"

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> CentralCylindrical:
        """Build it from the ranges, the radius and the shift; InputError for an empty range or a radius of 0."""
        prefix = "central_cylindrical_"
        radius = positive(raw, prefix + "radius")
        low, high = span(raw, prefix + "range_v_min", prefix + "range_v_max")
        longitudes = span(raw, prefix + "range_u_min", prefix + "range_u_max")
        return cls.over_frame(raw, raster, longitudes, (low / radius, high / radius))

    def latitude(self, height):
        """See Meridians."""
        cosine = 1 / np.hypot(1.0, height)
        return cosine, height * cosine

    def height(self, cosine, sine):
        """See Meridians; NaN straight up and down."""
        return np.where(cosine > 0, sine / np.where(cosine > 0, cosine, 1.0), np.nan)
