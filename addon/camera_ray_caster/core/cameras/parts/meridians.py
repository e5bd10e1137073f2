"""The base of equirectangular and cylindrical panoramas: longitude grows evenly along a row, a row has one latitude.

The camera's +y is the axis, longitude 0 is the viewing direction, +x lies at longitude 90 degrees. The direction is
(cos lat sin lon, sin lat, -cos lat cos lon): columns and rows stay apart until the last product. A model defines the
latitude of a height on the image plane and the height of a latitude.
Reference: J. P. Snyder, Map Projections: A Working Manual (1987), chapters 10 to 12, the cylindrical projections.
"""

from abc import abstractmethod
from dataclasses import dataclass
from functools import cached_property
from math import pi

import numpy as np

from ...maths.vector import components
from ...records import BlenderCamera, Raster
from ..model import Step, WindowModel
from .film import Window
from .settings import CAMERA, FULL_TURN, Number
from .silhouette import longitude_latitude, pixel_bounds, turned

RAY = Step("Direction", "r = (cos(lat) sin(lon), sin(lat), -cos(lat) cos(lon))")


def longitudes(prefix: str) -> tuple[Number, Number]:
    """Return Blender's settings of the longitudes of the frame's edges, whose names begin with ``prefix``."""
    low, high = (
        Number(prefix + end, f"{end.title()} Longitude", f"Longitude of the frame's {side} edge; 0 is straight ahead",
               default, unit="angle", owner=CAMERA)
        for end, side, default in (("min", "left", -pi), ("max", "right", pi))
    )  # fmt: skip
    return low, high


def longitude(low: str, high: str) -> Step:
    """Return the step of a formula whose least and greatest longitude have these names."""
    return Step("Longitude", f"lon = {low} + (x/W + shift_x) ({high} - {low})")


@dataclass(frozen=True)
class Meridians(WindowModel):
    """A model whose window has longitude (rad) across and height up."""

    guarded = False

    @cached_property
    def extent(self) -> tuple[float, float, float, float]:
        """The part of the window that the frame shows: lowest and highest longitude, lowest and highest height."""
        return self.window.extent(self.size)

    @classmethod
    def over_frame(cls, raw: BlenderCamera, raster: Raster, longitudes, heights):
        """Return the model whose frame spans these (low, high) ranges, moved by Blender's shift."""
        return cls(raster.size, Window.over_frame(raw, raster, longitudes, heights))

    @abstractmethod
    def latitude(self, height):
        """Return cosine and sine of the latitude of heights."""

    @abstractmethod
    def height(self, cosine, sine):
        """Return the height of the latitude whose cosine and sine are proportional to these; the cosine is >= 0."""

    def rays(self, x, y):
        """See Model: direction's y has the shape of y. Each component is right to some EPS of 1 + longitude."""
        longitude, height = self.window.plane_from_pixels(x, y)
        cosine, sine = self.latitude(height)
        return (0.0, 0.0, 0.0), (cosine * np.sin(longitude), sine, -cosine * np.cos(longitude))

    def project(self, points):
        """See Model: NaN at the eye. If whole turns give several images, the result is the one nearest to the middle of
        the frame. A pole, which has all longitudes, gets one of them.
        """
        x, y, z = components(np.asarray(points, np.float64))
        across = np.hypot(x, z)
        y = np.where((across > 0) | (y != 0), y, np.nan)
        height = self.height(across, y)
        longitude, middle = np.arctan2(x, -z) + 0 * height, (self.extent[0] + self.extent[1]) / 2
        longitude -= FULL_TURN * np.rint((longitude - middle) / FULL_TURN)
        return np.stack(self.window.pixels_from_plane(longitude, height), axis=-1)

    def bounds(self, centers, radii):
        """See Model. A sphere that holds a pole or crosses the seam covers all columns: it has one rectangle."""
        longitudes, latitudes = longitude_latitude(centers, radii)
        columns = turned(longitudes, self.extent[:2], FULL_TURN)
        low, high = (np.clip(latitude, -np.pi / 2, np.pi / 2) for latitude in latitudes)
        bottom, top = (self.height(np.cos(latitude), np.sin(latitude)) for latitude in (low, high))
        heights = np.where(low <= -np.pi / 2, -np.inf, bottom), np.where(high >= np.pi / 2, np.inf, top)
        return pixel_bounds(self.window, columns, heights)
