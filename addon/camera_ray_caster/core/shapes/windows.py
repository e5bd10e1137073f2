"""Windows of a tile: the pixels in which small shapes are tested, many shapes at once."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from .. import tuning


def pixels_in(bounds: np.ndarray) -> np.ndarray:
    """Return how many pixels lie in bounds (n, 4), each x0, x1, y0, y1."""
    return (bounds[:, 1] - bounds[:, 0]) * (bounds[:, 3] - bounds[:, 2])


def in_tile(bounds: np.ndarray, corner: tuple[int, int], shape: tuple[int, int]) -> tuple[np.ndarray, np.ndarray]:
    """Return which of some bounds (n, 4) have a part in a tile, (k,), and these parts in the tile's pixels, (k, 4)."""
    (left, low), (high, wide) = corner, shape
    here = np.flatnonzero((bounds[:, 3] > low) & (bounds[:, 2] < low + high))  # most others lie below or above
    parts = bounds.take(here, axis=0)
    for column, first, size in zip(parts.T, (left, left, low, low), (wide, wide, high, high), strict=True):
        np.clip(column, first, first + size, out=column)  # column by column: rows of four are short loops
        column -= first
    some = np.flatnonzero((parts[:, 0] < parts[:, 1]) & (parts[:, 2] < parts[:, 3]))
    return (here, parts) if len(some) == len(here) else (here[some], parts[some])


def banded(bounds: np.ndarray, most: int) -> tuple[np.ndarray, np.ndarray]:
    """Return bounds (n, 4) cut into bands of rows with so many pixels at most, and which of them each is of."""
    rows = np.maximum(most // (bounds[:, 1] - bounds[:, 0]), 1)
    count = -(-(bounds[:, 3] - bounds[:, 2]) // rows)
    at = np.repeat(np.arange(len(bounds)), count)
    band = np.arange(len(at)) - np.repeat(np.cumsum(count) - count, count)
    parts = bounds[at]
    parts[:, 2] += band * rows[at]
    parts[:, 3] = np.minimum(parts[:, 3], parts[:, 2] + rows[at])
    return at, parts


def batches(bounds: np.ndarray) -> Iterator[np.ndarray]:
    """Yield rows of bounds of about the same size, as many as fill a batch of pixels."""
    size = np.maximum(bounds[:, 1] - bounds[:, 0], bounds[:, 3] - bounds[:, 2])
    step = np.ceil(4 * np.log2(np.maximum(size, 1)))
    for value in np.unique(step):
        alike = np.flatnonzero(step == value)
        pixels = (bounds[alike, 1] - bounds[alike, 0]).max() * (bounds[alike, 3] - bounds[alike, 2]).max()
        count = max(1, tuning.BATCH_PIXELS // pixels)
        for first in range(0, len(alike), count):
            yield alike[first : first + count]


def gather(component, y, x):
    """Return a broadcastable component at pixels given by a column of rows and a row of columns a shape."""
    if np.ndim(component) == 0:
        return component
    rows, columns = component.shape
    if rows == columns == 1:
        return component[None]
    return component[y if rows > 1 else 0, x if columns > 1 else 0]
