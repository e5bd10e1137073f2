"""Triangles in cells of pixels, in which the volumes of edges are linear functions to a doubt: see ``ray_cells``."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .. import tuning
from ..maths.speed import taken
from .windows import counted

LEVEL = 1 / 64
"""An edge whose volume changes by less than this fraction of its doubt from column to column is taken as changing by
that, and its doubt is raised by what this adds in a cell.
"""

LEAST_DOUBT = 1e-280
"""Least doubt of a volume: divisions by it do not overflow."""

ALONG, ROW_MARGIN = 2.0**-20, 2.0**-10
"""Where the lines of two edges meet counts if the sine of their angle is above ALONG, and if it is at most 1 / (ALONG
ROW_MARGIN) pixels away, over that sine: rounding moves it by at most 1e-6 pixels then, and ROW_MARGIN, in pixels, holds
that.
"""


class CellParts(NamedTuple):
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

    def only(self, indices: np.ndarray) -> CellParts:
        return CellParts(*(taken(each, indices) for each in self))

    def turned(self) -> CellParts:
        """Return the triangles with their other sides: hits have volumes of the other sign."""
        return self._replace(volumes=self.volumes * np.array((-1, -1, -1, 1))[:, None])

    def meets(self) -> np.ndarray:
        """Return in which parts no edge is certainly missed."""
        return (largest_of(self, self.volumes.swapaxes(0, 1)) >= 0).all(axis=0)

    def narrowed(self) -> CellParts:
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
class PartRows:
    """Rows of parts, (n,) each: columns in which they may be hit, and in which they are certainly hit."""

    at: np.ndarray
    row: np.ndarray
    least: np.ndarray
    largest: np.ndarray
    first: np.ndarray
    last: np.ndarray


def largest_of(parts: CellParts, functions: np.ndarray) -> np.ndarray:
    """Return upper bounds of functions of the pixel in the parts: see ``CellParts.volumes``."""
    value, across, up, doubt = functions
    largest = value + doubt
    largest += np.maximum(across * parts.x0, across * parts.x1)
    largest += np.maximum(up * parts.y0, up * parts.y1)
    return largest


def rows_of(parts: CellParts) -> PartRows:
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
    return PartRows(at, row, *ends)
