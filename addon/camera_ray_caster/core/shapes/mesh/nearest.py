"""The nearest triangles of a tile so far, and which other triangles they hide."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ... import tuning
from ...maths.speed import taken
from ..search_rays import SearchRays


@dataclass(frozen=True, eq=False)
class SeenTriangles:
    """The triangles that some pixel of a tile sees: what the search knows of hits on meshes."""

    at: np.ndarray
    """(k,) indices into ``Shapes``."""
    number: np.ndarray
    """(k,) indices into the triangles of the mesh."""
    of_pixel: np.ndarray
    """(rows, columns): which of them each pixel of the tile sees; undefined where it sees no mesh."""
    noted: dict[str, Any] = field(default_factory=dict)
    """Results that have been computed for these triangles, by name."""


NONE = -1
"""In place of the number of a triangle, where none is hit."""


@dataclass(eq=False)
class Nearest:
    """The nearest triangle of each pixel so far; of several at exactly the same t the first."""

    t: np.ndarray
    """t of the triangle; where no triangle is hit, inf or t of another shape."""
    number: np.ndarray
    """int32 numbers of the triangles, see ``enter``; NONE where none is hit."""
    entered: list[np.ndarray] = field(default_factory=list)
    """The indices of the triangles that have numbers."""
    met: list[tuple[np.ndarray, np.ndarray, np.ndarray]] | None = None
    """Pixels, t and numbers of all hits; None if they are not asked for."""
    farthest: np.ndarray = field(init=False)
    """The farthest t in squares of RAY_CELL pixels, (rows, columns), when ``may_show`` was last asked."""
    _farthest: list[np.ndarray] = field(default_factory=list)
    """The largest t in the square of 1, 2, 4 ... cells a side that begins at each cell, to the right and upwards, as
    far as it was asked for since the last hit.
    """

    @classmethod
    def of(cls, nearest: np.ndarray, rays: SearchRays) -> Nearest:
        """Begin with the t that were found before; no triangle behind these is kept."""
        t = rays.scratch("triangle t", rays.shape, np.float64)
        number = rays.scratch("triangle found", rays.shape, np.int32)
        np.copyto(t, nearest)
        number.fill(NONE)
        return cls(t, number)

    def enter(self, indices: np.ndarray) -> np.ndarray:
        """Give triangles, by index, numbers: those that are tested are far fewer than those of a mesh."""
        first = sum(map(len, self.entered))
        self.entered.append(indices)
        return np.arange(first, first + len(indices))

    def seen(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the indices of the triangles that pixels see, and which of these each pixel sees, 0 for none."""
        indices = self._indices()
        is_seen = np.zeros(len(indices) + 1, bool)  # the last for NONE
        pixels = self.number.reshape(-1)  # most are like the one before
        is_seen[taken(pixels, np.flatnonzero(np.append(True, pixels[1:] != pixels[:-1])))] = True
        seen = np.flatnonzero(is_seen[:NONE])
        rank = np.zeros(len(is_seen), np.int32)
        rank[seen] = np.arange(len(seen))
        return indices[seen], taken(rank, self.number)

    def keep(self, pixel: np.ndarray, t: np.ndarray, number: np.ndarray) -> None:
        """Note the hits that are the nearest so far; a pixel may have several."""
        self._farthest.clear()
        if self.met is not None:
            self.met.append((pixel, t, number))
        nearest, first = self.t.reshape(-1), self.number.reshape(-1)
        while pixel.size:
            before = taken(nearest, pixel)
            closer = t < before
            tied = np.flatnonzero(t == before)
            if tied.size:
                closer[tied] = self._precede(number[tied], first[pixel[tied]])
            nearer = np.flatnonzero(closer)
            if len(nearer) < len(pixel):
                pixel, t, number = taken(pixel, nearer), taken(t, nearer), taken(number, nearer)
            nearest[pixel], first[pixel] = t, number  # of several hits in a pixel the last stays: others try again
            lost = np.flatnonzero(taken(first, pixel) != number)
            pixel, t, number = pixel[lost], t[lost], number[lost]

    def _precede(self, number: Any, other: np.ndarray) -> np.ndarray:
        """Return whether triangles have lower indices than others; any triangle precedes NONE."""
        indices = self._indices()
        return (other == NONE) | (indices[number] < indices[other])

    def entry(self, number: np.ndarray) -> np.ndarray:
        """Return the indices of triangles by their numbers."""
        return self._indices()[number]

    def _indices(self) -> np.ndarray:
        """The indices of all triangles that have numbers."""
        self.entered[:] = [np.concatenate(self.entered)] if self.entered else [np.zeros(0, np.intp)]
        return self.entered[0]

    def may_show(self, bounds: np.ndarray, near: np.ndarray) -> np.ndarray:
        """Return the indices of the hulls that may be seen: all except those that lie behind the hits so far. Given
        are their bounds in the tile, (k, 4), and lower bounds of their t, (k,).
        """
        x0, x1, y0, y1 = bounds.T
        column, row = x0 // tuning.CELL, y0 // tuning.CELL
        cells = np.maximum((x1 - 1) // tuning.CELL - column, (y1 - 1) // tuning.CELL - row) + 1
        largest = int(cells.max(initial=1))
        farthest, side = self._cells(largest), tuning.RAY_CELL // tuning.CELL
        self.farthest = _largest(_largest(farthest[0], side).T, side).T
        _, high, wide = farthest.shape
        level = np.frexp(np.arange(largest) + 0.5)[1].astype(np.intp)  # exactly: of 1, 2, 3 and 4, 5 to 8 cells ...
        entry = taken(level * (high * wide), cells - 1)
        entry += row * np.intp(wide)
        entry += column
        return np.flatnonzero(near <= taken(farthest.reshape(-1), entry))

    def _cells(self, largest: int) -> np.ndarray:
        """Return the farthest t in squares of up to ``largest`` cells, (levels, rows, columns)."""
        levels = self._farthest
        if not levels:
            levels.append(_largest(_largest(self.t, tuning.CELL).T, tuning.CELL).T)
        while (size := 1 << len(levels) - 1) < largest:
            cells = levels[-1].copy()
            np.maximum(cells[:-size], cells[size:], out=cells[:-size])
            np.maximum(cells[:, :-size], cells[:, size:], out=cells[:, :-size])
            levels.append(cells)
        return np.array(levels)


def _largest(rows: np.ndarray, count: int) -> np.ndarray:
    """Return the elementwise maximum of each group of ``count`` consecutive rows; the last group may have fewer."""
    result = rows[::count].copy()
    for k in range(1, count):
        others = rows[k::count]
        np.maximum(result[: len(others)], others, out=result[: len(others)])
    return result
