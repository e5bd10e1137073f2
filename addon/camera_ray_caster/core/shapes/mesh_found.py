"""The nearest triangles of a tile so far, and which other triangles they hide."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import tuning
from ..maths.speed import taken
from .search_rays import SearchRays

SEEN = "triangles seen"
"""Name under which the scratch notes the ``SeenTriangles`` of a tile, and of its array of each pixel's index there."""


@dataclass(frozen=True, eq=False)
class SeenTriangles:
    """The triangles that some pixel of a tile sees, (k,) each."""

    at: np.ndarray
    """Indices into ``Shapes``."""
    number: np.ndarray
    """Indices into the triangles of the mesh."""


@dataclass(frozen=True, eq=False)
class Found:
    """The nearest triangle of each pixel so far; of several at exactly the same t the first."""

    t: np.ndarray
    """t of the triangle; where no triangle is hit, inf or t of another shape."""
    which: np.ndarray
    """int32 indices of the triangles; ``count`` where none is hit."""
    count: int
    """Number of triangles."""

    @classmethod
    def of(cls, nearest: np.ndarray, rays: SearchRays, count: int) -> Found:
        """Begin with the t that were found before; no triangle behind these is kept."""
        t = rays.scratch("triangle t", rays.shape, np.float64)
        which = rays.scratch("triangle found", rays.shape, np.int32)
        np.copyto(t, nearest)
        which.fill(count)
        return cls(t, which, count)

    def seen(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the triangles that pixels see, ascending, and which of these each pixel sees, 0 for none."""
        place = np.zeros(self.count + 1, np.int32)
        place[self.which.reshape(-1)] = 1
        place[self.count] = 0
        seen = np.flatnonzero(place)
        place[seen] = np.arange(len(seen))
        return seen, taken(place, self.which)

    def keep(self, pixel: np.ndarray, t: np.ndarray, which: np.ndarray) -> None:
        """Note the hits that are the nearest so far; a pixel may have several."""
        nearest, first = self.t.reshape(-1), self.which.reshape(-1)
        while pixel.size:
            before = taken(nearest, pixel)
            closer = t < before
            tied = np.flatnonzero(t == before)
            if tied.size:
                closer[tied] = which[tied] < first[pixel[tied]]
            some = np.flatnonzero(closer)
            if len(some) < len(pixel):
                pixel, t, which = taken(pixel, some), taken(t, some), taken(which, some)
            nearest[pixel], first[pixel] = t, which  # of several hits in one pixel the last stays: others try again
            lost = np.flatnonzero(taken(first, pixel) != which)
            pixel, t, which = pixel[lost], t[lost], which[lost]

    def fill(self, window: tuple[slice, slice], met: np.ndarray, t: np.ndarray, which: int) -> None:
        """Note one triangle in a window, where it is hit and is the nearest so far."""
        before, first = self.t[window], self.which[window]
        closer = (t < before) | ((t == before) & (which < first))
        closer &= met
        np.copyto(before, t, where=closer)
        np.copyto(first, which, where=closer)

    def may_show(self, bounds: np.ndarray, near: np.ndarray) -> np.ndarray:
        """Return the indices of the triangles that may be seen: all except those that lie behind the hits so far. Given
        are their bounds in the tile, (k, 4), and lower bounds of their t, (k,).
        """
        x0, x1, y0, y1 = bounds.T
        column, row = x0 // tuning.CELL, y0 // tuning.CELL
        cells = np.maximum((x1 - 1) // tuning.CELL - column, (y1 - 1) // tuning.CELL - row) + 1
        most = int(cells.max(initial=1))
        farthest = _farthest(self.t, tuning.CELL, most)
        _, high, wide = farthest.shape
        level = np.frexp(np.arange(most) + 0.5)[1].astype(np.intp)  # exactly: of 1, 2, 3 and 4, 5 to 8 cells ...
        place = taken(level * (high * wide), cells - 1)
        place += row * np.intp(wide)
        place += column
        return np.flatnonzero(near <= taken(farthest.reshape(-1), place))


def _farthest(t: np.ndarray, cell: int, most: int) -> np.ndarray:
    """Return the largest t in the square of 1, 2, 4 ... cells a side that begins at each cell, to the right and
    upwards, until ``most`` are reached: (levels, rows, columns).
    """
    levels = [_largest(_largest(t, cell).T, cell).T]
    size = 1
    while size < most:
        cells = levels[-1].copy()
        np.maximum(cells[:-size], cells[size:], out=cells[:-size])
        np.maximum(cells[:, :-size], cells[:, size:], out=cells[:, :-size])
        levels.append(cells)
        size *= 2
    return np.array(levels)


def _largest(rows: np.ndarray, count: int) -> np.ndarray:
    """Return the elementwise maximum of each group of ``count`` consecutive rows; the last group may have fewer."""
    result = rows[::count].copy()
    for k in range(1, count):
        others = rows[k::count]
        np.maximum(result[: len(others)], others, out=result[: len(others)])
    return result
