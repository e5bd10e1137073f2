"""A table of rays, prepared for the interpolation between its entries: checked, continued, with its errors and bounds.

Row 0 is the bottom row. An entry is a direction of any length and, unless all rays leave the eye, an origin. Where one
of the numbers is NaN, there is no ray. Directions are interpolated as unit vectors, component by component, within
the blocks of ``ray_blocks``; a table without blocks is a single one.
"""

from __future__ import annotations

import math

import numpy as np

from ...maths.recording import Entries
from ...maths.speed import lazy
from ...memory import require
from ...records import InputError
from .extended import WIDE, control_points, extended
from .ray_blocks import EntryBlocks, check_neighbors, refuse
from .seen_parts import PARTS, SeenParts

CUBIC, LINEAR, SPLINE, NONE = "CUBIC", "LINEAR", "SPLINE", "NONE"
"""Kinds of interpolation: a cubic spline through the entries, straight lines between them, a cubic B-spline whose
control points the entries are, and none: the ray of the nearest entry, whatever its neighbors are.
"""

BORDER_ENTRIES = 2
"""Entries beyond the outermost ones that the interpolation reads."""

CONTINUED_AT_ONCE = 1 << 20
"""Number of entries, with those around them, that blocks continued together may have."""

BYTES_PER_NUMBER = 64
"""Memory that a number of a table takes while it is prepared."""


class RayGrid:
    """A table of rays. Its attributes never change; ``lazy`` ones are computed at first use."""

    def __init__(
        self, directions: np.ndarray, origins: np.ndarray | None, kind: str, block: tuple[int, int] = (0, 0)
    ):
        """Prepare a table: directions and origins (rows, columns, 3), origins None for rays that leave the eye.

        block: rows and columns of a block, 0 for all; of no effect with NONE.
        Raises InputError, which says which entry is wrong, for another shape, a table without rays, directions of
        length 0 or infinite numbers, blocks that do not divide the table, and, within blocks, neighbors more than 90
        degrees apart and entries that fold over.
        """
        self.kind, self.shape = kind, (len(directions), directions.shape[1])
        least = {SPLINE: 4, NONE: 1}.get(kind, 2)
        if min(self.shape) < least:
            raise InputError(f"directions are of shape {directions.shape}: they must be (rows, columns, 3), {least} or "
                             "more rows and columns")  # fmt: skip
        if origins is not None and origins.shape != directions.shape:
            raise InputError(f"origins are of shape {origins.shape}, and directions of {directions.shape}")
        count = 3 if origins is None else 6
        sides = "{1} x {0}".format(*self.shape)
        self.blocks = EntryBlocks.of(self.shape, (0, 0) if kind == NONE else block)
        if self.blocks.many > 1 and (kind == SPLINE or min(self.blocks.size) < least):
            raise InputError("control points have no blocks: give a table for each, or set the blocks to 0"
                             if kind == SPLINE else f"blocks have {least} or more rows and columns")  # fmt: skip
        padded = self.blocks.many * math.prod(side + 2 * BORDER_ENTRIES for side in self.blocks.size)
        require(BYTES_PER_NUMBER * count * padded, f"the rays of a table of {sides}",
                "give a coarser table: rays between its entries are interpolated")  # fmt: skip
        if np.isinf(directions).any() or (origins is not None and np.isinf(origins).any()):
            raise InputError("it has infinite numbers: give NaN where there is no ray")
        with np.errstate(invalid="ignore", over="ignore"):
            scaled = directions / np.abs(directions).max(axis=2, keepdims=True)
            length = np.sqrt((scaled * scaled).sum(axis=2, keepdims=True))
        self.known = np.isfinite(directions).all(axis=2)
        none = self.known & (directions == 0).all(axis=2)
        refuse(none, "is a direction of length 0: give NaN where there is no ray")
        if origins is not None:
            self.known &= np.isfinite(origins).all(axis=2)
        if not self.known.any():
            raise InputError("it has no ray: each entry has NaN")
        self.directions = np.where(self.known[..., None], scaled / length, np.nan)
        self.origins = None if origins is None or not np.nan_to_num(origins).any() else origins
        if kind != NONE:
            check_neighbors(self.blocks, self.directions, self.origins)

    def slid(self) -> RayGrid:
        """Return the table with each origin moved along its ray to the foot of the perpendicular from the mean origin.

        Origins are arbitrary along a ray: where they jump from entry to entry, the rays do not.
        """
        if self.origins is None:
            return self
        middle = self.origins[self.known].mean(axis=0)
        along = ((middle - self.origins) * self.directions).sum(axis=2, keepdims=True)
        return RayGrid(self.directions, self.origins + along * self.directions, self.kind, self.blocks.size)

    @property
    def has_holes(self) -> bool:
        """Whether entries have no ray."""
        return not self.known.all()

    @property
    def values(self) -> np.ndarray:
        """The unit directions, and the origins if there are any: (rows, columns, 3 or 6), NaN without a ray."""
        return self.directions if self.origins is None else np.concatenate((self.directions, self.origins), axis=2)

    @lazy
    def nodes(self) -> np.ndarray:
        """The numbers that the interpolation sums with weights, (rows + 4, columns + 4, blocks, 3 or 6): control
        points, or for LINEAR the entries and their continuation, of each block.
        """
        return nodes_of(self.blocks.split(self.values), self.blocks.split(self.known), self.kind)

    @lazy
    def columns(self) -> list[Entries]:
        """The components of ``nodes``, each as a flat table: block by block, a row after the other."""
        table = np.moveaxis(self.nodes, 2, 0).reshape(-1, self.nodes.shape[3])
        return [Entries(table, column) for column in range(table.shape[1])]

    @lazy
    def has_ray(self) -> Entries:
        """Flat table of 1 for entries with a ray and 0 for others."""
        return Entries(self.known.reshape(-1, 1).astype(np.float64))

    @lazy
    def farthest(self) -> float:
        """The largest distance of an origin from the eye."""
        return 0.0 if self.origins is None else float(np.sqrt((self.nodes[..., 3:] ** 2).sum(axis=-1)).max())

    @lazy
    def largest(self) -> float:
        """The largest length of a control point of directions."""
        return float(np.sqrt((self.nodes[..., :3] ** 2).sum(axis=-1)).max())

    @lazy
    def shortest(self) -> float:
        """A length that interpolated directions have at least: 0.9 of the least in the middle of a cell."""
        if self.kind == NONE:
            return 1.0
        row, column = (np.arange(side - 1) + 0.5 for side in self.blocks.size)
        known = self.blocks.split(self.known)
        whole = known[1:, 1:] & known[1:, :-1] & known[:-1, 1:] & known[:-1, :-1]
        middle = between(self.nodes[..., :3], row[:, None], column, self.kind)[whole]
        return 0.9 * float(np.sqrt((middle * middle).sum(axis=1)).min(initial=1.0))

    @lazy
    def errors(self) -> tuple[float, float]:
        """Estimated largest errors of interpolated rays between the entries and half an entry beyond: the angle of
        directions in radians, and the distance of origins. 0 for SPLINE, whose curve is the table's own, and NONE.

        The table of every second row and column is interpolated where it has no entries. Its error there, over 2**4 for
        cubics, and over 2**2 for lines, is that of the whole table.
        """
        if self.kind in (SPLINE, NONE):
            return 0.0, 0.0
        worst, values, whole = [(0.0, 0.0)], self.blocks.split(self.values), self.blocks.split(self.known)
        for first in (0, 1):
            half = values[first::2, first::2]
            known = whole[first::2, first::2]
            if min(known.shape[:2]) < 2 or not known.any():
                continue
            row, column = (np.arange(side) / 2 - first / 2 for side in self.blocks.size)
            interpolated = between(nodes_of(half, known, self.kind), row[:, None], column, self.kind)
            near = known[np.ix_(*(np.clip(np.floor(positions + 0.5).astype(int), 0, side - 1)
                                  for positions, side in zip((row, column), known.shape, strict=False)))]  # fmt: skip
            worst.append(self._off(interpolated, values, near & whole))
        order = 2 if self.kind == LINEAR else 4
        angle, distance = np.max(worst, axis=0) / 2**order
        return float(angle), float(distance)

    def _off(self, rays: np.ndarray, entries: np.ndarray, counts: np.ndarray) -> tuple[float, float]:
        """Return the largest angle between the table's directions and others, and distance of its origins."""
        if not counts.any():
            return 0.0, 0.0
        rays, entries = rays[counts], entries[counts]
        ahead = rays[:, :3] / np.linalg.norm(rays[:, :3], axis=1, keepdims=True)
        angle = 2 * np.arcsin(np.minimum(np.linalg.norm(ahead - entries[:, :3], axis=1) / 2, 1))
        return angle.max(), np.linalg.norm(rays[:, 3:] - entries[:, 3:], axis=1).max(initial=0.0)

    @lazy
    def seen_parts(self) -> SeenParts:
        """Parts of cells, or blocks of cells, in entries, by their rays.

        Interpolated vectors are means, with positive weights, of the nodes that the interpolation reads: parts of cells
        have nodes of their own. Without interpolation they are entries, or blocks of entries.
        """
        if self.kind == NONE:
            return self._seen_entries()
        nodes, known = self.nodes, np.pad(self.blocks.split(self.known), ((1, 1), (1, 1), (0, 0)))
        if self.kind == LINEAR:
            nodes = nodes[1:-1, 1:-1]
        places, scales = [], []
        for side, count in zip(*self.blocks, strict=True):  # rows, then columns: each step turns the table
            finer = max(0, math.ceil(math.log2(PARTS / (side + 1) / count)))
            for _ in range(finer):
                nodes = _finer(nodes, self.kind)
            cells = (side + 1) << finer
            parts = min(cells, max(1, 2 * PARTS // count))
            places.append(np.unique(np.linspace(0, cells, parts + 1).astype(int)))
            scales.append(0.5**finer)
            nodes, known = nodes.swapaxes(0, 1), (known[1:] | known[:-1]).repeat(1 << finer, axis=0).swapaxes(0, 1)
        low, high = (_parts(end, nodes, known, places) for end in (np.fmin, np.fmax))
        v, u = (self.blocks.starts(axis)[:, None, None] + (np.stack((ends[:-1], ends[1:]), axis=1) * scale - 1)
                for axis, (ends, scale) in enumerate(zip(places, scales, strict=True)))  # fmt: skip
        v, u = v.reshape(-1, 2), u.reshape(-1, 2)
        places_of_parts = np.concatenate(np.broadcast_arrays(u[None], v[:, None]), axis=2)
        return SeenParts(self.blocks.joined(low), self.blocks.joined(high), places_of_parts)

    def _seen_entries(self) -> SeenParts:
        places = [np.unique(np.linspace(0, side, min(side, 2 * PARTS) + 1).astype(int)) for side in self.shape]
        low = high = self.values
        for axis, ends in enumerate(places):
            low, high = (end.reduceat(each, ends[:-1], axis=axis) for end, each in ((np.fmin, low), (np.fmax, high)))
        v, u = (np.stack((ends[:-1], ends[1:]), axis=1) - 0.5 for ends in places)
        return SeenParts(low, high, np.concatenate(np.broadcast_arrays(u[None], v[:, None]), axis=2))


def nodes_of(values: np.ndarray, known: np.ndarray, kind: str) -> np.ndarray:
    """Return what the interpolation of blocks (rows, columns, blocks, k) sums with weights, (rows + 4, columns + 4,
    blocks, k); 0 for blocks without rays.
    """
    around = (BORDER_ENTRIES, BORDER_ENTRIES), (BORDER_ENTRIES, BORDER_ENTRIES), (0, 0), (0, 0)
    nodes = np.pad(np.nan_to_num(values), around, mode="edge")
    if kind == NONE:
        return nodes
    alike: dict[bytes, list[int]] = {}
    for block in np.flatnonzero(known.any(axis=(0, 1))).tolist():
        alike.setdefault(known[:, :, block].tobytes(), []).append(block)
    kept, (rows, columns, _, count) = slice(WIDE - BORDER_ENTRIES, BORDER_ENTRIES - WIDE), values.shape
    step = max(1, CONTINUED_AT_ONCE // ((rows + 2 * WIDE) * (columns + 2 * WIDE)))
    for chosen in (blocks[first : first + step] for blocks in alike.values() for first in range(0, len(blocks), step)):
        entries = values[:, :, chosen].reshape(rows, columns, -1)
        wide = extended(entries, known[:, :, chosen[0]], 1 if kind == LINEAR else 3)
        near = (control_points(wide) if kind == CUBIC else wide)[kept, kept]
        nodes[:, :, chosen] = near.reshape(*near.shape[:2], -1, count)
    return nodes


def _finer(nodes: np.ndarray, kind: str) -> np.ndarray:
    """Return the nodes of the halves of cells along the first axis: the same curve."""
    middle = (nodes[1:] + nodes[:-1]) / 2
    finer = np.empty((2 * len(nodes) - (1 if kind == LINEAR else 3), *nodes.shape[1:]))
    if kind == LINEAR:
        finer[::2], finer[1::2] = nodes, middle
    else:  # E. Catmull and J. Clark, Recursively Generated B-Spline Surfaces, CAD 10 (1978)
        finer[::2], finer[1::2] = middle, (middle[1:] + middle[:-1] + 2 * nodes[1:-1]) / 4
    return finer


def _parts(end: np.ufunc, nodes: np.ndarray, known: np.ndarray, places: list[np.ndarray]) -> np.ndarray:
    """Return the least or largest components of what parts, of cells, read; NaN for parts without rays."""
    for axis, starts in enumerate(places):
        turned = nodes.swapaxes(0, axis)
        width = len(turned) - starts[-1] + 1
        turned = end.reduce([turned[k : len(turned) - width + 1 + k] for k in range(width)])
        nodes = turned.swapaxes(0, axis)
    nodes = np.where(known[..., None], nodes, np.nan)
    for axis, starts in enumerate(places):
        nodes = end.reduceat(nodes, starts[:-1], axis=axis)
    return nodes


def weights_of(t, kind: str) -> tuple:
    """Return the weights of the entries -1, 0, 1, 2 around a place t from 0 to 1, for LINEAR of 0 and 1, for NONE of 0.
    """
    if kind == NONE:
        return (1.0,)
    s = 1 - t
    if kind == LINEAR:
        return s, t
    return s * s * s / 6, (4 - 3 * t * t * (1 + s)) / 6, (4 - 3 * s * s * (1 + t)) / 6, t * t * t / 6


def between(nodes: np.ndarray, row: np.ndarray, column: np.ndarray, kind: str) -> np.ndarray:
    """Return the interpolated vectors (rows, columns, blocks, k) of ``nodes_of`` at places (rows, 1) and (columns,)."""
    for positions in (row[:, 0], column):
        cell = np.floor(positions).astype(int)
        first = cell + BORDER_ENTRIES - (kind != LINEAR)
        weights = weights_of(positions - cell, kind)
        nodes = sum(nodes[first + k] * weight[:, None, None, None] for k, weight in enumerate(weights)).swapaxes(0, 1)
    return nodes
