"""A smooth function of the pixel for whole pictures: Chebyshev polynomials in x and y, panel by panel of the raster.

The function is evaluated at a few points of each panel, and the polynomials through them give the pixels: some twenty
products each, whatever the function takes. Where the coefficients have not sunk to rounding, the panel's quarters are
tried, and where theirs have not, the function is evaluated at each pixel. For fisheyes that take sines, or iterate,
rays take 0.4 to 0.8 of the time, whole casts 0.6 to 0.9; for models with ``by_polynomials`` what ``Camera.rays``
returns takes 0.3 to 0.8 of the time.
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
from .speed import STRIP
from .vector import is_grid

ROWS, COLUMNS = 180, 96
"""Of a panel. They begin at multiples of these, so that a pixel has the same one in whatever part of the picture;
pictures of the usual sizes are whole panels.
"""

QUARTER = ROWS // 2, COLUMNS // 2
"""Of a panel's quarters. Panels of 72 by 64 alone, with 14 points: 1.2 to 1.4 times the time of rays that iterate."""

POINTS = 16
"""Of a panel's side, its ends among them. With 14, rays of a strong barrel distortion took 1.5 times as long, since
more panels were quartered.
"""

PIECE = 45
"""Rows of a panel in one product, which stays below 2^18: beyond, OpenBLAS wakes threads of its own."""

TAIL = 2
"""Coefficients that have to be as small as rounding, for a polynomial to be as right as its points."""

ROUNDING = 4
"""EPS of a panel's largest value."""

AT_ONCE = 16
"""Quarters whose pixels are asked each for itself: more, and their working arrays would not stay in a core's cache."""

FEWEST = STRIP, 256
"""Rows and columns that are worth it: in smaller parts of a picture each pixel is asked for itself."""


@dataclass(frozen=True)
class Disc:
    """An ellipse about a middle, in pixel coordinates: the part of the picture in which a function counts."""

    middle: tuple[float, float]
    holds: Callable
    """Of x and y: whether they are within it."""

    def covers(self, x, y) -> np.ndarray:
        """Return which panels with these corners lie wholly in it: their corners do."""
        corners = [self.holds(x + right, y + up) for right in (0, COLUMNS) for up in (0, ROWS)]
        return np.logical_and.reduce(corners)

    def nearest(self, x, y, size: tuple[int, int]):
        """Return the x and y in panels with these corners that are nearest to the middle."""
        return np.clip(self.middle[0], x, x + size[1]), np.clip(self.middle[1], y, y + size[0])


@dataclass(frozen=True)
class Polynomials:
    """What gives a function's values all over some panels of one size."""

    start: np.ndarray
    """At a point in the middle of each, (count, *panels, 1, 1)."""
    rest: np.ndarray
    """How much more it is at the others, (count, *panels, POINTS, POINTS)."""
    right: np.ndarray
    """Whether they do all over it, (*panels)."""
    empty: np.ndarray
    """Whether there is no value at any point, (*panels)."""

    @classmethod
    def through(cls, function: Callable, x, y, size: tuple[int, int], count: int) -> Polynomials:
        """Return those of panels with the corners x, y, which broadcast."""
        x, y = x[..., None, None] + _places() * size[1], y[..., None, None] + _places()[:, None] * size[0]
        rest = np.empty((count, *np.broadcast_shapes(x.shape, y.shape)))
        for own, value in zip(rest, function(x, y), strict=True):
            own[...] = value
        empty = np.isnan(rest[0]).all(axis=(-2, -1))
        largest = np.abs(rest).max(axis=(0, -2, -1))
        start = rest[..., *[slice(POINTS // 2, POINTS // 2 + 1)] * 2].copy()
        rest -= start  # what is left is small, and so is the rounding of the sums
        tails = _fit()[-TAIL:] @ rest, rest @ _fit()[-TAIL:].T
        tail = np.maximum(*(np.abs(own).max(axis=(0, -2, -1)) for own in tails))
        return cls(start, rest, tail <= ROUNDING * EPS * largest, empty)

    def write(self, which, out: np.ndarray, pieces: slice = slice(None)) -> None:
        """Write the values of some panels into an array of ``_empty``, (count, panels, rows, columns), or of these
        pieces of their rows alone.
        """
        _, panels, rows, columns = out.shape
        sums = _empty(len(out), (panels, POINTS + 1, columns), _are_side_by_side(out))
        for own, rest, start in zip(sums, self.rest, self.start, strict=True):
            own[..., :-1, :] = rest[which] @ _between(columns).T
            own[..., -1:, :] = start[which]
        found = _as_matrices(out)
        found = found.reshape(*found.shape[:-2], rows // PIECE, PIECE, found.shape[-1])[..., pieces, :, :]
        parts = _between_and_start(rows).reshape(-1, PIECE, POINTS + 1)[pieces]
        np.matmul(parts, _as_matrices(sums)[..., None, :, :], out=found)


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
    size, shape = (ROWS, COLUMNS), (ROWS * len(bands), COLUMNS * len(panels))
    found = out if out is not None and out.shape[1:] == shape else _empty(count, shape, out is not None)
    corners = panels[None] * COLUMNS, bands[:, None] * ROWS
    wanted = np.ones((len(bands), len(panels)), bool)
    if disc is not None:
        wanted &= disc.holds(*disc.nearest(*corners, size))
    values = _divided(found, size)
    whole = Polynomials.through(function, *corners, size, count)
    for band, right in enumerate(whole.right & wanted):
        if right.any():
            used = np.s_[band, np.argmax(right) : right.size - np.argmax(right[::-1])]
            first, last = np.clip((low - band * ROWS, low + y.size - band * ROWS), 0, ROWS)
            whole.write(used, values[:, *used], slice(first // PIECE, -(-last // PIECE)))
    if (rest := wanted & ~whole.right).any():
        _by_quarters(function, found, rest, (panels[0], bands[0]), (low, low + y.size), disc)
    if disc is not None:
        values[:, ~wanted] = np.nan
        centers = _centers(size)
        for at in map(tuple, np.argwhere(wanted & ~disc.covers(*corners))):
            inside = disc.holds(corners[0][0, at[1]] + centers[0], corners[1][at[0]] + centers[1])
            np.copyto(values[:, *at], np.nan, where=~inside)
    result = found[:, low : low + y.size, left : left + x.size]
    if out is not None and found is not out:
        out[...] = result
    return result


def _by_quarters(function, found, wanted, corner, rows: tuple[int, int], disc: Disc | None) -> None:
    """Write the values in wanted panels by polynomials of their quarters, or each for itself where it is of these rows.

    corner: the numbers of the first panel, in x and y.
    """
    values = _divided(found, QUARTER)
    wanted = wanted.repeat(2, axis=0).repeat(2, axis=1)
    band, panel = np.nonzero(wanted)
    x, y = (2 * corner[0] + panel) * QUARTER[1], (2 * corner[1] + band) * QUARTER[0]
    quarters = Polynomials.through(function, x, y, QUARTER, len(values))
    right = quarters.right
    given = _empty(len(values), (np.count_nonzero(right), *QUARTER), _are_side_by_side(values))
    quarters.write(right, given)
    values[:, band[right], panel[right]] = given
    rest = ~right
    if disc is not None:  # no value at the points, and none nearest to the middle: none at all
        rest &= ~(quarters.empty & np.isnan(function(*disc.nearest(x, y, QUARTER))[0]))
        values[:, band[~(right | rest)], panel[~(right | rest)]] = np.nan
    centers = _centers(QUARTER)
    spans = np.clip(np.array(rows) - (y - corner[1] * ROWS)[:, None], 0, QUARTER[0])
    for span in np.unique(spans[rest], axis=0):  # all rows of most quarters, some of the outer ones
        at = np.flatnonzero(rest & (spans == span).all(axis=1))
        for some in np.split(at, range(AT_ONCE, at.size, AT_ONCE)):
            inside = slice(*span)
            asked = function(x[some, None, None] + centers[0], y[some, None, None] + centers[1][inside])
            for own, value in zip(values, asked, strict=True):
                own[band[some], panel[some], inside] = value


def _divided(found, size: tuple[int, int]):
    """View a picture (count, rows, columns) as panels of this size, (count, bands, panels, rows, columns)."""
    rows, columns = size
    bands, panels = found.shape[1] // rows, found.shape[2] // columns
    return found.reshape(len(found), bands, rows, panels, columns).swapaxes(2, 3)


def _centers(size: tuple[int, int]):
    """Return x and y of a panel's pixel centers, from its corner."""
    return np.arange(size[1])[None] + 0.5, np.arange(size[0])[:, None] + 0.5


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
