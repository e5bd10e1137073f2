"""The nearest hit of every ray of a tile: shape by shape, or many small shapes at once."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from heapq import merge
from operator import itemgetter
from typing import Any

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from ..maths.speed import Scratch, whole_rows, widened
from ..maths.vector import is_lattice
from .hits import NOTHING, Hits, cut
from .plan import Group, Plan

BATCH_PIXELS = 1 << 18
"""Pixels of the bounds of the small shapes that are cast at once: fewer, and threads would wait for each other."""

PREPARED_PIXELS = 1 << 16
"""Rows and columns of large shapes whose terms are made at once."""


def nearest(plan: Plan, origin, direction, from_eye: bool, corner, scratch: Scratch) -> Hits:
    """Return the nearest hits within the clip range of rays given as camera-frame components, (rows, columns).

    corner: the column and row of the render window at which the rays begin. Of shapes hit at exactly the same t
    the one with the lowest index counts, whatever order they are tested in. The hits lie in ``scratch``.
    """
    shape = np.broadcast(*origin, *direction, np.zeros((1, 1))).shape
    tile = Tile(
        None if from_eye else _rounded(origin, plan.real),
        _rounded(direction, plan.real),
        plan.camera.clip_start,
        scratch("t", shape),
        scratch("index", shape, plan.row_type),
        scratch,
    )
    seen = [(group, *group.within(corner, shape)) for group in plan.groups]
    large = (tile.prepared(*one) for one in seen if not one[0].small)
    for index, window, solve in merge(*large, key=itemgetter(0), reverse=True):
        tile.cast_one(index, window, solve)
    tile.clear()
    for group, at, bounds in seen:
        if group.small:
            for batch in _batches(bounds):
                tile.cast_batch(group, at[batch], bounds[batch])
    if plan.clips:
        beyond = np.greater(tile.t, plan.real(plan.camera.clip_end), out=scratch("closer", shape, bool))
        np.copyto(tile.index, NOTHING, where=beyond)
        np.copyto(tile.t, np.inf, where=beyond)
    full = tile.covered and not plan.clips
    return Hits(plan, from_eye, origin, direction, tile.t, tile.index, scratch, corner, full)


@dataclass
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
    blank: bool = True
    """Whether ``t`` and ``index`` are still to be written."""
    covered: bool = False
    """Whether every ray is known to hit something."""

    def clear(self) -> None:
        """Note that nothing was hit yet, unless something was."""
        if self.blank:
            self.t.fill(np.inf)
            self.index.fill(NOTHING)
            self.blank = False

    def prepared(self, group: Group, at, bounds) -> Iterator[tuple[int, Any, Callable]]:
        """Yield the index, the bounds and the kernel of some large shapes, the last one first."""
        count = max(1, PREPARED_PIXELS // sum(self.t.shape))
        for end in range(len(at), 0, -count):
            some = slice(max(0, end - count), end)
            solve = self._kernel(group, at[some])
            for k in reversed(range(some.stop - some.start)):
                yield int(group.at[at[some][k]]), bounds[some][k].tolist(), partial(solve, k)

    def _kernel(self, group: Group, rows) -> Callable:
        """Return what gives t and where there is one, of the k-th of some shapes in a window."""
        if self.origin is None and group.simple and is_lattice(self.direction):
            return group.shape.Lattice(group.constants(rows, axes=2), group.kind, self.direction).meet

        def meet(k, window, scratch):
            return self._intersect(group, group.constants(rows[k]), lambda component: cut(component, window))

        return meet

    def cast_one(self, index: int, bounds, solve: Callable) -> None:
        """Test one shape at the pixels of its bounds."""
        window = widened(bounds, self.t.shape[1])
        with whole_rows(window[1].stop - window[1].start):
            found, where = solve(window, self.scratch)
            if found is not None:
                self._keep(window, found, where, index)

    def cast_batch(self, group: Group, at, bounds) -> None:
        """Test many small shapes at once: windows as large as the largest bounds, moved until they lie in the tile."""
        order = np.lexsort((-group.at[at], -group.near[at]))  # what hides others is written last: few try again
        at, (x0, x1, y0, y1) = at[order], bounds[order].T
        wide, high = int((x1 - x0).max()), int((y1 - y0).max())
        x0, y0 = np.minimum(x0, self.t.shape[1] - wide), np.minimum(y0, self.t.shape[0] - high)
        x = x0[:, None, None] + np.arange(wide)
        y = y0[:, None, None] + np.arange(high)[:, None]
        view = group.constants(at, axes=2)
        found, where = self._intersect(group, view, lambda component: _gather(component, y, x))
        shapes = group.at[at].astype(self.index.dtype)
        self._keep_all((y0, x0), np.broadcast_to(found, (len(at), high, wide)), where, shapes)

    def _keep(self, window, found, where, shape: int) -> None:
        """Note the hits of one shape in a window that are the nearest so far; no shape before had a lower index."""
        t, index = self.t[window], self.index[window]
        if self.blank and where is True and t.shape == self.t.shape:
            np.copyto(t, found)
            index.fill(shape)
            self.blank, self.covered = False, True
            return
        self.clear()
        closer = np.less_equal(found, t, out=self.scratch("closer", t.shape, bool))
        if where is None or where is True:
            np.fmin(t, found, out=t)
        else:
            closer &= where
            np.copyto(t, found, where=closer)
        np.copyto(index, shape, where=closer)

    def _keep_all(self, corners, found, where, shapes) -> None:
        """Note the hits of many shapes, each in its own window, that are the nearest so far, whatever their order."""
        high, wide = found.shape[1:]
        before = sliding_window_view(self.t, (high, wide))[corners]
        closer, tied = found < before, found == before
        if tied.any():
            closer |= tied & (shapes[:, None, None] < sliding_window_view(self.index, (high, wide))[corners])
        if where is not None:
            closer &= where
        hits = np.flatnonzero(closer)
        width = self.t.shape[1]
        window = (np.arange(high)[:, None] * width + np.arange(wide)).reshape(-1)
        pixel = ((corners[0] * width + corners[1])[:, None] + window).reshape(-1)[hits]
        shape, found = shapes[hits // window.size], found.reshape(-1)[hits]
        t, index = self.t.reshape(-1), self.index.reshape(-1)
        while pixel.size:
            t[pixel], index[pixel] = found, shape  # of several hits in one pixel the last stays: the others try again
            lost = np.flatnonzero(index[pixel] != shape)
            pixel, found, shape = pixel[lost], found[lost], shape[lost]
            now = t[pixel]
            nearer = (found < now) | ((found == now) & (shape < index[pixel]))
            pixel, found, shape = pixel[nearer], found[nearer], shape[nearer]

    def _intersect(self, group: Group, view, part):
        origin = None if self.origin is None else tuple(map(part, self.origin))
        start = None if group.simple else self.start
        direction = tuple(map(part, self.direction))
        return group.shape.intersect(view, group.kind, origin, direction, start, self.scratch)


def _rounded(vector, real):
    """Return components as float32 where that is what is calculated with; as they are otherwise."""
    return vector if real is np.float64 else tuple(np.asarray(component, real) for component in vector)


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
