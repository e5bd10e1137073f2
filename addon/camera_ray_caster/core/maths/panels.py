"""A function of the pixel for whole pictures, panel by panel of the raster: by polynomials wherever these are accurate.

If they are not accurate in a panel, its quarters are tried; where these fail, too, the function is evaluated at each
pixel. For fisheyes that compute sines or iterate, whole casts take 0.6 to 0.9 of the time. The
result of ``Camera.rays`` takes 0.1 to 0.8 of the time. Models say where it pays: see ``Model.polynomials``.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import chain
from math import floor

import numpy as np

from .chebyshev import PIECE, Polynomials, empty_like
from .speed import STRIP, whole_rows
from .vector import is_grid

SIZES = (180, 96), (90, 48)
"""Rows and columns of panels, and of the quarters that are tried next. Panels begin at multiples of these, so that a
pixel is in the same panel whichever part of the picture is computed; pictures of the usual sizes are whole panels. With
panels of 72 by 64 only and 14 points, rays that iterate took 1.2 to 1.4 times the time. With quarters of the quarters,
eyes of spherical stereo took 0.95 to 1.3 times the time.
"""

ROWS, COLUMNS = SIZES[0]

PANELS_AT_ONCE = 8
"""Number of neighboring panels evaluated at each pixel in one call. 16: 1.0 to 1.25 times the time in a process that
has not used much memory yet, since C's malloc returns the working arrays to the system; later within 5 %.
"""

SMALLEST_SIZE = STRIP, 256
"""Smallest rows and columns for which polynomials pay; in smaller parts of a picture each pixel is evaluated."""


@dataclass(frozen=True)
class Disc:
    """An ellipse in pixel coordinates: the part of the picture in which a function's values count."""

    middle: tuple[float, float]
    holds: Callable
    """Function of x and y that returns whether they are within the ellipse."""

    def covers(self, x, y, size: tuple[int, int]) -> np.ndarray:
        """Return which panels with these corners lie entirely in the ellipse, as all four of their corners do."""
        corners = [self.holds(x + right, y + up) for right in (0, size[1]) for up in (0, size[0])]
        return np.logical_and.reduce(corners)

    def nearest(self, x, y, size: tuple[int, int]):
        """Return x and y of the points nearest to the middle, in panels with these corners."""
        return np.clip(self.middle[0], x, x + size[1]), np.clip(self.middle[1], y, y + size[0])


def is_raster(x, y) -> bool:
    """Return whether x and y are a row and a column of neighboring pixel centers, at least SMALLEST_SIZE."""
    return (
        is_grid(x, y)
        and x.ndim == 2
        and _are_centers(y[:, 0], SMALLEST_SIZE[0])
        and _are_centers(x[0], SMALLEST_SIZE[1])
    )


def _are_centers(places, fewest: int) -> bool:
    return places.size >= fewest and places[0] % 1 == 0.5 and bool((np.diff(places) == 1).all())


def on_raster(
    function: Callable, x, y, disc: Disc | None = None, count: int = 2, out: Sequence[np.ndarray] | None = None
):
    """Return a function's values at pixel coordinates, (count, rows, columns) on a raster; see ``is_raster``.

    The function takes x (..., 1, columns) and y (..., rows, 1), and returns ``count`` numbers or arrays of their common
    shape; if one of them is NaN, for no value, so are the others. Except on a raster, it is called directly. With a
    ``disc`` the values count only within the disc, and are NaN beyond; if the function is smooth beyond the disc, too,
    panels at the rim need no evaluation at each pixel. On a raster the arrays of ``out``, (some, rows, columns) with a
    pixel's values contiguous in memory, are filled one after the other; each holds a vector. The error is at most 8
    times the function's own error, 8 being the norm of the interpolation, plus the last coefficients, which are left
    out: each is at most COEFFICIENT_ROUNDING EPS of the vector's largest value in the panel.
    """
    if not is_raster(x, y):
        return function(x, y)
    (low, bands), (left, panels) = _panels(y[:, 0], ROWS), _panels(x[0], COLUMNS)
    shape = ROWS * len(bands), COLUMNS * len(panels)
    if out is None:
        pictures = [np.empty((count, *shape))]
    else:
        pictures = [picture if picture.shape[1:] == shape else empty_like(picture, shape) for picture in out]
    corners = panels[None] * COLUMNS, bands[:, None] * ROWS
    wanted = np.ones((len(bands), len(panels)), bool)
    if disc is not None:
        wanted &= disc.holds(*disc.nearest(*corners, SIZES[0]))
    first = panels[0], bands[0]
    _write(function, pictures, wanted.copy(), first, (low, low + y.size), disc, SIZES)
    if disc is not None:
        for _, values in _divided(pictures, SIZES[0]):
            values[:, ~wanted] = np.nan
        _end(pictures, wanted, first, disc)
    window = np.s_[:, low : low + y.size, left : left + x.size]
    for target, values in zip(out or (), pictures, strict=False):
        if values is not target:
            target[...] = values[window]
    return pictures[0][window]


def _write(function, pictures, wanted, corner, rows: tuple[int, int], disc: Disc | None, sizes) -> None:
    """Write the values in the ``wanted`` panels, of the first of ``sizes``, within ``rows``: by polynomials, else by
    polynomials of quarters, else by evaluation at each pixel.

    corner: the numbers of the first panel, in x and y.
    """
    size, *smaller = sizes
    parts = _divided(pictures, size)
    band, panel = np.nonzero(wanted)
    x, y = (corner[0] + panel) * size[1], (corner[1] + band) * size[0]
    polynomials = Polynomials.through(function, x, y, size, [len(picture) for picture in pictures])
    spans = np.clip(np.array(rows) - (band * size[0])[:, None], 0, size[0])
    for run in _runs(band, panel, polynomials.right, len(x)):
        low, high = spans[run.start]
        for begin, values in parts:
            target = values[:, band[run.start], panel[run.start] : panel[run.stop - 1] + 1]
            polynomials.write(run, begin, target, slice(low // PIECE, -(-high // PIECE)))
    remaining = ~polynomials.right
    if disc is not None and polynomials.empty.any():
        # No value at the points nor at the place nearest to the middle means no value in the panel.
        missing = polynomials.empty & np.isnan(function(*disc.nearest(x, y, size))[0])
        remaining &= ~missing
        for _, values in parts:
            values[:, band[missing], panel[missing]] = np.nan
    if smaller:
        wanted[band, panel] = remaining
        if remaining.any():
            wanted = wanted.repeat(2, axis=0).repeat(2, axis=1)
            _write(function, pictures, wanted, (2 * corner[0], 2 * corner[1]), rows, disc, smaller)
        return
    for run in _runs(band, panel, remaining, PANELS_AT_ONCE):
        low, high = spans[run.start]
        column, row = np.arange((run.stop - run.start) * size[1]), np.arange(low, high)[:, None]
        with whole_rows(column.size):
            # In three dimensions it is no raster: polynomials of a lens would round more than its formula.
            asked = function(x[run.start] + column[None, None] + 0.5, y[run.start] + row[None] + 0.5)
        top, left = band[run.start] * size[0], panel[run.start] * size[1]
        for picture, value in zip(chain(*pictures), asked, strict=True):
            picture[top + low : top + high, left : left + column.size] = value


def _runs(band, panel, selected, limit: int) -> list[slice]:
    """Return the panels ``selected`` as slices of neighbors in a band, of at most ``limit`` panels."""
    at = np.flatnonzero(selected)
    ends = np.flatnonzero((np.diff(panel[at]) != 1) | (np.diff(band[at]) != 0)) + 1
    runs = [slice(run[0], run[-1] + 1) for run in np.split(at, ends) if run.size]
    return [slice(k, min(k + limit, run.stop)) for run in runs for k in range(run.start, run.stop, limit)]


def _end(pictures, wanted, corner, disc: Disc) -> None:
    """Write NaN beyond the disc into the ``wanted`` panels; corner: the numbers of the first panel, in x and y."""
    size, parts = SIZES[0], _divided(pictures, SIZES[0])
    x, y = ((first + np.arange(count)) * side
            for first, count, side in zip(corner, wanted.shape[::-1], size[::-1], strict=True))  # fmt: skip
    columns, rows = np.arange(size[1])[None] + 0.5, np.arange(size[0])[:, None] + 0.5  # centers in a panel
    for band, panel in np.argwhere(wanted & ~disc.covers(x[None], y[:, None], size)):
        beyond = ~disc.holds(x[panel] + columns, y[band] + rows)
        for target in chain(*(values[:, band, panel] for _, values in parts)):  # all at once takes twice the time
            np.copyto(target, np.nan, where=beyond)


def _divided(pictures: list[np.ndarray], size: tuple[int, int]) -> list[tuple[int, np.ndarray]]:
    """Return views of pictures (some, rows, columns) as panels of this size, (some, bands, panels, rows, columns), each
    after the index of its first value among those of all pictures.
    """
    parts, first = [], 0
    for picture in pictures:
        bands, panels = picture.shape[1] // size[0], picture.shape[2] // size[1]
        parts.append((first, picture.reshape(len(picture), bands, size[0], panels, size[1]).swapaxes(2, 3)))
        first += len(picture)
    return parts


def _panels(places, size: int):
    """Return the offset of the first pixel in its panel, and the numbers of the panels."""
    first = floor(places[0])
    return first % size, np.arange(first // size, (first + places.size - 1) // size + 1)
