"""The nearest triangles of a tile so far, and which others they hide."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import tuning
from .kind import SearchRays

NONE = np.iinfo(np.int32).max
"""In place of a triangle where none is met."""

FOUND, NUMBER = "triangle found", "triangle"
"""Arrays of the scratch that keep each pixel's triangle: among those in view, and among those of its mesh."""


@dataclass(frozen=True, eq=False)
class Found:
    """The nearest triangles so far; of those at exactly the same t the first."""

    t: np.ndarray
    """inf, or that of another shape, where none is met."""
    which: np.ndarray
    """int32; NONE where none is met."""

    @classmethod
    def of(cls, nearest: np.ndarray, rays: SearchRays) -> Found:
        """Begin with what was found before; nothing behind that is kept."""
        t = rays.scratch("triangle t", rays.shape, np.float64)
        which = rays.scratch(FOUND, rays.shape, np.int32)
        np.copyto(t, nearest)
        which.fill(NONE)
        return cls(t, which)

    def keep(self, pixel: np.ndarray, t: np.ndarray, which: np.ndarray) -> None:
        """Note those that are the nearest so far; a pixel may have several."""
        nearest, first = self.t.reshape(-1), self.which.reshape(-1)
        before = nearest.take(pixel)
        closer = np.less(t, before)
        tied = np.flatnonzero(t == before)
        if tied.size:
            closer[tied] = which[tied] < first[pixel[tied]]
        if not closer.all():
            pixel, t, which = pixel[closer], t[closer], which[closer]
        while pixel.size:
            nearest[pixel], first[pixel] = t, which  # of several hits in one pixel the last stays: others try again
            lost = np.flatnonzero(first.take(pixel) != which)
            pixel, t, which = pixel[lost], t[lost], which[lost]
            now = nearest.take(pixel)
            nearer = (t < now) | ((t == now) & (which < first.take(pixel)))
            pixel, t, which = pixel[nearer], t[nearer], which[nearer]

    def fill(self, window: tuple[slice, slice], met: np.ndarray, t: np.ndarray, which: int) -> None:
        """Note one triangle in a window where it is met and is the nearest so far."""
        before, first = self.t[window], self.which[window]
        closer = (t < before) | ((t == before) & (which < first))
        closer &= met
        np.copyto(before, t, where=closer)
        np.copyto(first, which, where=closer)

    def may_show(self, bounds: np.ndarray, near: np.ndarray) -> np.ndarray:
        """Return which triangles may be seen, indices: all but small ones that lie behind what was found, whose least t
        are given, (k,), with their bounds in the tile, (k, 4).
        """
        wide, high = bounds[:, 1] - bounds[:, 0], bounds[:, 3] - bounds[:, 2]
        shows = np.maximum(wide, high) > tuning.CELL
        small = np.flatnonzero(~shows)
        x, y = (bounds[small, i] // tuning.CELL for i in (0, 2))
        shows[small] = near[small] <= _farthest(self.t, tuning.CELL)[y, x]
        return np.flatnonzero(shows)


def _farthest(t: np.ndarray, cell: int) -> np.ndarray:
    """Return the largest t of each cell and the next ones to the right and above."""
    height, width = (-(-size // cell) for size in t.shape)
    padded = np.full((height * cell, width * cell), -np.inf)
    padded[: t.shape[0], : t.shape[1]] = t
    cells = padded.reshape(height, cell, width * cell).max(axis=1).reshape(height, width, cell).max(axis=2)
    cells[:-1] = np.maximum(cells[:-1], cells[1:])
    cells[:, :-1] = np.maximum(cells[:, :-1], cells[:, 1:])
    return cells
