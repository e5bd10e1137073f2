"""The equirectangular panorama: Blender's EQUIRECTANGULAR, longitude and latitude on a square grid.

Formula: the frame spans longitude_min .. longitude_max and latitude_min .. latitude_max; shift moves it by fractions of
the whole and may bring rows beyond a pole, which look over it at what other rows see, too.
Singular: the poles, each a whole row; the seam, half a turn from the frame's middle, where the column jumps.
Reference: Blender manual, Cameras > Panoramic; Snyder (1987), chapter 12; rays read out of Cycles.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np

from ..records import BlenderCamera, Raster
from .parts.meridians import Meridians
from .parts.settings import span
from .parts.silhouette import EVERYWHERE


@dataclass(frozen=True)
class Equirectangular(Meridians):
    """Height is latitude, rad."""

    key = "EQUIRECTANGULAR"

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Equirectangular:
        """Build it from the ranges and the shift; InputError for an empty range and a latitude beyond the poles."""
        longitudes = span(raw, "longitude_min", "longitude_max")
        latitudes = span(raw, "latitude_min", "latitude_max", -pi / 2, pi / 2, "deg")
        return cls.over_frame(raw, raster, longitudes, latitudes)

    def latitude(self, height):
        """See Meridians."""
        return np.cos(height), np.sin(height)

    def height(self, cosine, sine):
        """See Meridians; between the poles, though rows may lie beyond."""
        return np.arctan2(sine, cosine)

    def bounds(self, centers, radii):
        """See Meridians; everywhere in a frame that looks over a pole."""
        bounds = super().bounds(centers, radii)
        farthest_row = max(-self.extent[2], self.extent[3]) - abs(self.window.pitch_y) / 2
        return np.tile((*EVERYWHERE, *EVERYWHERE), (len(bounds), 1)) if farthest_row > pi / 2 else bounds
