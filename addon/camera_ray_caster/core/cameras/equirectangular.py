"""The equirectangular panorama: Blender's EQUIRECTANGULAR, longitude and latitude on a square grid.

Formula: the frame spans longitude_min .. longitude_max and latitude_min .. latitude_max. Shift moves it by fractions of
its size. It may bring rows beyond a pole; these look over the pole at points that other rows see, too.
Singular: the poles, each a whole row; the seam, half a turn from the frame's middle, where the column jumps.
Reference: Blender manual, Cameras > Panoramic; Snyder (1987), chapter 12; rays read out of Cycles.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np

from ..records import BlenderCamera, Raster
from .model import Step
from .parts.film import SHIFT
from .parts.meridians import RAY, Meridians, longitude, longitudes
from .parts.settings import CAMERA, Number, span
from .parts.silhouette import PIXEL_MARGIN, everywhere, longitude_latitude

LONGITUDES = longitudes("longitude_")
LATITUDES = tuple(
    Number(
        f"latitude_{end}", label, f"Latitude of the frame's {side} edge", default, -pi / 2, pi / 2, "angle",
        owner=CAMERA,
    )
    for end, label, side, default in (
        ("min", "Min Latitude", "lower", -pi / 2),
        ("max", "Max Latitude", "upper", pi / 2),
    )
)  # fmt: skip


@dataclass(frozen=True)
class Equirectangular(Meridians):
    """A panorama whose height on the image plane is the latitude, rad."""

    key = "EQUIRECTANGULAR"
    label = "Equirectangular"
    description = "Longitude and latitude on a square grid"
    group = "Blender's Own"
    SETTINGS = (*LONGITUDES, *LATITUDES, *SHIFT)
    FORMULA = (
        longitude("longitude_min", "longitude_max"),
        Step("Latitude", "lat = latitude_min + (y/H + shift_y) (latitude_max - latitude_min)"),
        RAY,
    )

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Equirectangular:
        """Build the camera from ranges and shift. Raises InputError for empty ranges and latitudes beyond the poles."""
        return cls.over_frame(raw, raster, span(raw, *LONGITUDES), span(raw, *LATITUDES))

    def latitude(self, height):
        return np.cos(height), np.sin(height)

    def height(self, cosine, sine):
        """See Meridians; the result lies between the poles, though rows may lie beyond them."""
        return np.arctan2(sine, cosine)

    def bounds(self, centers, radii):
        """See Meridians; everywhere for spheres that a frame over a pole sees again in its rows beyond the pole."""
        bounds = super().bounds(centers, radii)
        low, high = self.extent[2:]
        pitch = abs(self.window.pitch_y)
        if max(-low, high) - pitch / 2 > pi / 2:
            _, (bottom, top) = longitude_latitude(centers, radii)
            again = (top >= pi - high - PIXEL_MARGIN * pitch) | (bottom <= -pi - low + PIXEL_MARGIN * pitch)
            bounds[again] = everywhere(int(again.sum()))
        return bounds
