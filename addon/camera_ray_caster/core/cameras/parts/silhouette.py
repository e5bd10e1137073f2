"""Conservative bounds of the part of the picture in which a bounding sphere can be seen, so that culling loses nothing.

Bounds are intervals on the image plane: (-inf, inf) if a sphere may be seen everywhere, NaN if it is seen nowhere.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...maths.vector import components

PIXEL_MARGIN = 1 / 16
"""Pixels added on each side: far more than the rounding of the bounds, and too few to cost culling much."""
MARGINS = np.array((-PIXEL_MARGIN, PIXEL_MARGIN, -PIXEL_MARGIN, PIXEL_MARGIN))
"""The same for bounds x0, x1, y0, y1."""

EVERYWHERE = -np.inf, np.inf


def everywhere(count: int) -> np.ndarray:
    """Return the bounds (count, 4) of balls that may be seen everywhere."""
    return np.tile((*EVERYWHERE, *EVERYWHERE), (count, 1))


def angular_radius(distance, radius):
    """Return the half angle of discs or spheres at these distances: asin(radius / distance), or pi/2 from inside."""
    return np.arcsin(np.minimum(radius / np.maximum(distance, np.finfo(float).tiny), 1.0))


def pinhole_interval(x, depth, radius, through=False):
    """Return the interval of tan(angle) that a disc covers as seen from the origin of its plane.

    The disc has its center at (x, depth) and the given radius, in the plane of one image axis and the viewing
    direction; arrays (n,). The interval is unbounded on the sides on which the disc reaches behind the eye's plane, and
    on both if lines are seen ``through`` the origin; it is (NaN, NaN) if all of the disc is behind. The tangents from
    the origin touch the disc at tan = (x depth -+ r sqrt(x^2 + depth^2 - r^2)) / (depth^2 - r^2). That is computed as
    the angle of the center plus or minus asin(r / distance), without cancellation.
    """
    middle, distance = np.arctan2(x, depth), np.hypot(x, depth)
    outside = depth > radius if through else distance > radius
    half = np.where(outside, angular_radius(distance, radius), 2 * np.pi)
    low, high = middle - half, middle + half
    behind = depth <= -radius
    low = np.where(low > -np.pi / 2, np.tan(np.minimum(low, np.pi / 2)), -np.inf)
    high = np.where(high < np.pi / 2, np.tan(np.maximum(high, -np.pi / 2)), np.inf)
    return np.where(behind, np.nan, low), np.where(behind, np.nan, high)


class Sectors(NamedTuple):
    """The sectors in which spheres are seen in an image whose radius grows with the angle theta from the axis, up to
    the angle ``widest``, where the image ends; azimuth is kept.

    A sphere with its center at theta and the half angle alpha lies between the angles theta - alpha and theta + alpha,
    within asin(sin alpha / sin theta) of its azimuth, or all around if it holds the axis or the opposite point. An
    image wider than a full turn repeats: it has the angles from 2 pi - widest twice. A sphere that reaches these, or
    that holds the eye, may be seen everywhere.
    """

    inner: np.ndarray
    """(n,): the least angle of each sphere, 0 to ``widest``; then the largest."""
    outer: np.ndarray
    azimuths: tuple[tuple[np.ndarray, ...], ...]
    """The least and the largest cosine of the azimuth, and those of its sine."""
    everywhere: np.ndarray
    nowhere: np.ndarray

    @classmethod
    def of(cls, centers: np.ndarray, radii: np.ndarray, widest: float) -> Sectors:
        """Return the sectors of spheres with their centers at (n, 3)."""
        x, y, z = components(centers)
        across = np.hypot(x, y)
        distance = np.hypot(across, z)
        theta, alpha = np.arctan2(across, -z), angular_radius(distance, radii)
        inner, outer = theta - alpha, theta + alpha
        everywhere = radii >= distance
        if widest > np.pi:  # 180 degrees in float32 are more
            everywhere |= outer >= 2 * np.pi - widest
            widest = np.pi
        nowhere = ~everywhere & (inner > widest)
        around = (inner <= 0) | (outer >= np.pi)
        across = np.maximum(across, np.finfo(float).tiny)
        sine = np.minimum(radii / across, 1.0)  # of half the sector
        cosine = np.where(around, -1.0, np.sqrt((1 - sine) * (1 + sine)))
        middle = x / across, y / across
        azimuths = [
            tuple(
                sign * np.where(sign * side >= cosine, 1.0, sign * side * cosine + np.abs(other) * sine)
                for sign in (-1, 1)
            )
            for side, other in (middle, middle[::-1])
        ]
        return cls(np.clip(inner, 0, widest), np.minimum(outer, widest), tuple(azimuths), everywhere, nowhere)

    def intervals(self, inner: np.ndarray, outer: np.ndarray) -> tuple:
        """Return the intervals in x and y between the radii of ``inner`` and ``outer``."""
        return tuple(
            _mark(self.everywhere, self.nowhere, _product((inner, outer), azimuth)) for azimuth in self.azimuths
        )


def radial_intervals(centers, radii, radius, widest):
    """Return the intervals in x and y that spheres cover in an image with this function from theta to the radius: see
    ``Sectors``.
    """
    sectors = Sectors.of(centers, radii, widest)
    return sectors.intervals(radius(sectors.inner), radius(sectors.outer))


def _product(lengths, factors):
    """Return the interval of the product of two intervals, the first of which is not negative."""
    low, high = factors
    return np.where(low < 0, lengths[1], lengths[0]) * low, np.where(high < 0, lengths[0], lengths[1]) * high


def longitude_latitude(centers, radii):
    """Return the intervals of longitude and latitude that spheres cover about the axis +y, longitude 0 ahead.

    A sphere at latitude lat with the half angle alpha spans asin(sin alpha / cos lat) of longitude to each side, or all
    longitudes (from -inf to inf) if it holds a pole. Both intervals are unbounded if it holds the eye.
    """
    x, y, z = components(centers)
    across = np.hypot(x, z)
    distance = np.hypot(across, y)
    alpha = angular_radius(distance, radii)
    lon, lat = np.arctan2(x, -z), np.arctan2(y, across)
    around = np.abs(lat) + alpha >= np.pi / 2
    half = np.arcsin(np.minimum(np.sin(alpha) / np.maximum(np.cos(lat), 1e-300), 1))
    half = np.where(around, np.inf, half)
    inside = radii >= distance
    return (lon - half, lon + half), _mark(inside, False, (lat - alpha, lat + alpha))


def turned(interval, frame, period):
    """Return intervals, (n,) arrays, moved by whole periods into the frame (low, high).

    NaN if no such move meets the frame; (-inf, inf) if more than one does, as at a seam or if the frame repeats.
    """
    low, high = interval
    endless = np.isinf(low) | np.isinf(high)
    low, high = np.where(endless, 0.0, low), np.where(endless, 0.0, high)
    first, last = np.ceil((frame[0] - high) / period), np.floor((frame[1] - low) / period)
    move = first * period
    return _mark(endless | (last > first), ~endless & (last < first), (low + move, high + move))


def _mark(everywhere, nowhere, interval):
    """Return the interval, replaced by (-inf, inf) where ``everywhere`` holds and by NaN where ``nowhere`` holds."""
    return tuple(
        np.where(everywhere, end, np.where(nowhere, np.nan, bound))
        for end, bound in zip(EVERYWHERE, interval, strict=True)
    )


def pixel_bounds(window, interval_x, interval_y):
    """Return (n, 4) pixel bounds x0, x1, y0, y1 of intervals on a window, with the margin; NaN means nowhere."""
    (x0, x1), (y0, y1) = window.pixel_intervals(interval_x, interval_y)
    return np.stack((x0, x1, y0, y1), axis=-1) + MARGINS
