"""Passes painted shape by shape, a whole tile at once: bit for bit what they are when each pixel looks its shape up in
a table, in less time where the shapes in view are few and large.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

from .hits import NOTHING, Hits
from .loops import whole_rows, widened
from .plan import pixels_in
from .records import SPHERE

BLOCK_PIXELS = 1 << 18
"""Pixels that are painted at once."""


def constant(hits: Hits, table) -> Callable[[Hits, np.ndarray], None] | None:
    """Return what writes each shape's entry of a table (n + 1,), its last one where nothing is hit; None where looking
    up takes less.
    """
    return partial(_paint_constant, table) if hits.plan.is_painted else None


def normal(hits: Hits) -> Callable[[Hits, np.ndarray], None] | None:
    """Return what writes the unit normals, 0 where nothing is hit; None where looking up takes less."""
    if not (hits.plan.is_painted and hits.from_eye and hits.plan.eye_outside and hits.lattice is not None):
        return None
    return _paint_normal if hits.plan.normals.is_sum else None


def _paint_constant(table, hits: Hits, out) -> None:
    backdrop, others = _layers(hits)
    out.fill(table[backdrop])
    for shape, window, mask in others:
        np.copyto(out[window], table[shape], where=mask)


def _paint_normal(hits: Hits, out) -> None:
    constants = hits.plan.normals.constants
    backdrop, others = _layers(hits)
    row = np.tile(constants[1:, backdrop].astype(out.dtype), (out.shape[1], 1))
    np.copyto(out, row)  # a row at a time: a pixel at a time takes several times as long
    for shape, window, mask in others:
        gain, normal = constants[0, shape], constants[1:, shape]
        with whole_rows(mask.shape[1]):
            if gain:
                point = hits.part(*window).point
                normal = np.add(np.multiply(point, gain, out=point), normal[:, None, None], out=point)
            for axis in range(3):
                np.copyto(out[window][..., axis], normal[axis], where=mask, casting="same_kind")


def _layers(hits: Hits) -> tuple[int, Iterator[tuple[int, tuple[slice, slice], np.ndarray]]]:
    """Return what is painted first, everywhere: the flat shape with the largest bounds, NOTHING without one. And all
    others that are seen, each with windows and with the pixels of these that see it.
    """
    height, width = hits.t.shape
    bounds: dict[int, list[int]] = {}
    flat: dict[int, int] = {}
    for group in hits.plan.groups:
        at, edges = group.within(hits.corner, hits.t.shape)
        shapes = group.at[at].tolist()
        bounds |= zip(shapes, edges.tolist(), strict=True)
        if group.kind != SPHERE:
            flat |= zip(shapes, pixels_in(edges).tolist(), strict=True)
    backdrop = max(flat, key=lambda shape: flat[shape], default=NOTHING)
    if not hits.full:
        bounds[NOTHING] = [0, width, 0, height]
    bounds.pop(backdrop, None)
    return backdrop, _seen(hits, bounds)


def _seen(hits: Hits, bounds):
    for shape, (x0, x1, y0, y1) in bounds.items():
        step = max(1, BLOCK_PIXELS // (x1 - x0))
        for first in range(y0, y1, step):
            window = widened((x0, x1, first, min(first + step, y1)), hits.t.shape[1])
            index = hits.index[window]
            mask = np.equal(index, shape, out=hits.scratch("closer", index.shape, bool))
            if mask.any():
                yield shape, window, mask
