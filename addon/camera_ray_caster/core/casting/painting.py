"""Passes painted shape by shape, a whole tile at once: bit for bit what they are when each pixel looks its shape up in
a table, in less time where the shapes in view are few and large.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ..maths.speed import whole_rows, widened
from ..records import SPHERE
from .hits import NOTHING, Hits
from .plan import pixels_in

BLOCK_PIXELS = 1 << 18
"""Pixels that are painted at once."""


class Brush(Protocol):
    """What paints a pass."""

    def fill(self, out: np.ndarray, shape: int) -> None:
        """Paint a flat shape, or NOTHING, everywhere."""

    def paint(self, hits: Hits, out: np.ndarray, shape: int, window, mask: np.ndarray) -> None:
        """Paint a shape over what is there, in a window where ``mask``."""


@dataclass(frozen=True)
class Constant:
    """Paints each shape's entry of a table (n + 1,), its last one where nothing is hit."""

    table: np.ndarray

    def fill(self, out, shape):
        out.fill(self.table[shape])

    def paint(self, hits, out, shape, window, mask):
        np.copyto(out[window], self.table[shape], where=mask)


@dataclass(frozen=True)
class Normal:
    """Paints the unit normals, 0 where nothing is hit."""

    constants: np.ndarray
    """As ``NormalTable`` has them."""

    def fill(self, out, shape):
        row = np.tile(self.constants[1:, shape].astype(out.dtype), (out.shape[1], 1))
        np.copyto(out, row)  # a row at a time: a pixel at a time takes several times as long

    def paint(self, hits, out, shape, window, mask):
        gain, normal = self.constants[0, shape], self.constants[1:, shape]
        if gain:
            point = hits.points(window)
            normal = np.add(np.multiply(point, gain, out=point), normal[:, None, None], out=point)
        for axis in range(3):
            np.copyto(out[window][..., axis], normal[axis], where=mask, casting="same_kind")


def constant(hits: Hits, table) -> Brush | None:
    """Return what paints an entry of a table; None where looking up takes less."""
    return Constant(table) if hits.plan.is_painted else None


def normal(hits: Hits) -> Brush | None:
    """Return what paints the normals; None where looking up takes less."""
    if not (hits.plan.is_painted and hits.from_eye and hits.plan.eye_outside and hits.lattice is not None):
        return None
    return Normal(hits.plan.normals.constants) if hits.plan.normals.is_sum else None


def paint(hits: Hits, outs: list[tuple[Brush, np.ndarray]]) -> None:
    """Paint passes: first, everywhere, the flat shape with the largest bounds, NOTHING without one; then all others."""
    backdrop, others = _layers(hits)
    for brush, out in outs:
        brush.fill(out, backdrop)
    for shape, window, mask in _seen(hits, others):
        with whole_rows(mask.shape[1]):
            for brush, out in outs:
                brush.paint(hits, out, shape, window, mask)


def _layers(hits: Hits) -> tuple[int, dict[int, list[int]]]:
    """Return what is painted first, and the bounds x0, x1, y0, y1 in the tile of all others that may be seen."""
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
    return backdrop, bounds


def _seen(hits: Hits, bounds) -> Iterator[tuple[int, tuple[slice, slice], np.ndarray]]:
    """Yield each shape that is seen, with windows and with the pixels of these that see it."""
    for shape, (x0, x1, y0, y1) in bounds.items():
        step = max(1, BLOCK_PIXELS // (x1 - x0))
        for first in range(y0, y1, step):
            window = widened((x0, x1, first, min(first + step, y1)), hits.t.shape[1])
            index = hits.index[window]
            mask = np.equal(index, shape, out=hits.scratch("closer", index.shape, bool))
            if mask.any():
                yield shape, window, mask
