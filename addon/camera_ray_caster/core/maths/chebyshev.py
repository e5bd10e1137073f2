"""A smooth function of the pixel for whole pictures: Chebyshev polynomials in x and y, panel by panel of the raster.

The function is evaluated at a few points of each panel, and the polynomials through them give the pixels: some twenty
products each, whatever the function takes. Where the coefficients have not sunk to rounding, the function is evaluated
at each pixel. For fisheyes that take sines, or iterate, rays take 0.4 to 0.8 of the time, whole casts 0.6 to 0.9;
for models with ``by_polynomials`` what ``Camera.rays`` returns takes 0.3 to 0.8 of the time.
References: J. Boyd, Chebyshev and Fourier Spectral Methods, 2nd ed. (2001), chapters 2, 4 and 5; L. Trefethen,
Approximation Theory and Approximation Practice (2013), chapters 3 and 8.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from math import floor

import numpy as np
from numpy.polynomial.chebyshev import chebvander

from ..conventions import EPS
from .speed import BAND, STRIP
from .vector import is_grid

ROWS, COLUMNS = BAND // 2, 64
"""Of a panel. They begin at multiples of these, so that a pixel has the same one in whatever part of the picture, and
pictures of the usual sizes are whole panels.
"""

CENTERS_X, CENTERS_Y = np.arange(COLUMNS)[None] + 0.5, np.arange(ROWS)[:, None] + 0.5
"""Of a panel's pixels, from its corner."""

POINTS = 14
"""Of a panel's side, its ends among them. The products stay below 2^18, beyond which OpenBLAS wakes threads of
its own.
"""

TAIL = 2
"""Coefficients that have to be as small as rounding, for a polynomial to be as right as its points."""

ROUNDING = 4
"""EPS of a panel's largest value."""

AT_ONCE = 16
"""Panels whose pixels are asked each for itself: more, and their working arrays would not stay in a core's cache."""

FEWEST = STRIP, 256
"""Rows and columns that are worth it: in smaller parts of a picture each pixel is asked for itself."""


@dataclass(frozen=True)
class Disc:
    """An ellipse about a middle, in pixel coordinates: the part of the picture in which a function counts."""

    middle: tuple[float, float]
    holds: Callable
    """Of x and y: whether they are within it."""

    def covers(self, panels, bands) -> np.ndarray:
        """Return which (bands, panels) lie wholly in it: their corners do."""
        x, y = np.append(panels, panels[-1] + 1) * COLUMNS, np.append(bands, bands[-1] + 1) * ROWS
        corners = self.holds(x[None], y[:, None])
        return corners[1:, 1:] & corners[1:, :-1] & corners[:-1, 1:] & corners[:-1, :-1]

    def meets(self, panels, bands) -> np.ndarray:
        """Return which (bands, panels) have a part in it."""
        return self.holds(*self.nearest(panels, bands))

    def nearest(self, panels, bands):
        """Return the x (1, panels) and y (bands, 1) in each that are nearest to the middle."""
        x, y = np.clip(self.middle[0] / COLUMNS, panels, panels + 1), np.clip(self.middle[1] / ROWS, bands, bands + 1)
        return x[None] * COLUMNS, y[:, None] * ROWS


def is_raster(x, y) -> bool:
    """Whether x and y are a row and a column of neighboring pixel centers, and enough of them."""
    return is_grid(x, y) and x.ndim == 2 and _are_centers(y[:, 0], FEWEST[0]) and _are_centers(x[0], FEWEST[1])


def _are_centers(places, fewest: int) -> bool:
    return places.size >= fewest and places[0] % 1 == 0.5 and bool((np.diff(places) == 1).all())


def on_raster(function: Callable, x, y, disc: Disc | None = None, count: int = 2, out: np.ndarray | None = None):
    """Return a function's values at pixel coordinates, (count, rows, columns) on a raster; see ``is_raster``.

    function: of x (..., 1, columns) and y (..., rows, 1), gives ``count`` numbers or arrays of their common shape;
    where one has no value, NaN, so have the others. Anywhere but on a raster it is asked itself. With a ``disc`` its
    values count within that alone, and are NaN beyond; a function that is smooth beyond the disc, too, spares the
    panels at its rim from being asked pixel by pixel. On a raster ``out``, (count, rows, columns) with a pixel's values
    side by side in memory, is filled. Right to 8 times the function's own error, the norm of the interpolation, and to
    ROUNDING of the largest value in the panel.
    """
    if not is_raster(x, y):
        return function(x, y)
    (low, bands), (left, panels) = _panels(y[:, 0], ROWS), _panels(x[0], COLUMNS)
    shape = ROWS * len(bands), COLUMNS * len(panels)
    found = out if out is not None and out.shape[1:] == shape else _empty(count, shape, out is not None)
    shaped = found.reshape(count, len(bands), ROWS, len(panels), COLUMNS).swapaxes(2, 3)
    wanted = np.ones((len(bands), len(panels)), bool) if disc is None else disc.meets(panels, bands)
    right, empty = _interpolate(function, bands, panels, wanted, shaped)
    if disc is not None:
        if empty.any():  # no value at the points, and none nearest to the middle: none at all
            wanted &= ~(empty & np.isnan(function(*disc.nearest(panels, bands))[0]))
        shaped[:, ~wanted] = np.nan
    for band, panel, span in _parts(~right & wanted, low, y.size):
        at_x = panels[panel, None, None] * COLUMNS + CENTERS_X
        at_y = bands[band, None, None] * ROWS + CENTERS_Y[slice(*span)]
        for values, value in zip(shaped, function(at_x, at_y), strict=True):
            values[band, panel, slice(*span)] = value
    if disc is not None:
        for band, panel in np.argwhere(wanted & ~disc.covers(panels, bands)):
            inside = disc.holds(panels[panel] * COLUMNS + CENTERS_X, bands[band] * ROWS + CENTERS_Y)
            np.copyto(shaped[:, band, panel], np.nan, where=~inside)
    result = found[:, low : low + y.size, left : left + x.size]
    if out is not None and found is not out:
        out[...] = result
    return result


def _parts(panels, low: int, count: int):
    """Yield the indices of marked (bands, panels), some at a time, and which of their rows are among the raster's."""
    spans = np.clip(np.array([[low, low + count]]) - np.arange(len(panels))[:, None] * ROWS, 0, ROWS)
    for span in np.unique(spans, axis=0) if panels.any() else ():  # all rows of most bands, some of the outer ones
        at = np.argwhere(panels & (spans == span).all(axis=1)[:, None])
        for first in range(0, len(at), AT_ONCE):
            yield *at[first : first + AT_ONCE].T, span


def _interpolate(function, bands, panels, wanted, shaped) -> tuple[np.ndarray, np.ndarray]:
    """Write what polynomials give into (count, bands, panels, ROWS, COLUMNS).

    Return for which wanted panels they are right, and which have no value at any point.
    """
    x, y = (panels[:, None] + _places()) * COLUMNS, (bands[:, None] + _places()) * ROWS
    asked = np.empty((len(shaped), len(bands), POINTS, len(panels), POINTS))
    for own, value in zip(asked, function(x.reshape(1, -1), y.reshape(-1, 1)), strict=True):
        own.reshape(y.size, x.size)[...] = value
    asked = asked.swapaxes(2, 3)
    empty = np.isnan(asked[0]).all(axis=(2, 3))
    start = asked[..., :1, :1].copy()  # what is left is small, and so is the rounding of the sums
    size = np.abs(asked).max(axis=(0, 3, 4))
    asked -= start
    tails = _fit()[-TAIL:] @ asked, asked @ _fit()[-TAIL:].T
    right = wanted & (np.maximum(*(np.abs(tail).max(axis=(0, 3, 4)) for tail in tails)) <= ROUNDING * EPS * size)
    if right.any():
        columns = np.flatnonzero(right.any(axis=0))
        used = slice(columns[0], columns[-1] + 1)
        rows = _empty(len(asked), (*right[:, used].shape, POINTS + 1, COLUMNS), _are_side_by_side(shaped))
        for own, values, first in zip(rows, asked, start, strict=True):
            own[..., :-1, :] = values[:, used] @ _between(COLUMNS).T
            own[..., -1:, :] = first[:, used]
        np.matmul(_between_and_start(ROWS), _as_matrices(rows), out=_as_matrices(shaped[:, :, used]))
    return right, empty


def _empty(count: int, shape, side_by_side: bool) -> np.ndarray:
    """Return an array (count, *shape), the last axis or the first one side by side in memory."""
    return np.moveaxis(np.empty((*shape, count)), -1, 0) if side_by_side else np.empty((count, *shape))


def _are_side_by_side(values) -> bool:
    return values.strides[0] == values.itemsize


def _as_matrices(values):
    """View an array of ``_empty`` as matrices whose rows lie in one piece: one for each value, or one for all."""
    if not _are_side_by_side(values):
        return values
    last = np.moveaxis(values, 0, -1)
    return last.reshape(*last.shape[:-2], -1)


def _panels(places, size: int):
    """Return how far into its panel the first pixel is, and the panels' numbers."""
    first = floor(places[0])
    return first % size, np.arange(first // size, (first + places.size - 1) // size + 1)


@cache
def _places() -> np.ndarray:
    """Return Chebyshev's points of the second kind from 1 down to 0."""
    return (1 + np.cos(np.pi / (POINTS - 1) * np.arange(POINTS))) / 2


@cache
def _fit() -> np.ndarray:
    """Return the matrix that brings values at the points to coefficients."""
    turns = np.outer(np.arange(POINTS), np.arange(POINTS)) % (2 * (POINTS - 1))  # whole ones taken off exactly
    weight = np.where(np.arange(POINTS) % (POINTS - 1) == 0, 0.5, 1.0)
    return np.cos(np.pi / (POINTS - 1) * turns) * weight * weight[:, None] * (2 / (POINTS - 1))


@cache
def _between(pixels: int) -> np.ndarray:
    """Return the matrix that brings values at the points to those at a panel's pixel centers, (pixels, POINTS)."""
    return chebvander((2 * np.arange(pixels) + 1) / pixels - 1, POINTS - 1) @ _fit()


@cache
def _between_and_start(pixels: int) -> np.ndarray:
    """Return the same with a column that adds the start, (pixels, POINTS + 1)."""
    return np.column_stack((_between(pixels), np.ones(pixels)))
