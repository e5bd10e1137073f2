"""The Earth: local axes at a point of the frame of its center.

References: WGS 84; B. Bowring, Transformation from spatial to geographical coordinates (1976).
"""

from math import atan2, cos, hypot, sin

import numpy as np

AXIS, FLATTENING = 6378137.0, 1 / 298.257223563
"""The larger half axis of the Earth, in meters, and the part of it by which the smaller one is shorter: WGS 84."""


def place_of(longitude, latitude, height) -> np.ndarray:
    """Return the place (..., 3) in the frame of the Earth's center of a longitude and a latitude, in radians."""
    squared = FLATTENING * (2 - FLATTENING)
    across = AXIS / np.sqrt(1 - squared * np.sin(latitude) ** 2)
    flat = (across + height) * np.cos(latitude)
    x, y = flat * np.cos(longitude), flat * np.sin(longitude)
    return np.stack((x, y, (across * (1 - squared) + height) * np.sin(latitude)), axis=-1)


def axes_at(middle: np.ndarray) -> np.ndarray:
    """Return east, north and up, (3, 3), at a point in the frame of the Earth's center."""
    x, y, z = middle
    across, short = hypot(x, y), AXIS * (1 - FLATTENING)
    squared = FLATTENING * (2 - FLATTENING)
    scaled = np.array((z * AXIS, across * short)) / hypot(z * AXIS, across * short)
    latitude = atan2(z + squared / (1 - squared) * short * scaled[0] ** 3, across - squared * AXIS * scaled[1] ** 3)
    longitude = atan2(y, x)
    east = (-sin(longitude), cos(longitude), 0.0)
    up = (cos(latitude) * cos(longitude), cos(latitude) * sin(longitude), sin(latitude))
    return np.array((east, np.cross(up, east), up))
