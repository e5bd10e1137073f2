"""The rays of a tile in the form that the search for hits takes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .. import tuning
from ..maths.speed import Scratch, lazy, taken
from ..maths.vector import cross, cut
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
    """Working arrays of the kinds; their content is lost when another shape is tested."""
    nearest: np.ndarray | None = None
    """t of the nearest hits so far, (rows, columns), if shapes with transparent points need it."""
    known: dict[int, Any] = field(default_factory=dict)
    """What kinds know of the hits of the tile besides t and shape, by number of the kind; it travels with the hits."""

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
        """The directions, and the moments of rays with many origins, in cells of the tile."""
        return Cells(self.direction, self.moment, self.shape)

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
    """Squares of pixels of a tile, and boxes that hold the directions of the rays in each, and their moments if these
    are given; NaN is ignored.
    """

    def __init__(self, direction: Any, moment: Any, shape: tuple[int, int]):
        """Take components that broadcast to ``shape``; ``moment`` may be None."""
        rows, columns = (np.arange(0, side, tuning.DIRECTIONS) for side in shape)
        whole = [np.broadcast_to(component, shape) for component in (*direction, *(() if moment is None else moment))]
        low, high = (
            np.array([end.reduceat(end.reduceat(part, rows, axis=0), columns, axis=1) for part in whole], np.float64)
            for end in (np.fmin, np.fmax)
        )
        self._wide, self._from_eye = len(columns), moment is None
        self._middle, self._half = ((high / 2 + sign * low / 2).reshape(len(whole), -1) for sign in (1, -1))

    def parts(self, edges: np.ndarray, margin: np.ndarray, bounds: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the cells of bounds (k, 4) in which some ray may hit a triangle: the index of the bounds, (p,), and
        their part in the cell, (p, 4).

        edges: (3, c, k), the vectors whose products with a ray's direction and moment are the three ``volumes`` of a
        triangle. All of them are -margin, (k,), or more at a hit, or, of rays with moments, margin or less.
        """
        side = tuning.DIRECTIONS
        x0, x1, y0, y1 = bounds.T.astype(np.intp)
        first, last = x0 // side, -(-x1 // side)
        at, row = counted(-(-y1 // side) - y0 // side, y0 // side)
        run, column = counted(taken(last - first, at), taken(first, at))
        at, row = taken(at, run), taken(row, run)
        cell = row * self._wide + column
        middle, half = taken(self._middle, cell), taken(self._half, cell)
        margin = taken(margin, at)
        above, below = np.ones(len(at), bool), np.full(len(at), not self._from_eye)
        for edge in edges:
            own = taken(edge, at)
            product, reach = np.einsum("ij,ij->j", middle, own), np.einsum("ij,ij->j", half, np.abs(own))
            reach += margin
            above &= product >= -reach
            below &= product <= reach
        some = np.flatnonzero(above | below)
        at, x, y = taken(at, some), side * taken(column, some), side * taken(row, some)
        ends = (np.maximum(x, taken(x0, at)), np.minimum(x + side, taken(x1, at)),
                np.maximum(y, taken(y0, at)), np.minimum(y + side, taken(y1, at)))  # fmt: skip
        return at, np.stack(ends, axis=1)
