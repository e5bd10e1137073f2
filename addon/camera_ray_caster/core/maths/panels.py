"""A function of the pixel for whole pictures, panel by panel of the raster: by polynomials wherever these are right.

Where they are not right in a panel, its quarters are tried, and theirs; in the smallest the function is evaluated at
each pixel. For fisheyes that take sines, or iterate, rays take 0.4 to 0.8 of the time, whole casts 0.6 to 0.9; for
models with ``by_polynomials`` what ``Camera.rays`` returns takes 0.3 to 0.8 of the time.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import chain
from math import floor

import numpy as np

from .chebyshev import PIECE, Polynomials, empty_like
from .speed import STRIP
from .vector import is_grid

SIZES = (180, 96), (90, 48), (45, 24)
"""Rows and columns of panels, and of the quarters that are tried in turn. Panels begin at multiples of these, so that a
pixel has the same one in whatever part of the picture; pictures of the usual sizes are whole panels. Panels of 72 by 64
alone, with 14 points: 1.2 to 1.4 times the time of rays that iterate. Without the smallest: 1.1 to 1.2 times that of
spherical stereo through a fisheye or with a pole merge.
"""

ROWS, COLUMNS = SIZES[0]

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

    def covers(self, x, y, size: tuple[int, int]) -> np.ndarray:
        """Return which panels with these corners lie wholly in it: their corners do."""
        corners = [self.holds(x + right, y + up) for right in (0, size[1]) for up in (0, size[0])]
        return np.logical_and.reduce(corners)

    def nearest(self, x, y, size: tuple[int, int]):
        """Return the x and y in panels with these corners that are nearest to the middle."""
        return np.clip(self.middle[0], x, x + size[1]), np.clip(self.middle[1], y, y + size[0])


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
    function's own error, the norm of the interpolation, and to each of the last coefficients, which are left out: at
    most ROUNDING of the vector's largest value in the panel.
    """
    if not is_raster(x, y):
        return function(x, y)
    (low, bands), (left, panels) = _panels(y[:, 0], ROWS), _panels(x[0], COLUMNS)
    shape = ROWS * len(bands), COLUMNS * len(panels)
    if out is None:
        found = [np.empty((count, *shape))]
    else:
        found = [own if own.shape[1:] == shape else empty_like(own, shape) for own in out]
    corners = panels[None] * COLUMNS, bands[:, None] * ROWS
    wanted = np.ones((len(bands), len(panels)), bool)
    if disc is not None:
        wanted &= disc.holds(*disc.nearest(*corners, SIZES[0]))
    first = panels[0], bands[0]
    _write(function, found, wanted.copy(), first, (low, low + y.size), disc, SIZES)
    if disc is not None:
        for _, values in _divided(found, SIZES[0]):
            values[:, ~wanted] = np.nan
        _end(found, wanted, first, disc)
    window = np.s_[:, low : low + y.size, left : left + x.size]
    for own, values in zip(out or (), found, strict=False):
        if values is not own:
            own[...] = values[window]
    return found[0][window]


def _write(function, found, wanted, corner, rows: tuple[int, int], disc: Disc | None, sizes) -> None:
    """Write the values in wanted panels, which have the first of these sizes, where they are of these rows: by
    polynomials; where these are not right by those of their quarters, and of theirs; at last each for itself.

    corner: the numbers of the first panel, in x and y.
    """
    size, *smaller = sizes
    parts = _divided(found, size)
    band, panel = np.nonzero(wanted)
    x, y = (corner[0] + panel) * size[1], (corner[1] + band) * size[0]
    polynomials = Polynomials.through(function, x, y, size, [len(own) for own in found])
    spans = np.clip(np.array(rows) - (band * size[0])[:, None], 0, size[0])
    for run in _runs(band, panel, polynomials.right):
        low, high = spans[run.start]
        for begin, values in parts:
            own = values[:, band[run.start], panel[run.start] : panel[run.stop - 1] + 1]
            polynomials.write(run, begin, own, slice(low // PIECE, -(-high // PIECE)))
    rest = ~polynomials.right
    if disc is not None and polynomials.empty.any():
        # No value at the points, and none nearest to the middle: none at all.
        missing = polynomials.empty & np.isnan(function(*disc.nearest(x, y, size))[0])
        rest &= ~missing
        for _, values in parts:
            values[:, band[missing], panel[missing]] = np.nan
    if smaller:
        wanted[band, panel] = rest
        if rest.any():
            wanted = wanted.repeat(2, axis=0).repeat(2, axis=1)
            _write(function, found, wanted, (2 * corner[0], 2 * corner[1]), rows, disc, smaller)
        return
    centers = _centers(size)
    for span in np.unique(spans[rest], axis=0):  # all rows of most panels, some of the outer ones
        at = np.flatnonzero(rest & (spans == span).all(axis=1))
        for some in _batches(at):
            inside = slice(*span)
            asked = function(x[some, None, None] + centers[0], y[some, None, None] + centers[1][inside])
            for own, value in zip(chain(*(values for _, values in parts)), asked, strict=True):
                own[band[some], panel[some], inside] = value


def _runs(band, panel, right) -> list[slice]:
    """Return those of panels that are right, as slices of neighbors in a band."""
    at = np.flatnonzero(right)
    ends = np.flatnonzero((np.diff(panel[at]) != 1) | (np.diff(band[at]) != 0)) + 1
    return [slice(run[0], run[-1] + 1) for run in np.split(at, ends) if run.size]


def _end(found, wanted, corner, disc: Disc) -> None:
    """Write NaN beyond the disc into wanted panels; corner: the numbers of the first, in x and y."""
    size, times = SIZES[-1], SIZES[0][0] // SIZES[-1][0]
    x, y = ((times * first + np.arange(times * count)) * side
            for first, count, side in zip(corner, wanted.shape[::-1], size[::-1], strict=True))  # fmt: skip
    wanted = wanted.repeat(times, axis=0).repeat(times, axis=1)
    parts, centers = _divided(found, size), _centers(size)
    for some in _batches(np.argwhere(wanted & ~disc.covers(x[None], y[:, None], size))):
        band, panel = some.T
        beyond = ~disc.holds(x[panel, None, None] + centers[0], y[band, None, None] + centers[1])
        for _, values in parts:
            there = values[:, band, panel]
            there[:, beyond] = np.nan
            values[:, band, panel] = there


def _batches(values: np.ndarray) -> list[np.ndarray]:
    """Split an array into parts of AT_ONCE."""
    return np.split(values, range(AT_ONCE, len(values), AT_ONCE))


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


def _panels(places, size: int):
    """Return how far into its panel the first pixel is, and the panels' numbers."""
    first = floor(places[0])
    return first % size, np.arange(first // size, (first + places.size - 1) // size + 1)
