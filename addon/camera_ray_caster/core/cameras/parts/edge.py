"""The closed curve around all that a lens shows. Points beyond it need no search for their inverse."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import pi

import numpy as np

CURVE_POINTS = 4096
"""Number of points of the curve. In a thin prism fisheye of 1920 x 1080 pixels, a share of 0.11 lies beyond the curve.
With a test of the radius alone, Newton's method took all its steps for many of these, and rays took 7 times as long.
"""

RADIUS_MARGIN = 1e-8
"""Margin relative to a radius: larger than rounding, also if terms of a lens cancel each other."""


@dataclass(frozen=True, eq=False)
class Edge:
    """The curve in polar coordinates, its points in ascending order of the angle."""

    angle: np.ndarray
    """Angles of the points, (n,), from -pi on."""
    radius: np.ndarray
    """Radii, (n,), that the curve does not exceed between each angle and the next."""

    @classmethod
    def circle(cls, radius: float) -> Edge:
        """Return the edge that is a circle; a radius of inf excludes nothing."""
        return cls(np.array([-pi]), np.array([radius * (1 + RADIUS_MARGIN)]))

    @classmethod
    def around(cls, curve: Callable, second: float) -> Edge | None:
        """Return the edge of a curve, a function of points x, y of the unit circle; None if its angles do not ascend.

        second: a bound on the curve's second derivative by the angle on the circle. Between two points at angles h
        apart, the curve departs from their chord by at most second h^2 / 8.
        """
        around = np.arange(CURVE_POINTS) * (2 * pi / CURVE_POINTS)
        x, y = curve(np.cos(around), np.sin(around))
        angle = np.unwrap(np.arctan2(y, x))
        if not (np.diff(angle, append=angle[0] + 2 * pi) > 0).all():
            return None
        radius = np.hypot(x, y)
        radius = np.maximum.reduce([np.roll(radius, shift) for shift in (1, 0, -1, -2)])
        radius = (radius + second * (2 * pi / CURVE_POINTS) ** 2 / 8) * (1 + RADIUS_MARGIN)
        angle = np.arctan2(y, x)
        first = int(np.argmin(angle))
        return cls(np.roll(angle, -first), np.roll(radius, -first))

    def may_hold(self, x, y, r):
        """Return which points, r from the origin, the curve may enclose."""
        near = r <= self.radius.min()
        if near.all():  # most lenses show their whole picture
            return near
        return r <= self.radius[np.searchsorted(self.angle, np.arctan2(y, x), "right") - 1]
