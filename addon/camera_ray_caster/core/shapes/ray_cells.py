"""Triangles under any rays: in a small square of pixels the volumes of an edge are nearly linear in the pixel.

The rays of a cell, a square of pixels, are measured once: their directions, and their moments if they have many
origins, are linear functions of column and row up to the largest deviation of any ray of the cell. So is the volume of
an edge, a product with these, whose sign does not depend on the length of a direction. In a row of a cell it is
certainly positive up to one column and certainly negative from another one on; only the pixels between these two have
to be tested.
Reference: M. Olano and T. Greer, Triangle Scan Conversion using 2D Homogeneous Coordinates, 1997, for exact lines.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from ..conventions import EPS
from ..maths.speed import taken
from ..maths.vector import norm
from .cell_parts import LEAST_DOUBT, CellParts, PartRows, largest_of, rows_of
from .mesh.triangles import Planes
from .windows import counted

LEAST_DEPTH = 1 / 4
"""Rays are taken over their depth if all of a tile advance by more than this: those of a pinhole, or of two slits that
meet, are linear then, and few pixels are left to be tested. Of two slits half a meter apart 40,000 pixels in place of
553,000 are, in a street: 0.9 of the processor time of a cast.
"""

FUNCTION_ROUNDING = 64 * EPS
"""Error bound of a linear function of a direction, and of the cell's function that is close to it, over the sum of the
magnitudes of its terms; and of the distance of a place from a plane, over that from a corner.
"""

BEYOND = 1 + 2.0**-20
"""A triangle is hidden if its t are above those of the hits so far by this factor: it holds the rounding of t, also
where t is clamped (see ``crossing``).
"""


class Pixels(NamedTuple):
    """Triangles and pixels of a tile, (m,) each."""

    at: np.ndarray
    pixel: np.ndarray

    def only(self, mask: np.ndarray) -> Pixels:
        """Return some of them."""
        return Pixels(self.at[mask], self.pixel[mask])


class Runs(NamedTuple):
    """Triangles and pixels of a tile that follow one another in a row, (r,) each."""

    at: np.ndarray
    first: np.ndarray
    """The first pixel of each run."""
    length: np.ndarray

    def pieces(self, limit: int) -> Iterator[Pixels]:
        """Yield their triangles and pixels, about ``limit`` at once."""
        done = np.cumsum(self.length)
        cuts = np.searchsorted(done, np.arange(limit, done[-1] if len(done) else 0, limit))
        for piece in (slice(*ends) for ends in pairwise((0, *cuts.tolist(), len(done)))):
            run, pixel = counted(self.length[piece], self.first[piece])
            if len(run):
                yield Pixels(taken(self.at[piece], run), pixel)


class RayCells:
    """Squares of pixels of a tile, in rows of cells, and the linear functions to which the rays in each are close."""

    def __init__(self, direction: Any, moment: Any, shape: tuple[int, int], side: int, origin: Any = None):
        """Take components that broadcast to ``shape``, NaN where there is no ray; for the eye ``moment`` and ``origin``
        are None.
        """
        rows, self._wide = (-(-size // side) for size in shape)
        self._width, self._side = shape[1], side
        depth = np.negative(direction[2])
        scale = 1 / depth if np.ndim(depth) and np.fmin.reduce(depth, axis=None) > LEAST_DEPTH else None
        parts = [
            _linear(component if scale is None else component * scale, side)
            for component in (*direction, *(() if moment is None else moment))
        ]
        whole = [[np.broadcast_to(term, (rows, self._wide)).reshape(-1) for term in terms] for terms in parts]
        self._terms = np.array(whole).swapaxes(0, 1).copy()
        """(4, c, cells): the value at the first pixel, its changes by column and row, and the largest deviation."""
        self._scale = self._each(np.ones(()) if scale is None else scale, np.fmin)
        """(cells,): the least factor from t of rays as they are measured here to their t."""
        self._origins = None if origin is None else self._balls(origin)

    def _each(self, component: Any, extreme: np.ufunc) -> np.ndarray:
        """Return the least or largest value of a component in each cell, (cells,)."""
        for axis in range(np.ndim(component)):
            component = extreme.reduceat(component, np.arange(0, component.shape[axis], self._side), axis=axis)
        return np.broadcast_to(component, (self._terms.shape[2] // self._wide, self._wide)).reshape(-1)

    def _balls(self, origin: Any) -> np.ndarray:
        """Return the middle of the origins of each cell and a radius around it within which they lie, (4, cells)."""
        low, high = (
            np.nan_to_num([self._each(np.asarray(c, float), extreme) for c in origin]) for extreme in (np.fmin, np.fmax)
        )
        middle, radius = low / 2 + high / 2, norm(high - low) / 2
        return np.append(middle, [BEYOND * radius + FUNCTION_ROUNDING * norm(middle)], axis=0)

    def spans(
        self, edges: np.ndarray, doubt: np.ndarray, bounds: np.ndarray, turns: np.ndarray, planes: Planes,
        farthest: np.ndarray,
    ) -> tuple[Runs, Runs]:  # fmt: skip
        """Return the triangles and pixels of hits, and those that have to be tested, within bounds (k, 4), unless they
        lie beyond ``farthest``, t in each cell.

        edges: (3, c, k), the vectors whose products with a ray's direction and moment are the three ``volumes`` of a
        triangle, to ``doubt``, (k,). All of them are positive at a hit; of triangles ``turns``, by index, they may all
        be negative.
        """
        whole, turning = self._parts(edges, doubt, bounds, turns)
        each = [cells.only(np.flatnonzero(cells.meets())) for cells in (whole, whole.only(turning).turned())]
        parts = each[0]
        if turning.size:
            parts = CellParts(*(np.concatenate(values, -1) for values in zip(*each, strict=True)))
        parts = parts.only(np.flatnonzero(self._may_show(parts, planes, farthest.reshape(-1)))).narrowed()
        rows = rows_of(parts)
        return self._runs(parts, rows.at, rows.row, rows.first, rows.last), self._open(parts, rows)

    def windows(
        self, edges: np.ndarray, doubt: np.ndarray, bounds: np.ndarray, turns: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return triangles and windows, (p,) and (p, 4), outside of which no ray hits them; see ``spans``."""
        whole, turning = self._parts(edges, doubt, bounds, turns)
        meets = whole.meets()
        meets[turning] |= whole.only(turning).turned().meets()
        cells = whole.only(np.flatnonzero(meets))
        y, x = np.divmod(cells.pixel, self._width)
        return cells.at, np.stack((x + cells.x0, x + cells.x1 + 1, y + cells.y0, y + cells.y1 + 1), axis=1)

    def in_front(self, functions: np.ndarray, bounds: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return which bounds (k, 4) have cells in which, of linear functions of the direction, (n, 3, k), the first
        may be at least 0 and at least the magnitude of each other one, by index, and these bounds around such cells.
        """
        side, sizes = self._side - 1, np.abs(self._terms)
        sizes = sizes[0] + side * (sizes[1] + sizes[2])
        value, across, up = (np.einsum("nck,cp->nkp", functions, terms) for terms in self._terms[:3])
        doubt = np.einsum("nck,cp->nkp", np.abs(functions), self._terms[3] + FUNCTION_ROUNDING * sizes)
        least = value + side * (np.minimum(across, 0) + np.minimum(up, 0)) - doubt
        largest = value + side * (np.maximum(across, 0) + np.maximum(up, 0)) + doubt
        ahead = largest[0]
        meets = (ahead >= 0) & (least[1:] <= ahead).all(axis=0) & (largest[1:] >= -ahead).all(axis=0)
        meets, bounds = meets.reshape(len(bounds), -1, self._wide), bounds.copy()
        for axis in (1, 2):
            lines, ends = meets.any(axis=axis), bounds[:, 2 * axis - 2 : 2 * axis]
            first, last = lines.argmax(axis=1), lines.shape[1] - lines[:, ::-1].argmax(axis=1)
            np.clip(ends, (self._side * first)[:, None], (self._side * last)[:, None], out=ends)
        here = np.flatnonzero(meets.any(axis=(1, 2)) & (bounds[:, 0] < bounds[:, 1]) & (bounds[:, 2] < bounds[:, 3]))
        return here, bounds[here]

    def _may_show(self, parts: CellParts, planes: Planes, farthest: np.ndarray) -> np.ndarray:
        """Return which parts are not certainly behind the farthest t of their cells: the sum of the three volumes is
        the product of a triangle's normal and the direction.
        """
        y, x = np.divmod(parts.pixel, self._width)
        cell = y // self._side * self._wide + x // self._side
        origins = None if self._origins is None else taken(self._origins, cell)
        height = planes.heights(parts.at, origins, FUNCTION_ROUNDING)
        slope = largest_of(parts, parts.volumes.sum(axis=0)) + LEAST_DOUBT
        return ~(height * taken(self._scale, cell) > BEYOND * slope * taken(farthest, cell))

    def _parts(self, edges: np.ndarray, doubt: np.ndarray, bounds: np.ndarray, turns: np.ndarray):
        """Return the triangles in all cells of their bounds, and the indices of those that may turn: see ``spans``."""
        side = self._side
        x0, x1, y0, y1 = bounds.T.astype(np.intp)
        first, last = x0 // side, -(-x1 // side)
        at, row = counted(-(-y1 // side) - y0 // side, y0 // side)
        run, column = counted(taken(last - first, at), taken(first, at))
        at, row = taken(at, run), taken(row, run)
        terms = taken(self._terms, row * self._wide + column)
        volumes = np.empty((3, 4, len(at)))
        for volume, edge in zip(volumes, edges, strict=True):
            edge = taken(edge, at)
            for k in range(3):
                np.einsum("ij,ij->j", terms[k], edge, out=volume[k])
            np.einsum("ij,ij->j", terms[3], np.abs(edge, out=edge), out=volume[3])
        volumes[:, 3] += taken(doubt, at)
        x, y = side * column, side * row
        x0, x1 = np.maximum(taken(x0, at) - x, 0), np.minimum(taken(x1, at) - x, side) - 1
        y0, y1 = np.maximum(taken(y0, at) - y, 0), np.minimum(taken(y1, at) - y, side) - 1
        pixel = y * self._width + x
        may_turn = np.zeros(len(bounds), bool)
        may_turn[turns] = True
        return CellParts(at, pixel, volumes, x0, x1, y0, y1), np.flatnonzero(taken(may_turn, at))

    def _open(self, parts: CellParts, rows: PartRows) -> Runs:
        """Return the pixels of rows that may be hit and are not certainly."""
        none = rows.last < rows.first
        left = np.where(none, rows.largest, rows.first - 1)
        ends = (rows.least, left), (np.where(none, rows.largest + 1, rows.last + 1), rows.largest)
        runs = (self._runs(parts, rows.at, rows.row, first, last) for first, last in ends)
        return Runs(*map(np.concatenate, zip(*runs, strict=True)))

    def _runs(self, parts: CellParts, at: np.ndarray, row: np.ndarray, first: np.ndarray, last: np.ndarray) -> Runs:
        """Return the pixels from the first to the last column of rows of parts."""
        filled = np.flatnonzero(first <= last)
        at, row, first, last = (taken(each, filled) for each in (at, row, first, last))
        return Runs(taken(parts.at, at), first + taken(parts.pixel, at) + row * self._width, last - first + 1)


def _linear(component: Any, side: int) -> tuple[Any, Any, Any, Any]:
    """Return, for each cell of a component, (rows of cells, cells) or of size 1 where it broadcasts, its value at the
    first pixel, its changes by column and row, and its largest deviation from these; NaN is ignored.
    """
    if np.ndim(component) == 0:
        return float(component), 0.0, 0.0, 0.0
    values = np.asarray(component, np.float64)
    (rows, last_rows), (columns, last_columns) = (
        (first := np.arange(0, size, side), np.minimum(first + side, size) - 1) for size in values.shape
    )
    corners = [[taken(values[k], end) for end in (columns, last_columns)] for k in (rows, last_rows)]
    (low, low_right), (high, high_right) = corners
    wide, tall = np.maximum(last_columns - columns, 1), np.maximum(last_rows - rows, 1)[:, None]
    across = np.nan_to_num(((low_right - low) + (high_right - high)) / (2 * wide))
    up = np.nan_to_num(((high - low) + (high_right - low_right)) / (2 * tall))
    column = np.arange(values.shape[1])
    meant = taken(across, column // side) * (column % side)
    step = taken(up, column // side)
    least, largest = np.full((2, *meant.shape), np.nan)
    for k in range(min(side, len(values))):
        lines = values[k::side]
        off = lines - meant[: len(lines)]
        for extreme, end in ((least, np.fmin), (largest, np.fmax)):
            end(extreme[: len(lines)], off, out=extreme[: len(lines)])
        meant += step
    least, largest = np.fmin.reduceat(least, columns, axis=1), np.fmax.reduceat(largest, columns, axis=1)
    return least / 2 + largest / 2, across, up, largest / 2 - least / 2
