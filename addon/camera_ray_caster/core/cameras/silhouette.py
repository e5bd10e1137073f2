"""Where in the picture a bounding sphere can be seen: conservative bounds, so that culling loses nothing."""

from __future__ import annotations

import numpy as np

MARGIN = 1.0
"""Pixels added on each side: far more than the rounding of the bounds, far less than what culling saves."""


def pinhole_interval(x, depth, radius):
    """Return the interval of tan(angle) that a disc covers as seen from the origin of its plane.

    The disc has its centre at (x, depth) and the given radius, in the plane of one image axis and the viewing
    direction; arrays (n,). Unbounded where the disc reaches behind the eye's plane, (NaN, NaN) where all of it
    is behind: the tangents from the origin touch the disc at tan = (x depth -+ r sqrt(x^2 + depth^2 - r^2)) /
    (depth^2 - r^2), written as the angle of the centre plus or minus asin(r / distance), which has no cancellation.
    """
    distance = np.hypot(x, depth)
    middle = np.arctan2(x, depth)
    half = np.arcsin(np.minimum(radius / np.maximum(distance, np.finfo(float).tiny), 1.0))
    bounded = depth > radius
    behind = depth <= -radius
    low = np.where(bounded, np.tan(np.where(bounded, middle - half, 0.0)), -np.inf)
    high = np.where(bounded, np.tan(np.where(bounded, middle + half, 0.0)), np.inf)
    return np.where(behind, np.nan, low), np.where(behind, np.nan, high)


def pixel_bounds(window, interval_x, interval_y):
    """Return (n, 4) pixel bounds x0, x1, y0, y1 of intervals on a window, with the margin; NaN where nothing is seen."""
    x0, y0 = window.pixels_from_plane(interval_x[0], interval_y[0])
    x1, y1 = window.pixels_from_plane(interval_x[1], interval_y[1])
    return np.stack((x0 - MARGIN, x1 + MARGIN, y0 - MARGIN, y1 + MARGIN), axis=-1)
