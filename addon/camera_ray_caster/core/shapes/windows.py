"""Windows of a tile: the pixels in which small shapes are tested, many shapes at once."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import tuning
from ..maths.speed import taken


def pixels_in(bounds: np.ndarray) -> np.ndarray:
    """Return how many pixels lie in bounds (n, 4), each x0, x1, y0, y1."""
    return (bounds[:, 1] - bounds[:, 0]) * (bounds[:, 3] - bounds[:, 2])


def in_tile(bounds: np.ndarray, corner: tuple[int, int], shape: tuple[int, int]) -> tuple[np.ndarray, np.ndarray]:
    """Return which bounds (n, 4) overlap a tile, (k,), and their parts in the tile, in its pixels, (k, 4)."""
    (left, low), (high, wide) = corner, shape
    here = np.flatnonzero((bounds[:, 3] > low) & (bounds[:, 2] < low + high))  # most others lie below or above
    parts = bounds.take(here, axis=0)
    for column, first, size in zip(parts.T, (left, left, low, low), (wide, wide, high, high), strict=True):
        np.clip(column, first, first + size, out=column)  # column by column: rows of four are short loops
        column -= first
    inside = np.flatnonzero((parts[:, 0] < parts[:, 1]) & (parts[:, 2] < parts[:, 3]))
    return (here, parts) if len(inside) == len(here) else (here[inside], parts[inside])


def union(bounds: np.ndarray) -> tuple[slice, slice]:
    """Return the smallest rows and columns that hold all bounds (n, 4); n is not 0."""
    x0, x1, y0, y1 = bounds.T
    return slice(int(y0.min()), int(y1.max())), slice(int(x0.min()), int(x1.max()))


def banded(bounds: np.ndarray, limit: int) -> tuple[np.ndarray, np.ndarray]:
    """Cut bounds (n, 4) into bands of rows with at most ``limit`` pixels, or of one row. Return for each band the index
    of its bounds, (k,), and the band, (k, 4).
    """
    if (pixels_in(bounds) <= limit).all():
        return np.arange(len(bounds)), bounds
    rows = np.maximum(limit // (bounds[:, 1] - bounds[:, 0]), 1)
    count = -(-(bounds[:, 3] - bounds[:, 2]) // rows)
    at = np.repeat(np.arange(len(bounds)), count)
    band = np.arange(len(at)) - np.repeat(np.cumsum(count) - count, count)
    parts = bounds[at]
    parts[:, 2] += band * rows[at]
    parts[:, 3] = np.minimum(parts[:, 3], parts[:, 2] + rows[at])
    return at, parts


def batches(bounds: np.ndarray) -> Iterator[np.ndarray]:
    """Yield indices of bounds of about the same size, as many at once as fill a batch of pixels."""
    size = np.maximum(bounds[:, 1] - bounds[:, 0], bounds[:, 3] - bounds[:, 2])
    step = np.ceil(4 * np.log2(np.maximum(size, 1)))
    for value in np.unique(step):
        alike = np.flatnonzero(step == value)
        pixels = (bounds[alike, 1] - bounds[alike, 0]).max() * (bounds[alike, 3] - bounds[alike, 2]).max()
        count = max(1, tuning.BATCH_PIXELS // pixels)
        for first in range(0, len(alike), count):
            yield alike[first : first + count]


@dataclass(frozen=True, eq=False)
class Windows:
    """Windows of a tile that all have the largest height and width of some bounds, shifted to lie in the tile."""

    row: np.ndarray
    """(k,) lowest row of each window."""
    column: np.ndarray
    """(k,) leftmost column of each window."""
    size: tuple[int, int]
    """Rows and columns of every window."""
    width: int
    """Columns of the tile."""

    @classmethod
    def around(cls, bounds: np.ndarray, shape: tuple[int, int]) -> Windows:
        """Return the windows of bounds, (k, 4), in a tile with ``shape`` rows and columns."""
        x0, x1, y0, y1 = bounds.T.astype(np.intp)
        high, wide = int((y1 - y0).max()), int((x1 - x0).max())
        return cls(np.minimum(y0, shape[0] - high), np.minimum(x0, shape[1] - wide), (high, wide), shape[1])

    def of(self, component: Any) -> Any:
        """Return a component of the tile's rays in each window, (k, rows, columns); a row stays a row."""
        if np.ndim(component) == 0:
            return component
        rows, columns = component.shape
        if rows == columns == 1:
            return component[None]
        y = self.row[:, None, None] + np.arange(self.size[0])[:, None] if rows > 1 else 0
        x = self.column[:, None, None] + np.arange(self.size[1]) if columns > 1 else 0
        return component[y, x]


def counted(count: np.ndarray, first: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the numbers of some runs, each given by its count and its first number, one run after the other: the index
    of the run of each number, and the number.
    """
    at = np.repeat(np.arange(len(count)), count)
    number = np.arange(len(at))
    number += taken(first - (np.cumsum(count) - count), at)
    return at, number
