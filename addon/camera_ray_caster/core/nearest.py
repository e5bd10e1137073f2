"""The nearest hit of every ray of a tile: shape by shape, or many small shapes at once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from .hits import NOTHING, Hits, cut
from .loops import MULTIPLE, Scratch, whole_rows
from .plan import Group, Plan

BATCH_PIXELS = 1 << 16
"""Pixels of the bounds of the small shapes that are cast at once: the working arrays stay in a core's cache."""


def nearest(plan: Plan, origin, direction, from_eye: bool, corner, scratch: Scratch) -> Hits:
    """Return the nearest hits within the clip range of rays given as camera-frame components, (rows, columns).

    corner: the column and row of the render window at which the rays begin. Of shapes hit at exactly the same t
    the one with the lowest index counts, whatever order they are tested in. The hits lie in ``scratch``.
    """
    shape = np.broadcast_shapes(*map(np.shape, origin), *map(np.shape, direction), (1, 1))
    tile = Tile(
        None if from_eye else _rounded(origin, plan.real),
        _rounded(direction, plan.real),
        plan.camera.clip_start,
        scratch("t", shape),
        scratch("index", shape, np.int32),
        scratch,
    )
    tile.t.fill(np.inf)
    tile.index.fill(NOTHING)
    large = []
    for group in plan.groups:
        at, bounds = group.within(corner, shape)
        if group.small:
            for batch in _batches(bounds):
                tile.cast_batch(group, at[batch], bounds[batch])
        else:
            large += [(group, *one) for one in zip(at.tolist(), bounds.tolist(), strict=True)]
    for group, row, bounds in sorted(large, key=lambda one: one[0].at[one[1]]):
        tile.cast_one(group, row, bounds)
    if plan.clips:
        beyond = np.greater(tile.t, plan.real(plan.camera.clip_end), out=scratch("closer", shape, bool))
        np.copyto(tile.index, NOTHING, where=beyond)
        np.copyto(tile.t, np.inf, where=beyond)
    return Hits(plan, from_eye, origin, direction, tile.t, tile.index, scratch, corner)


@dataclass(frozen=True)
class Tile:
    """The rays of a part of the window, and the nearest hits so far."""

    origin: Any
    """None for rays from the eye."""
    direction: Any
    start: float
    t: np.ndarray
    """The nearest t so far, inf where nothing was hit; it may lie beyond the clip end, where all others do, too."""
    index: np.ndarray
    scratch: Scratch

    def cast_one(self, group: Group, row: int, bounds) -> None:
        """Test one shape at the pixels of its bounds."""
        window = _widened(bounds, self.t.shape[1])
        with whole_rows(window[1].stop - window[1].start):
            found, where = self._intersect(group, group.constants(row), lambda component: cut(component, window))
            if found is not None:
                self._keep(window, found, where, group.at[row])

    def cast_batch(self, group: Group, at, bounds) -> None:
        """Test many small shapes at once: windows as large as the largest bounds, moved until they lie in the tile."""
        x0, x1, y0, y1 = bounds.T
        wide, high = int((x1 - x0).max()), int((y1 - y0).max())
        x0, y0 = np.minimum(x0, self.t.shape[1] - wide), np.minimum(y0, self.t.shape[0] - high)
        x = x0[:, None, None] + np.arange(wide)
        y = y0[:, None, None] + np.arange(high)[:, None]
        view = group.constants(at, axes=(1, 1))
        found, where = self._intersect(group, view, lambda component: _gather(component, y, x))
        self._keep_listed(y * self.t.shape[1] + x, np.broadcast_to(found, (len(at), high, wide)), where, group.at[at])

    def _keep(self, window, found, where, shape: int) -> None:
        """Note the hits of one shape in a window that are nearer than those of all shapes with lower indices."""
        t, index = self.t[window], self.index[window]
        closer = np.less(found, t, out=self.scratch("closer", t.shape, bool))
        if where is None:
            np.fmin(t, found, out=t)
        else:
            closer &= where
            np.copyto(t, found, where=closer)
        np.copyto(index, shape, where=closer)

    def _keep_listed(self, pixel, found, where, shapes) -> None:
        """Note the hits of many shapes, each in its own window, that are the nearest so far, whatever their order."""
        t, index = self.t.reshape(-1), self.index.reshape(-1)
        closer = found <= t[pixel]
        if where is not None:
            closer &= where
        hits = np.flatnonzero(closer)[::-1]  # of equals the first is then written last, and stays
        shape = shapes[hits // (pixel.size // len(pixel))]
        pixel, found = pixel.reshape(-1)[hits], found.reshape(-1)[hits]
        while pixel.size:  # of several hits in one pixel the last is written: what is nearer still tries again
            before = t[pixel]
            won = (found < before) | ((found == before) & (shape < index[pixel]))
            pixel, found, shape = pixel[won], found[won], shape[won]
            t[pixel] = found
            index[pixel] = shape

    def _intersect(self, group: Group, view, part):
        origin = None if self.origin is None else tuple(map(part, self.origin))
        start = None if group.simple else self.start
        direction = tuple(map(part, self.direction))
        return group.shape.intersect(view, group.kind, origin, direction, start, self.scratch)


def _rounded(vector, real):
    """Return components as float32 where that is what is calculated with; as they are otherwise."""
    return vector if real is np.float64 else tuple(np.asarray(component, real) for component in vector)


def _widened(bounds, width: int):
    """Return the window of some bounds, as much wider as numpy's loops like it, within a tile of this width."""
    x0, x1, y0, y1 = bounds
    wide = min(-(-(x1 - x0) // MULTIPLE) * MULTIPLE, width)
    x0 = min(x0, width - wide)
    return slice(y0, y1), slice(x0, x0 + wide)


def _batches(bounds):
    """Yield rows of shapes with bounds of about the same size, as many as fill a batch."""
    size = np.maximum(bounds[:, 1] - bounds[:, 0], bounds[:, 3] - bounds[:, 2])
    step = np.ceil(4 * np.log2(np.maximum(size, 1)))
    for value in np.unique(step):
        alike = np.flatnonzero(step == value)
        pixels = (bounds[alike, 1] - bounds[alike, 0]).max() * (bounds[alike, 3] - bounds[alike, 2]).max()
        count = max(1, BATCH_PIXELS // pixels)
        for first in range(0, len(alike), count):
            yield alike[first : first + count]


def _gather(component, y, x):
    """Return a broadcastable component at pixels given by a column of rows and a row of columns a shape."""
    if np.ndim(component) == 0:
        return component
    rows, columns = component.shape
    if rows == columns == 1:
        return component[None]
    return component[y if rows > 1 else 0, x if columns > 1 else 0]
