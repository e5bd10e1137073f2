"""The closed curve around all that a lens shows: beyond it nothing has to be searched for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import pi

import numpy as np

COUNT = 4096
"""Points of the curve. Of a thin prism fisheye's 1920 x 1080 pixels 0.11 lie beyond it; where only the radius told so,
Newton's method took all its steps for many of them, and rays 7 times as long.
"""

SLACK = 1e-8
"""Of a radius: more than rounding, also where terms of a lens cancel each other."""


@dataclass(frozen=True, eq=False)
class Edge:
    """The curve by the polar angles of its points, which ascend."""

    angle: np.ndarray
    """(n,) from -pi on."""
    radius: np.ndarray
    """(n,): beyond it the curve has no point from this angle to the next."""

    @classmethod
    def circle(cls, radius: float) -> Edge:
        """Return that of a circle, or, where the radius is inf, of none."""
        return cls(np.array([-pi]), np.array([radius * (1 + SLACK)]))

    @classmethod
    def around(cls, curve: Callable, second: float) -> Edge | None:
        """Return that of a curve, given at points x, y of the unit circle; None where its angles are in no order.

        second: the curve's second derivative by the angle on the circle at most. Between two of its points the curve is
        their chord to that times the square of their distance, over 8.
        """
        around = np.arange(COUNT) * (2 * pi / COUNT)
        x, y = curve(np.cos(around), np.sin(around))
        angle = np.unwrap(np.arctan2(y, x))
        if not (np.diff(angle, append=angle[0] + 2 * pi) > 0).all():
            return None
        radius = np.hypot(x, y)
        radius = np.maximum.reduce([np.roll(radius, shift) for shift in (1, 0, -1, -2)])
        radius = (radius + second * (2 * pi / COUNT) ** 2 / 8) * (1 + SLACK)
        angle = np.arctan2(y, x)
        first = int(np.argmin(angle))
        return cls(np.roll(angle, -first), np.roll(radius, -first))

    def may_hold(self, x, y, r):
        """Return which points, r from the origin, the curve may enclose."""
        near = r <= self.radius.min()
        if near.all():  # most lenses show their whole picture
            return near
        return r <= self.radius[np.searchsorted(self.angle, np.arctan2(y, x), "right") - 1]
