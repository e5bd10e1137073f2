"""The Mercator panorama: columns are even in longitude, rows keep small shapes as they are."""

from dataclasses import dataclass

import numpy as np

from .model import Model, Step
from .parts.settings import Number

TOP = Number("mercator_top", "Top Latitude", "Of the upper edge; the lower one is as low", 1.4, 0.1, 1.5, "angle")


@dataclass(frozen=True)
class Mercator(Model):
    """Longitude and height in the frame, 0 in its middle."""

    top: float
    key, label, group, number = "MERCATOR", "Mercator", "Panorama", 1000
    description = "All around, with angles kept: small shapes are not distorted"
    SETTINGS = (TOP,)
    FORMULA = (Step("Longitude and latitude", "lon = (x/W - 1/2) 360°, lat = atan(sinh((2 y/H - 1) asinh(tan(top))))"),)

    def rays(self, x, y):
        lon, high = (x / self.size[0] - 0.5) * 2 * np.pi, (2 * y / self.size[1] - 1) * np.arcsinh(np.tan(self.top))
        return (0.0, 0.0, 0.0), (np.sin(lon) / np.cosh(high), np.tanh(high), -np.cos(lon) / np.cosh(high))
