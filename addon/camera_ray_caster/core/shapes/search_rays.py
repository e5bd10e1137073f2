"""The rays of a tile in the form that the search for hits takes."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .. import tuning
from ..maths.speed import Scratch, lazy, taken
from ..maths.vector import cross, cut
from .ray_cells import RayCells

Crossings = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]
"""Of m crossings: the pixel of the tile, t, the index into ``Shapes`` and the triangle of its mesh or -1, (m,) each."""


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
    met: list[Crossings] | None = None
    """The crossings that the search meets, of which some may be behind the nearest hits; None if they are not asked
    for.
    """

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

    def note(self, corner: tuple[Any, Any], at: Any, t: Any, where: Any) -> None:
        """Note the crossings, if they are asked for, in k windows: see ``Candidates``, of which ``t`` has the shape."""
        if self.met is None:
            return
        rows, columns = (
            np.reshape(first, (-1, 1, 1)) + np.arange(count).reshape(shape)
            for first, count, shape in zip(corner, t.shape[1:], ((-1, 1), (1, -1)), strict=True)
        )
        is_met = (t < np.inf) if where is None else (t < np.inf) & where
        pixel, at = (np.broadcast_to(values, t.shape)[is_met] for values in (rows * self.shape[1] + columns, at))
        self.met.append((pixel, t[is_met], at, np.full(len(at), -1)))

    @lazy
    def moment(self) -> Any:
        """The cross products of origins and directions, in float64; None for rays from the eye."""
        if self.origin is None:
            return None
        return cross(tuple(np.asarray(component, float) for component in self.origin), self.direction)

    @lazy
    def origin_ball(self) -> tuple[np.ndarray, float]:
        """The middle of the origins, (3,), and a radius around it within which they lie."""
        ends = np.array([(np.fmin.reduce(c, axis=None), np.fmax.reduce(c, axis=None)) for c in self.origin])
        low, high = np.nan_to_num(ends.T)
        return low / 2 + high / 2, float(np.linalg.norm(high - low)) / 2

    @lazy
    def cells(self) -> RayCells:
        """The directions, and the moments of rays with many origins, in cells of the tile."""
        return RayCells(self.direction, self.moment, self.shape, tuning.RAY_CELL, self.origin)

    @lazy
    def wide_cells(self) -> RayCells:
        """Larger cells, for triangles with wide bounds."""
        return RayCells(self.direction, self.moment, self.shape, tuning.WIDE_CELL)

    def at(self, pixel: np.ndarray) -> tuple[np.ndarray | None, np.ndarray]:
        """Return the origins, None for the eye, and the directions at (m,) pixels of the tile, (3, m) float64 each."""
        return None if self.origin is None else self._at(self.origin, pixel), self._at(self.direction, pixel)

    def factors(self, pixel: np.ndarray) -> np.ndarray:
        """Return the directions, and the moments of rays with many origins, at (m,) pixels of the tile, (c, m)."""
        return self._at((*self.direction, *(self.moment or ())), pixel)

    def _at(self, components: Any, pixel: np.ndarray) -> np.ndarray:
        whole, values = math.prod(self.shape), np.empty((len(components), len(pixel)))
        row = column = pixel
        if any(1 < np.size(component) < whole for component in components):
            row, column = np.divmod(pixel, self.shape[1])  # two or three times as long as a lookup
        for out, component in zip(values, components, strict=True):
            if np.size(component) == 1:
                out[...] = component
            else:
                entry = pixel if component.size == whole else row if component.shape[1] == 1 else column
                out[...] = taken(component.reshape(-1), entry)
        return values
