"""The nearest hit of every ray of a tile: shape by shape, or many shapes at once."""

from collections.abc import Callable
from dataclasses import dataclass
from heapq import merge
from operator import attrgetter
from typing import Any, Protocol

import numpy as np

from .. import tuning
from ..maths.speed import whole_rows, widened
from ..shapes.kind import Candidates, Large
from ..shapes.search_rays import Crossings, SearchRays
from .hits import NOTHING, Hits
from .plan import Plan
from .rays import TileRays


class HitSearch(Protocol):
    """A search for the nearest hits within the clip range, as ``nearest_hits`` is one."""

    def __call__(self, plan: Plan, rays: TileRays, listen: Callable[[], object], /) -> Hits: ...


def nearest_hits(
    plan: Plan, rays: TileRays, listen: Callable[[], object] = bool, before: np.ndarray | None = None,
    met: list[Crossings] | None = None,
) -> Hits:  # fmt: skip
    """Return the nearest hits within the clip range, in the scratch of the rays.

    ``before``: (rows, columns), t beyond which hits do not count; without a hit up to this t the result keeps it.

    Of shapes hit at exactly the same t the shape with the lowest index counts, in whatever order they are tested.
    ``listen()`` is called between the tests, and may raise; the default does nothing. ``met``: see ``SearchRays``.
    """
    shape, scratch = rays.shape, rays.scratch
    t, has_cutouts = scratch("t", shape), any(shape_set.has_cutouts for shape_set in plan.sets)
    searched = SearchRays(
        None if rays.from_eye else rays.origin,
        rays.direction,
        rays.corner, shape, scratch.part("kinds"), t if has_cutouts else None, met=met,
    )  # fmt: skip
    nearest = NearestHits(searched, t, scratch("index", shape, plan.index_type))
    if before is not None or has_cutouts:
        nearest.clear()
    if before is not None:
        np.copyto(nearest.t, before)
    for large in merge(*(shape_set.large(searched) for shape_set in plan.sets), key=attrgetter("at"), reverse=True):
        nearest.cast(large)
        listen()
    nearest.clear()
    for shape_set in plan.sets:
        for candidates in shape_set.rest(searched, nearest.t):
            if candidates is not None:
                nearest.keep(candidates)
            listen()
    if plan.clips:
        beyond = np.greater(nearest.t, plan.camera.clip_end, out=scratch("closer", shape, bool))
        np.copyto(nearest.index, NOTHING, where=beyond)
        np.copyto(nearest.t, np.inf, where=beyond)
    faces_eye = rays.from_eye and all(shape_set.faces_eye for shape_set in plan.sets)
    windows = (plan.seen, plan.bounds) if plan.is_layered else None
    return Hits(plan.target, rays, nearest.t, nearest.index, faces_eye, windows, searched.known)


@dataclass
class NearestHits:
    """The nearest hits of a tile so far."""

    rays: SearchRays
    t: np.ndarray
    """t of the nearest hits so far, inf without a hit; hits beyond the clip end are removed after the search."""
    index: np.ndarray
    written: int = 0
    """The number of rows, the lowest ones, whose ``t`` and ``index`` are written."""

    def clear(self) -> None:
        """Write that nothing is hit in the rows that are not written yet."""
        self.t[self.written :].fill(np.inf)
        self.index[self.written :].fill(NOTHING)
        self.written = len(self.t)

    def cast(self, large: Large) -> None:
        """Test one shape at the pixels of its bounds; no shape that was tested before may have a lower index."""
        x0, x1, y0, y1 = large.bounds
        step = max(1, tuning.SEARCHED_PIXELS // (x1 - x0))
        for first in range(y0, y1, step):
            window = widened((x0, x1, first, min(first + step, y1)), self.t.shape[1])
            with whole_rows(window[1].stop - window[1].start):
                crossed, where = large.solve(window, self.rays.scratch)
                if crossed is not None:
                    self._keep_one(window, crossed, where, large.at)

    def _keep_one(self, window: tuple[slice, slice], crossed: Any, where: Any, at: int) -> None:
        t, index = self.t[window], self.index[window]
        if self.rays.met is not None:
            self.rays.note((window[0].start, window[1].start), at, np.broadcast_to(crossed, t.shape)[None], where)
        if where is True and window[0].start == self.written and t.shape[1] == self.t.shape[1]:
            np.copyto(t, crossed)
            index.fill(at)
            self.written = window[0].stop
            return
        self.clear()
        closer = np.less_equal(crossed, t, out=self.rays.scratch("closer", t.shape, bool))
        if where is None or where is True:
            np.fmin(t, crossed, out=t)
        else:
            closer &= where
            np.copyto(t, crossed, where=closer)
        np.copyto(index, at, where=closer)

    def keep(self, candidates: Candidates) -> None:
        """Keep the crossings that are the nearest so far, in any order of shapes."""
        self.rays.note(candidates.corner, candidates.at, candidates.t, candidates.where)
        if len(candidates.t) == 1:
            self._keep_window(candidates)
            return
        (row, column), (count, high, wide) = candidates.corner, candidates.t.shape
        scratch, width = self.rays.scratch, self.t.shape[1]
        t, index = self.t.reshape(-1), self.index.reshape(-1)
        window = (np.arange(high)[:, None] * width + np.arange(wide)).reshape(-1)
        pixels = np.add((row * width + column)[:, None], window, out=scratch("pixels", (count, high * wide), np.intp))
        before = np.take(t, pixels, mode="wrap", out=scratch("before", pixels.shape)).reshape(candidates.t.shape)
        closer, tied = (scratch(name, candidates.t.shape, bool) for name in ("closer", "tied"))
        np.less(candidates.t, before, out=closer)
        if np.equal(candidates.t, before, out=tied).any():
            other = index[pixels].reshape(tied.shape)
            closer |= tied & (candidates.at < other)
        if candidates.where is not None:
            closer &= candidates.where
        hits = np.flatnonzero(closer)

        def at_hits(values: np.ndarray, name: str) -> np.ndarray:
            return np.take(values.reshape(-1), hits, mode="wrap", out=scratch(name, hits.shape, values.dtype.type))

        pixel, crossing = at_hits(pixels, "pixel"), at_hits(candidates.t, "crossing")
        np.floor_divide(hits, candidates.t.size // candidates.at.size, out=hits)
        shape = at_hits(candidates.at.astype(index.dtype), "shape")
        while pixel.size:
            t[pixel], index[pixel] = crossing, shape  # of several hits in a pixel the last is kept: others retry
            kept = np.take(index, pixel, mode="wrap", out=scratch("kept", pixel.shape, index.dtype.type))
            lost = np.flatnonzero(np.not_equal(kept, shape, out=scratch("lost", pixel.shape, bool)))
            pixel, crossing, shape = pixel[lost], crossing[lost], shape[lost]
            now = t[pixel]
            nearer = (crossing < now) | ((crossing == now) & (shape < index[pixel]))
            pixel, crossing, shape = pixel[nearer], crossing[nearer], shape[nearer]

    def _keep_window(self, candidates: Candidates) -> None:
        """Keep the crossings in one window, without the copies that indexing by arrays makes."""
        (row, column), (_, high, wide) = candidates.corner, candidates.t.shape
        window = slice(row[0], row[0] + high), slice(column[0], column[0] + wide)
        before, other, at = self.t[window][None], self.index[window][None], candidates.at.astype(self.index.dtype)
        closer, tied = candidates.t < before, candidates.t == before
        if candidates.where is not None:
            closer &= candidates.where
            tied &= candidates.where
        if tied.any():
            closer |= tied & (at < other)
        np.copyto(before, candidates.t, where=closer, casting="same_kind")
        np.copyto(other, at, where=closer)
