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
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from .. import tuning
from ..maths.speed import taken
from .windows import counted

LEVEL = 1 / 64
"""An edge whose volume changes by less than this fraction of its doubt from column to column is taken as changing by
that, and its doubt is raised by what this adds in a cell.
"""

LEAST_DEPTH = 1 / 4
"""Rays are taken over their depth if all of a tile advance by more than this: those of a pinhole, or of two slits that
meet, are linear then, and few pixels are left to be tested. Of two slits half a meter apart 40,000 pixels in place of
553,000 are, in a street: 0.9 of the processor time of a cast.
"""

LEAST_DOUBT = 1e-280
"""Least doubt of a volume: divisions by it do not overflow."""

ALONG, ROW_MARGIN = 2.0**-20, 2.0**-10
"""Where the lines of two edges meet counts if the sine of their angle is above ALONG, and if it is at most 1 / (ALONG
ROW_MARGIN) pixels away, over that sine: rounding moves it by at most 1e-6 pixels then, and ROW_MARGIN, in pixels, holds
that.
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

    def __init__(self, direction: Any, moment: Any, shape: tuple[int, int], side: int):
        """Take components that broadcast to ``shape``, NaN where there is no ray; ``moment`` is None for the eye."""
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

    def spans(self, edges: np.ndarray, doubt: np.ndarray, bounds: np.ndarray, turns: np.ndarray) -> tuple[Runs, Runs]:
        """Return the triangles and pixels of hits, and those that have to be tested, within bounds (k, 4).

        edges: (3, c, k), the vectors whose products with a ray's direction and moment are the three ``volumes`` of a
        triangle, to ``doubt``, (k,). All of them are positive at a hit; of triangles ``turns``, by index, they may all
        be negative.
        """
        whole, turning = self._parts(edges, doubt, bounds, turns)
        each = [cells.only(np.flatnonzero(cells.meets())) for cells in (whole, whole.only(turning).turned())]
        parts = _Parts(*(np.concatenate(values, -1) for values in zip(*each, strict=True))) if turning.size else each[0]
        parts = parts.narrowed()
        rows = _rows(parts)
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
        return _Parts(at, pixel, volumes, x0, x1, y0, y1), np.flatnonzero(taken(may_turn, at))

    def _open(self, parts: _Parts, rows: _Rows) -> Runs:
        """Return the pixels of rows that may be hit and are not certainly."""
        none = rows.last < rows.first
        left = np.where(none, rows.largest, rows.first - 1)
        ends = (rows.least, left), (np.where(none, rows.largest + 1, rows.last + 1), rows.largest)
        runs = (self._runs(parts, rows.at, rows.row, first, last) for first, last in ends)
        return Runs(*map(np.concatenate, zip(*runs, strict=True)))

    def _runs(self, parts: _Parts, at: np.ndarray, row: np.ndarray, first: np.ndarray, last: np.ndarray) -> Runs:
        """Return the pixels from the first to the last column of rows of parts."""
        filled = np.flatnonzero(first <= last)
        at, row, first, last = (taken(each, filled) for each in (at, row, first, last))
        return Runs(taken(parts.at, at), first + taken(parts.pixel, at) + row * self._width, last - first + 1)


class _Parts(NamedTuple):
    """Triangles in cells, (p,) each."""

    at: np.ndarray
    pixel: np.ndarray
    """The first pixel of the cell in the tile."""
    volumes: np.ndarray
    """(3, 4, p): of each edge the volume at the first pixel of the cell, its changes by column and row, its doubt."""
    x0: np.ndarray
    """First column within the cell; then the last one, and the first and the last row."""
    x1: np.ndarray
    y0: np.ndarray
    y1: np.ndarray

    def only(self, indices: np.ndarray) -> _Parts:
        return _Parts(*(taken(each, indices) for each in self))

    def turned(self) -> _Parts:
        """Return the triangles with their other sides: hits have volumes of the other sign."""
        return self._replace(volumes=self.volumes * np.array((-1, -1, -1, 1))[:, None])

    def meets(self) -> np.ndarray:
        """Return in which parts no edge is certainly missed."""
        volume, across, up, doubt = self.volumes.swapaxes(0, 1)
        largest = volume + doubt
        largest += np.maximum(across * self.x0, across * self.x1)
        largest += np.maximum(up * self.y0, up * self.y1)
        return (largest >= 0).all(axis=0)

    def narrowed(self) -> _Parts:
        """Return the parts in fewer rows: the edges, moved outwards by their doubt, meet at the corners of a triangle,
        unless two are nearly parallel; no ray above or below these corners hits.
        """
        volume, across, up, doubt = self.volumes.swapaxes(0, 1)
        largest = volume + doubt
        next_across, next_up, next_largest = (each[[1, 2, 0]] for each in (across, up, largest))
        right, left = across * next_up, next_across * up
        turn, limit = right - left, ALONG * (np.abs(right) + np.abs(left))
        right, left = next_across * largest, across * next_largest
        limit = np.maximum(limit, ALONG * ROW_MARGIN * (np.abs(right) + np.abs(left)) + LEAST_DOUBT)
        is_triangle = (turn > limit).all(axis=0) | (turn < -limit).all(axis=0)
        corner = (right - left) / np.where(is_triangle, turn, 1.0)
        low = np.where(is_triangle, np.ceil(corner.min(axis=0) - ROW_MARGIN), -np.inf)
        high = np.where(is_triangle, np.floor(corner.max(axis=0) + ROW_MARGIN), np.inf)
        y0 = np.clip(low, self.y0, self.y1 + 1).astype(np.intp)
        return self._replace(y0=y0, y1=np.clip(high, y0 - 1, self.y1).astype(np.intp))


@dataclass(frozen=True, eq=False)
class _Rows:
    """Rows of parts, (n,) each: columns in which they may be hit, and in which they are certainly hit."""

    at: np.ndarray
    row: np.ndarray
    least: np.ndarray
    largest: np.ndarray
    first: np.ndarray
    last: np.ndarray


def _rows(parts: _Parts) -> _Rows:
    """Return the rows in which parts may be hit."""
    volume, across, up, doubt = parts.volumes.swapaxes(0, 1)
    doubt = np.maximum(doubt, LEAST_DOUBT)
    is_level = np.abs(across) < LEVEL * doubt
    across = np.where(is_level, LEVEL * doubt, across)
    doubt = np.where(is_level, (1 + 2 * LEVEL * tuning.RAY_CELL) * doubt, doubt)
    inverse = 1 / across
    at, row = counted(parts.y1 - parts.y0 + 1, parts.y0)
    moved = taken(-up * inverse, at) * row
    start, wide, begins = -volume * inverse, doubt * np.abs(inverse), inverse > 0

    def latest(sign: int) -> np.ndarray:
        return (taken(np.where(begins, start + sign * wide, -np.inf), at) + moved).max(axis=0)

    def earliest(sign: int) -> np.ndarray:
        return (taken(np.where(begins, np.inf, start + sign * wide), at) + moved).min(axis=0)

    least = np.maximum(np.ceil(latest(-1)), taken(parts.x0, at))
    largest = np.minimum(np.floor(earliest(1)), taken(parts.x1, at))
    met = np.flatnonzero(least <= largest)
    at, row, moved, least, largest = (taken(each, met) for each in (at, row, moved, least, largest))
    first, last = np.maximum(np.ceil(latest(1)), least), np.minimum(np.floor(earliest(-1)), largest)
    none = last < first
    first[none], last[none] = 0, -1
    ends = (each.astype(np.intp) for each in (least, largest, first, last))
    return _Rows(at, row, *ends)


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
