"""The rays of a tile in the form that the search for hits takes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import tuning
from ..maths.speed import Scratch, lazy, taken
from ..maths.vector import cross, cut, dot
from .windows import counted


@dataclass(frozen=True, eq=False)
class SearchRays:
    """The rays of a tile in the camera frame, in the precision of the search; components broadcast."""

    origin: Any
    """None for rays from the eye."""
    direction: Any
    corner: tuple[int, int]
    """First column and first row of the tile, in the pixels of the plan."""
    shape: tuple[int, int]
    """Rows and columns."""
    scratch: Scratch

    def within(self, window: tuple[slice, slice]) -> SearchRays:
        """Return the rays of some rows and columns of the tile."""
        (rows, columns), (first_column, first_row) = window, self.corner
        origin, direction = (  # copied once, not at each later lookup
            None if vector is None else tuple(np.array(cut(component, window)) for component in vector)
            for vector in (self.origin, self.direction)
        )
        corner = first_column + columns.start, first_row + rows.start
        shape = rows.stop - rows.start, columns.stop - columns.start
        return SearchRays(origin, direction, corner, shape, self.scratch)

    @lazy
    def moment(self) -> Any:
        """The cross products of origins and directions, in float64; None for rays from the eye."""
        if self.origin is None:
            return None
        return cross(tuple(np.asarray(component, float) for component in self.origin), self.direction)

    @lazy
    def present(self) -> Present:
        """The rays that exist: their directions are not NaN."""
        return Present(self.direction, self.shape)

    @lazy
    def cells(self) -> Cells:
        """The cells of the directions."""
        return Cells(self.direction, self.shape)

    def at(self, pixel: np.ndarray) -> tuple[np.ndarray | None, np.ndarray]:
        """Return the origins, None for the eye, and the directions at (m,) pixels of the tile, (3, m) float64 each."""
        row, column = np.divmod(pixel, self.shape[1])

        def at_pixels(vector):
            values = np.empty((3, len(pixel)))
            for own, component in zip(values, vector, strict=True):
                rows, columns = np.shape(component) or (1, 1)
                if rows == columns == 1:
                    own[...] = component
                else:
                    place = row if columns == 1 else column if rows == 1 else pixel
                    own[...] = taken(component.reshape(-1), place)
            return values

        return None if self.origin is None else at_pixels(self.origin), at_pixels(self.direction)


class Present:
    """The pixels of a tile that have a ray, row by row; the direction of other pixels is NaN."""

    def __init__(self, direction: Any, shape: tuple[int, int]):
        self._there = np.broadcast_to(~np.isnan(direction[0]), shape).reshape(-1)
        self._width = shape[1]

    @lazy
    def _pixels(self) -> np.ndarray:
        return np.flatnonzero(self._there)

    @lazy
    def _before(self) -> np.ndarray:
        """Number of rays before each pixel of the tile, followed by the number in the whole tile."""
        return np.append(0, np.cumsum(self._there))

    def within(self, bounds: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the pixels within bounds (k, 4) that have a ray, and the index of the bounds of each, (m,) both."""
        x0, x1, y0, y1 = bounds.T.astype(np.intp)
        at, row = counted(y1 - y0, y0)
        row *= self._width
        first = taken(self._before, row + taken(x0, at))
        run, ray = counted(taken(self._before, row + taken(x1, at)) - first, first)
        return taken(self._pixels, ray), taken(at, run)


class Cells:
    """Squares of pixels of a tile, and boxes that hold the directions of the rays in each; NaN is ignored."""

    def __init__(self, direction: Any, shape: tuple[int, int]):
        rows, columns = (np.arange(0, side, tuning.DIRECTIONS) for side in shape)
        whole = [np.broadcast_to(component, shape) for component in direction]
        low, high = (
            np.array([end.reduceat(end.reduceat(part, rows, axis=0), columns, axis=1) for part in whole])
            for end in (np.fmin, np.fmax)
        )
        self._middle, self._half = low / 2 + high / 2, high / 2 - low / 2

    def meeting(self, normals: Any, margin: float, bounds: list[int]) -> list[int] | None:
        """Return the part of bounds x0, x1, y0, y1 outside of which each direction has a product below -margin with one
        of some normals, three numbers each; None if that is so everywhere.
        """
        side = tuning.DIRECTIONS
        x0, x1, y0, y1 = bounds
        left, low = x0 // side, y0 // side
        window = np.s_[:, low : -(-y1 // side), left : -(-x1 // side)]
        middle, half = self._middle[window], self._half[window]
        meets = np.logical_and.reduce([dot(middle, n) + dot(half, np.abs(n)) >= -margin for n in normals])
        rows, columns = (np.flatnonzero(meets.any(axis=axis)) for axis in (1, 0))
        if not rows.size:
            return None
        return [
            max(x0, (left + columns[0]) * side),
            min(x1, (left + columns[-1] + 1) * side),
            max(y0, (low + rows[0]) * side),
            min(y1, (low + rows[-1] + 1) * side),
        ]
