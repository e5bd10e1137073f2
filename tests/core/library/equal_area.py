"""The equal-area cylindrical panorama of Lambert: equal parts of the picture are equal parts of the sphere."""

from dataclasses import dataclass

import numpy as np

from camera_ray_caster import Model, Number, Step

TOP = Number("equal_area_top", "Top Latitude", "Of the upper edge; the lower one is as low", 1.4, 0.1, 1.5, "angle")


@dataclass(frozen=True)
class EqualArea(Model):
    """Longitude by columns, the sine of the latitude by rows."""

    top: float
    key, label, group, number = "EQUAL_AREA", "Equal-Area Cylindrical", "Panorama", 1001
    description = "All around; equal areas of the picture are equal solid angles"
    SETTINGS = (TOP,)
    FORMULA = (Step("Longitude and latitude", "lon = (x/W - 1/2) 360°, lat = asin((2 y/H - 1) sin(top))"),)

    def rays(self, x, y):
        lon, up = (x / self.size[0] - 0.5) * 2 * np.pi, (2 * y / self.size[1] - 1) * np.sin(self.top)
        level = np.sqrt(np.where(abs(up) < 1, 1 - up * up, np.nan))  # beyond the poles there is no ray
        return (0.0, 0.0, 0.0), (np.sin(lon) * level, up, -np.cos(lon) * level)
