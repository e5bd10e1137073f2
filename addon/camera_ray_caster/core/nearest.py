"""The nearest hit of every ray of a tile: shape by shape, or many small shapes at once."""

from __future__ import annotations

from dataclasses import dataclass
from math import prod
from typing import Any

import numpy as np

from .hits import NOTHING, Hits, cut
from .plan import BLOCK_PIXELS, SMALL_PIXELS, Group, Plan


def nearest(plan: Plan, origin, direction, from_eye: bool, corner, scratch: Scratch) -> Hits:
    """Return the nearest hits within the clip range of rays given as camera-frame components, (rows, columns).

    corner: the column and row of the render window at which the rays begin. Of shapes hit at exactly the same t
    the one with the lowest index counts, whatever order they are tested in.
    """
    shape = np.broadcast_shapes(*map(np.shape, origin), *map(np.shape, direction), (1, 1))
    end = plan.real(plan.camera.clip_end)
    tile = Tile(
        None if from_eye else _rounded(origin, plan.real),
        _rounded(direction, plan.real),
        plan.camera.clip_start,
        np.full(shape, np.nextafter(end, plan.real(np.inf)), plan.real),
        np.full(shape, NOTHING, np.int32),
        scratch,
    )
    small = []
    large = []
    for group in plan.groups:
        edges = np.clip(group.bounds - np.repeat(corner, 2), 0, np.repeat(shape[::-1], 2))
        here = np.flatnonzero((edges[:, 0] < edges[:, 1]) & (edges[:, 2] < edges[:, 3]))
        bounds = edges[here]
        few = (bounds[:, 1] - bounds[:, 0]) * (bounds[:, 3] - bounds[:, 2]) < SMALL_PIXELS
        large += [(group, *one) for one in zip(here[~few].tolist(), bounds[~few].tolist(), strict=True)]
        small += [(group, here[few][batch], bounds[few][batch]) for batch in _batches(bounds[few])]
    for group, row, bounds in sorted(large, key=lambda one: one[0].at[one[1]]):
        tile.cast_one(group, row, bounds)
    for group, rows_of_batch, bounds in small:
        tile.cast_batch(group, rows_of_batch, bounds)
    tile.t[tile.index == NOTHING] = np.inf
    return Hits(plan, from_eye, origin, direction, tile.t, tile.index, corner)


class Scratch:
    """Working arrays of one thread, lent again and again: asking the system for memory costs more than arithmetic."""

    def __init__(self, real):
        self._real = real
        self._arrays = [np.empty(0, real)] * 3

    def __call__(self, i: int, shape) -> np.ndarray:
        """Return the i-th array in this shape; what it held is lost."""
        size = prod(shape)
        if self._arrays[i].size < size:
            self._arrays[i] = np.empty(size, self._real)
        return self._arrays[i][:size].reshape(shape)


@dataclass(frozen=True)
class Tile:
    """The rays of whole rows of the window, and the nearest hits so far."""

    origin: Any
    """None for rays from the eye."""
    direction: Any
    start: float
    t: np.ndarray
    """The nearest t so far; the first number beyond the clip end where nothing was hit."""
    index: np.ndarray
    scratch: Scratch

    def cast_one(self, group: Group, row: int, bounds) -> None:
        """Test one shape at the pixels of its bounds, block by block; to be called in the order of shape indices."""
        x0, x1, y0, y1 = bounds
        window = slice(y0, y1), slice(x0, x1)
        all_t, all_index = self.t[window], self.index[window]
        for block, found, where in self._blocks(group, _take(group.view, row), window):
            t, index = all_t[block], all_index[block]
            closer = found < t
            if where is not None:
                closer &= where
                np.copyto(t, found, where=closer)
            else:
                np.fmin(t, found, out=t)
            np.copyto(index, group.at[row], where=closer)

    def _blocks(self, group: Group, view, window):
        """Yield (rows of the window, t, where) of one shape, in blocks."""
        (top, bottom), columns = (window[0].start, window[0].stop), window[1]
        step = max(1, BLOCK_PIXELS // (columns.stop - columns.start))
        direction = tuple(cut(component, window) for component in self.direction)
        if group.simple and self.origin is None and _is_pinhole(direction):
            yield from group.shape.near_blocks(view, group.kind, direction, step, self.scratch)
            return
        for first in range(top, bottom, step):
            part = slice(first, min(first + step, bottom)), columns
            found = self._intersect(group, view, lambda component, part=part: cut(component, part))
            yield slice(part[0].start - top, part[0].stop - top), *found

    def cast_batch(self, group: Group, at, bounds) -> None:
        """Test many small shapes at once: arrays (shapes, rows, columns) as large as the largest bounds."""
        x0, x1, y0, y1 = (edge[:, None, None] for edge in bounds.T)
        height, width = self.t.shape
        y = y0 + np.arange((y1 - y0).max())[:, None]
        x = x0 + np.arange((x1 - x0).max())
        inside = (y < y1) & (x < x1)
        y, x = np.minimum(y, height - 1), np.minimum(x, width - 1)
        view = _take(group.view, at, axes=(1, 1))
        found, where = self._intersect(group, view, lambda component: _gather(component, y, x))
        t, index = self.t.reshape(-1), self.index.reshape(-1)
        pixel = y * width + x
        inside &= found <= t[pixel]
        if where is not None:
            inside &= where
        pixel, found = pixel[inside], np.broadcast_to(found, inside.shape)[inside]
        k = np.broadcast_to(group.at[at][:, None, None], inside.shape)[inside]
        before = t[pixel]
        np.minimum.at(t, pixel, found)
        won = found == t[pixel]
        won &= (found < before) | (k < index[pixel])
        index[pixel[won][::-1]] = k[won][::-1]  # of equals the first, the lowest index, is written last

    def _intersect(self, group: Group, view, part):
        origin = None if self.origin is None else tuple(map(part, self.origin))
        start = None if group.simple else self.start
        direction = tuple(map(part, self.direction))
        return group.shape.intersect(view, group.kind, origin, direction, start, self.scratch)


def _rounded(vector, real):
    """Return components as float32 where that is what is calculated with; as they are otherwise."""
    return vector if real is np.float64 else tuple(np.asarray(component, real) for component in vector)


def _is_pinhole(direction) -> bool:
    """Whether x is a row, y a column and z a number."""
    x, y, z = direction
    return np.ndim(z) == 0 and np.ndim(x) == np.ndim(y) == 2 and x.shape[0] == y.shape[1] == 1


def _take(view, at, axes=()):
    """Return a view's constants of one row, or of many rows with axes put in that broadcast with the rays."""
    values = {name: getattr(view, name)[at] for name in view.__dataclass_fields__}
    return type(view)(**{k: v.reshape(len(v), *axes, *v.shape[1:]) if axes else v for k, v in values.items()})


def _batches(bounds):
    """Yield rows of shapes with bounds of about the same size, as many as fill some blocks."""
    size = np.maximum(bounds[:, 1] - bounds[:, 0], bounds[:, 3] - bounds[:, 2])
    step = np.ceil(4 * np.log2(np.maximum(size, 1)))
    for value in np.unique(step):
        alike = np.flatnonzero(step == value)
        pixels = (bounds[alike, 1] - bounds[alike, 0]).max() * (bounds[alike, 3] - bounds[alike, 2]).max()
        count = max(1, 2 * BLOCK_PIXELS // pixels)
        for first in range(0, len(alike), count):
            yield alike[first : first + count]


def _gather(component, y, x):
    """Return a broadcastable component at pixels given by a column of rows and a row of columns a shape."""
    if np.ndim(component) == 0:
        return component
    rows, columns = component.shape
    return component[y if rows > 1 else 0, x if columns > 1 else 0]
