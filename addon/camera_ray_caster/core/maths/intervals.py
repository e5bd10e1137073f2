"""Interval arithmetic: a formula for numbers takes intervals as well, and returns the range of values it can have.

A model whose ``project`` consists of a few products and quotients obtains its image bounds from the same formula, with
the bounding balls of shapes as intervals. A variable that occurs twice can make the result wider, never narrower.
Rounding is not tracked: the margin of ``pixel_bounds`` is much larger.
Reference: R. E. Moore, Interval Analysis (1966).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Interval:
    """The numbers from low to high: arrays of one shape; -inf and inf for an unknown value."""

    low: np.ndarray
    high: np.ndarray

    __array_ufunc__ = None  # array * interval calls the interval's method

    @classmethod
    def around(cls, middle, radius) -> Interval:
        """Return the interval from middle - radius to middle + radius."""
        return cls(middle - radius, middle + radius)

    def __add__(self, other):
        other = _interval(other)
        return Interval(self.low + other.low, self.high + other.high)

    def __neg__(self):
        return Interval(-self.high, -self.low)

    def __sub__(self, other):
        return self + -_interval(other)

    def __mul__(self, other):
        other = _interval(other)
        ends = [_product(a, b) for a in (self.low, self.high) for b in (other.low, other.high)]
        return Interval(np.minimum.reduce(ends), np.maximum.reduce(ends))

    def __truediv__(self, other):
        other = _interval(other)
        apart = (other.low > 0) | (other.high < 0)
        inverse = Interval(1 / np.where(apart, other.high, 1.0), 1 / np.where(apart, other.low, 1.0))
        quotient = self * inverse
        return Interval(np.where(apart, quotient.low, -np.inf), np.where(apart, quotient.high, np.inf))

    __radd__ = __add__
    __rmul__ = __mul__

    def __rsub__(self, other):
        return -self + other


def _interval(value) -> Interval:
    return value if isinstance(value, Interval) else Interval(value, value)


def _product(left, right):
    """Return the product, with 0 times inf = 0."""
    known = (left != 0) & (right != 0)
    return np.where(known, np.where(known, left, 1.0) * np.where(known, right, 1.0), 0.0)
