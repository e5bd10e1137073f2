"""A smooth function of the pixel for whole pictures: Chebyshev polynomials in x and y, panel by panel of the raster.

The function is evaluated at a few points of each panel, and the polynomials through them give the pixels: some twenty
products each, whatever the function takes. Where the coefficients have not sunk to rounding, the panel's quarters are
tried, and theirs; where those of the smallest have not, the function is evaluated at each pixel. For fisheyes that take
sines, or iterate, rays take 0.4 to 0.8 of the time, whole casts 0.6 to 0.9; for models with ``by_polynomials`` what
``Camera.rays`` returns takes 0.3 to 0.8 of the time.
References: J. Boyd, Chebyshev and Fourier Spectral Methods, 2nd ed. (2001), chapters 2, 4 and 5; L. Trefethen,
Approximation Theory and Approximation Practice (2013), chapters 3 and 8.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import chain
from math import floor

import numpy as np
from numpy.polynomial.chebyshev import chebvander

from ..conventions import EPS
from .speed import STRIP
from .vector import is_grid

SIZES = (180, 96), (90, 48), (45, 24)
"""Rows and columns of panels, and of the quarters that are tried in turn. Panels begin at multiples of these, so that a
pixel has the same one in whatever part of the picture; pictures of the usual sizes are whole panels. Panels of 72 by 64
alone, with 14 points: 1.2 to 1.4 times the time of rays that iterate. Without the smallest: 1.1 to 1.2 times that of
spherical stereo through a fisheye or with a pole merge.
"""

ROWS, COLUMNS = SIZES[0]

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

AT_ONCE = 64
"""Panels whose pixels are asked each for itself: of more, working arrays would not stay in a core's cache."""

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
    def through(cls, function: Callable, x, y, size: tuple[int, int], counts: Sequence[int]) -> Polynomials:
        """Return those of panels with the corners x, y, which broadcast. ``counts``: of values that are one vector."""
        x, y = x[..., None, None] + _places() * size[1], y[..., None, None] + _places()[:, None] * size[0]
        rest = np.empty((sum(counts), *np.broadcast_shapes(x.shape, y.shape)))
        for own, value in zip(rest, function(x, y), strict=True):
            own[...] = value
        empty = np.isnan(rest[0]).all(axis=(-2, -1))
        first = np.cumsum([0, *counts[:-1]])
        largest = np.maximum.reduceat(np.abs(rest).max(axis=(-2, -1)), first)
        middle = slice(POINTS // 2, POINTS // 2 + 1)
        start = rest[..., middle, middle].copy()
        rest -= start  # what is left is small, and so is the rounding of the sums
        tails = _fit()[-TAIL:] @ rest, rest @ _fit()[-TAIL:].T
        tail = np.maximum.reduceat(np.maximum(*(np.abs(own).max(axis=(-2, -1)) for own in tails)), first)
        return cls(start, rest, (tail <= ROUNDING * EPS * largest).all(axis=0), empty)

    def write(self, which, first: int, out: np.ndarray, pieces: slice = slice(None)) -> None:
        """Write the values of some panels, from the function's ``first`` on, into an array of ``_empty``, (so many,
        panels, rows, columns), or of these pieces of their rows alone.
        """
        _, panels, rows, columns = out.shape
        sums = _empty(len(out), (panels, POINTS + 1, columns), _are_side_by_side(out))
        for own, rest, start in zip(sums, self.rest[first:], self.start[first:], strict=False):
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


def on_raster(
    function: Callable, x, y, disc: Disc | None = None, count: int = 2, out: Sequence[np.ndarray] | None = None
):
    """Return a function's values at pixel coordinates, (count, rows, columns) on a raster; see ``is_raster``.

    function: of x (..., 1, columns) and y (..., rows, 1), gives ``count`` numbers or arrays of their common shape;
    where one has no value, NaN, so have the others. Anywhere but on a raster it is asked itself. With a ``disc`` its
    values count within that alone, and are NaN beyond; a function that is smooth beyond the disc, too, spares the
    panels at its rim from being asked pixel by pixel. On a raster the arrays of ``out``, (some, rows, columns) with a
    pixel's values side by side in memory, are filled one after the other; each holds a vector. Right to 8 times the
    function's own error, the norm of the interpolation, and to ROUNDING of the vector's largest value in the panel.
    """
    if not is_raster(x, y):
        return function(x, y)
    (low, bands), (left, panels) = _panels(y[:, 0], ROWS), _panels(x[0], COLUMNS)
    shape = ROWS * len(bands), COLUMNS * len(panels)
    found = [_empty(count, shape, False)] if out is None else [
        own if own.shape[1:] == shape else _empty(len(own), shape, True) for own in out
    ]  # fmt: skip
    corners = panels[None] * COLUMNS, bands[:, None] * ROWS
    wanted = np.ones((len(bands), len(panels)), bool)
    if disc is not None:
        wanted &= disc.holds(*disc.nearest(*corners, SIZES[0]))
    parts = _divided(found, SIZES[0])
    whole = Polynomials.through(function, *corners, SIZES[0], [len(own) for own in found])
    for band, right in enumerate(whole.right & wanted):
        if right.any():
            used = np.s_[band, np.argmax(right) : right.size - np.argmax(right[::-1])]
            first, last = np.clip((low - band * ROWS, low + y.size - band * ROWS), 0, ROWS)
            for begin, values in parts:
                whole.write(used, begin, values[:, *used], slice(first // PIECE, -(-last // PIECE)))
    if (rest := wanted & ~whole.right).any():
        _by_quarters(function, found, rest, (panels[0], bands[0]), (low, low + y.size), disc, SIZES[1:])
    if disc is not None:
        centers = _centers(SIZES[0])
        for _, values in parts:
            values[:, ~wanted] = np.nan
        for band, panel in np.argwhere(wanted & ~disc.covers(*corners)):
            inside = disc.holds(corners[0][0, panel] + centers[0], corners[1][band] + centers[1])
            for _, values in parts:
                np.copyto(values[:, band, panel], np.nan, where=~inside)
    window = np.s_[:, low : low + y.size, left : left + x.size]
    for own, values in zip(out or (), found, strict=False):
        if values is not own:
            own[...] = values[window]
    return found[0][window]


def _by_quarters(function, found, wanted, corner, rows: tuple[int, int], disc: Disc | None, sizes) -> None:
    """Write the values in wanted panels by polynomials of their quarters, which have the first of these sizes, and of
    theirs; at last each for itself, where it is of these rows.

    corner: the numbers of the first panel, in x and y.
    """
    size, *smaller = sizes
    corner = 2 * corner[0], 2 * corner[1]
    parts = _divided(found, size)
    wanted = wanted.repeat(2, axis=0).repeat(2, axis=1)
    band, panel = np.nonzero(wanted)
    x, y = (corner[0] + panel) * size[1], (corner[1] + band) * size[0]
    quarters = Polynomials.through(function, x, y, size, [len(own) for own in found])
    right = quarters.right
    rest = ~right
    if disc is not None:  # no value at the points, and none nearest to the middle: none at all
        rest &= ~(quarters.empty & np.isnan(function(*disc.nearest(x, y, size))[0]))
    missing = ~(right | rest)
    for first, values in parts:
        given = _empty(len(values), (np.count_nonzero(right), *size), _are_side_by_side(values))
        quarters.write(right, first, given)
        values[:, band[right], panel[right]] = given
        values[:, band[missing], panel[missing]] = np.nan
    if smaller:
        wanted[band, panel] = rest
        if rest.any():
            _by_quarters(function, found, wanted, corner, rows, disc, smaller)
        return
    centers = _centers(size)
    spans = np.clip(np.array(rows) - (y - corner[1] * size[0])[:, None], 0, size[0])
    for span in np.unique(spans[rest], axis=0):  # all rows of most panels, some of the outer ones
        at = np.flatnonzero(rest & (spans == span).all(axis=1))
        for some in np.split(at, range(AT_ONCE, at.size, AT_ONCE)):
            inside = slice(*span)
            asked = function(x[some, None, None] + centers[0], y[some, None, None] + centers[1][inside])
            for own, value in zip(chain(*(values for _, values in parts)), asked, strict=True):
                own[band[some], panel[some], inside] = value


def _divided(found: list[np.ndarray], size: tuple[int, int]) -> list[tuple[int, np.ndarray]]:
    """View pictures (some, rows, columns) as panels of this size, (some, bands, panels, rows, columns), each with the
    number of the first of its values.
    """
    parts, first = [], 0
    for own in found:
        bands, panels = own.shape[1] // size[0], own.shape[2] // size[1]
        parts.append((first, own.reshape(len(own), bands, size[0], panels, size[1]).swapaxes(2, 3)))
        first += len(own)
    return parts


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
