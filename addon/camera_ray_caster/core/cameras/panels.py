"""A smooth function of the pixel for many of them: Chebyshev polynomials in x and y, panel by panel of the raster.

The function is asked at few points of each panel, and the polynomials through them give the pixels: some ten products
each, whatever the function takes. Where the coefficients have not sunk to rounding, each pixel is asked for itself.
References: J. Boyd, Chebyshev and Fourier Spectral Methods, 2nd ed. (2001), chapters 2, 4 and 5; L. Trefethen,
Approximation Theory and Approximation Practice (2013), chapters 3 and 8.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from math import floor

import numpy as np
from numpy.polynomial.chebyshev import chebvander

from ..conventions import EPS
from ..loops import BAND, STRIP
from ..vector import is_grid

ROWS, COLUMNS = BAND, 96
"""Of a panel. They begin at multiples of these, so that a pixel has the same one in whatever part of the picture. Their
products stay below 2^18, beyond which OpenBLAS wakes threads of its own.
"""

POINTS = 16
"""Of a panel's side, its ends among them."""

TAIL = 2
"""Coefficients that have to be as small as rounding, for a polynomial to be as right as its points."""

ROUNDING = 4
"""EPS of a panel's largest value."""

FEWEST = STRIP, 256
"""Rows and columns that are worth it."""


def on_raster(function: Callable, x, y):
    """Return a function's two values at pixel coordinates: by polynomials at a row and a column of centres in line.

    function: of two arrays that broadcast, gives two arrays; where one has no value, NaN, so has the other. Right to 8
    times the function's own error, the norm of the interpolation, and to ROUNDING of the larger value in the panel.
    """
    if not (is_grid(x, y) and x.ndim == 2 and _are_centres(y[:, 0], FEWEST[0]) and _are_centres(x[0], FEWEST[1])):
        return function(x, y)
    left, low = floor(x[0, 0]), floor(y[0, 0])
    panels = np.arange(left // COLUMNS, (left + x.size - 1) // COLUMNS + 1)
    values = np.empty((2, y.size, len(panels), COLUMNS))
    for band in range(low // ROWS, (low + y.size - 1) // ROWS + 1):
        first, last = (np.clip((band + i) * ROWS, low, low + y.size) for i in (0, 1))
        rows = range(first - band * ROWS, last - band * ROWS)
        _fill(function, panels, band, rows, values[:, first - low : last - low])
    return values.reshape(2, y.size, -1)[..., left % COLUMNS :][..., : x.size]


def _are_centres(places, fewest: int) -> bool:
    return places.size >= fewest and places[0] % 1 == 0.5 and bool((np.diff(places) == 1).all())


def _fill(function, panels, band: int, rows: range, values) -> None:
    """Write some rows of a row of panels, (2, rows, panels, COLUMNS)."""
    places = (1 + np.cos(np.pi / (POINTS - 1) * np.arange(POINTS))) / 2
    x, y = (panels[:, None] + places) * COLUMNS, (band + places) * ROWS
    asked = np.stack(function(x.reshape(1, -1), y[:, None])).reshape(2, POINTS, -1, POINTS).swapaxes(1, 2)
    start = asked[..., :1, :1]  # what is left is small, and so is the rounding of the sums
    series = _fit() @ (asked - start) @ _fit().T
    tail = np.maximum(*(np.abs(part).max(axis=(0, 2, 3)) for part in (series[..., -TAIL:, :], series[..., -TAIL:])))
    right = tail <= ROUNDING * EPS * np.abs(asked).max(axis=(0, 2, 3))
    found = _terms(ROWS) @ series[:, right] @ _terms(COLUMNS).T  # all rows: sums of some would be rounded otherwise
    values[:, :, right] = (found + start[:, right])[:, :, rows.start : rows.stop].swapaxes(1, 2)
    if not right.all():
        left = panels[~right]
        x, y = left[:, None] * COLUMNS + np.arange(COLUMNS) + 0.5, band * ROWS + np.array(rows) + 0.5
        values[:, :, ~right] = np.stack(function(x.reshape(1, -1), y[:, None])).reshape(2, len(rows), -1, COLUMNS)


@cache
def _terms(pixels: int) -> np.ndarray:
    """Return the polynomials at the pixel centres of a panel, (pixels, POINTS)."""
    return chebvander((2 * np.arange(pixels) + 1) / pixels - 1, POINTS - 1)


@cache
def _fit() -> np.ndarray:
    """Return the matrix that brings values at Chebyshev's points of the second kind to coefficients."""
    turns = np.outer(np.arange(POINTS), np.arange(POINTS)) % (2 * (POINTS - 1))  # whole ones taken off exactly
    weight = np.where(np.arange(POINTS) % (POINTS - 1) == 0, 0.5, 1.0)
    return np.cos(np.pi / (POINTS - 1) * turns) * weight * weight[:, None] * (2 / (POINTS - 1))
