"""The pairs of rays and bodies that may meet: packets of rays and nodes of a tree are divided together.

A pair of a packet and a node is left out if no ray of the packet meets the node's box before the hits so far. Else the
larger of the two is divided: packets of similar rays descend whole to small boxes, single rays descend by themselves.
Near pairs are followed first.
Reference: T. Kay and J. Kajiya, Ray Tracing Complex Scenes, SIGGRAPH 1986 (slabs).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from ..maths.speed import Scratch, lazy, taken
from ..maths.vector import norm
from ..shapes.windows import counted
from .packets import packets_of
from .tree import FAN, FAR, Tree

PAIRS_AT_ONCE = 1 << 16
"""Number of pairs divided at once. With 2**14, 2**15 and 2**17, random rays in a room take 1.2, 1.1 and 0.96 times as
long.
"""

SPLIT = 8.0
"""A packet is divided, not the node, if this many packets side by side would be wider than the node's box.

Relative times of other values: random rays from a point and around it, in a room and on a street, take 1.2 to 5 times
as long with 1, 1.0 to 1.6 times with 4 and 0.7 to 1.0 times with 16; rays of pictures 0.8 to 1.1 times with 1 and 1.0
to 1.15 times with 16.
"""

ROUNDED = 2.0**-30, 2.0**-22
"""Relative rounding of t in float64, also of hits (see ``triangles.STEEP``), and in float32, with margins."""


class Pairs(NamedTuple):
    """Packets and nodes that may meet, (m,) each."""

    packet: np.ndarray
    node: np.ndarray
    near: np.ndarray
    """Lower bounds of t."""

    def only(self, indices: np.ndarray) -> Pairs:
        """Return some of them, by index."""
        return Pairs(*(taken(values, indices) for values in self))


class Traversal:
    """The search of a tree for rays (3, n), from t = ``start``; t counts units of the tree if its boxes are float32."""

    def __init__(
        self, tree: Tree, origin: np.ndarray, direction: np.ndarray, start: float, limit: Callable[[], np.ndarray]
    ):
        """Take a function that returns the largest t, (n,), up to which hits count; it is asked again after each step
        of ``pairs``.
        """
        length, begin = norm(direction), (origin - tree.middle[:, None]) / tree.reach
        faces = tree.near_faces if np.abs(begin).max(initial=0) <= FAR else None
        scale = length if faces is None else length / tree.reach
        self._faces = faces = tree.faces if faces is None else faces
        self._is_exact = faces.dtype == np.float64
        self._tree, self._start = tree, (1 - ROUNDED[1]) * start * float(scale.min(initial=np.inf))
        begin = (origin if self._is_exact else begin).astype(faces.dtype)
        self._packets = packets_of(begin, (direction / length).astype(faces.dtype))
        self._ask = lambda: self._packets.farthest(((1 + ROUNDED[1]) * scale * limit()).astype(faces.dtype))
        self._farthest = self._ask()
        self._first_ray = len(self._packets.count) - self._packets.rays
        self._scratch = Scratch()

    def pairs(self) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Yield rays and the bodies that they may meet, (m,) indices each."""
        roots = np.arange(self._packets.roots)
        waiting = [self._below(roots, np.zeros(len(roots), np.intp))]
        while waiting:
            pairs = waiting.pop()
            pairs = pairs.only(np.flatnonzero(pairs.near <= taken(self._farthest, pairs.packet)))
            if not len(pairs.node):
                continue
            if len(pairs.node) > PAIRS_AT_ONCE:
                near = pairs.near <= np.partition(pairs.near, PAIRS_AT_ONCE)[PAIRS_AT_ONCE]
                if not near.all():
                    waiting += pairs.only(np.flatnonzero(~near)), pairs.only(np.flatnonzero(near))
                    continue
            count = taken(self._tree.count, pairs.node)
            is_ray = pairs.packet >= self._first_ray
            done = np.flatnonzero((count > 0) & is_ray)
            if done.size:
                run, slot = counted(taken(count, done), taken(self._tree.row, taken(pairs.node, done)))
                yield taken(taken(pairs.packet, done), run) - self._first_ray, taken(self._tree.body, slot)
                self._farthest = self._ask()
            split = (count > 0) & ~is_ray
            packets = np.flatnonzero(~is_ray)
            if packets.size:
                chosen = pairs.only(packets)
                split[packets] |= SPLIT * self._width(chosen) > taken(self._size, chosen.node)
            parts = [self._divided(pairs.only(np.flatnonzero(split)))]
            whole = ~split & (count == 0)
            for inner in (np.flatnonzero(whole & is_ray), np.flatnonzero(whole & ~is_ray)):  # tests of rays are simpler
                if inner.size:
                    chosen = pairs.only(inner)
                    parts.append(self._below(chosen.packet, taken(self._tree.row, chosen.node)))
            waiting.append(Pairs(*map(np.concatenate, zip(*parts, strict=True))))

    @lazy
    def _size(self) -> np.ndarray:
        """The longest side of each box."""
        return np.diff(self._faces, axis=1)[:, 0].max(axis=0)

    @lazy
    def _middle(self) -> np.ndarray:
        """(3, n): the middles of the boxes."""
        return self._faces.mean(axis=1)

    def _width(self, pairs: Pairs) -> np.ndarray:
        """Return about how wide packets are where they pass nodes."""
        away = np.zeros(len(pairs.node), self._faces.dtype)
        for middle, origin in zip(self._middle, self._packets.low, strict=True):
            np.maximum(away, np.abs(taken(middle, pairs.node) - taken(origin, pairs.packet)), out=away)
        return taken(self._packets.wide, pairs.packet) + taken(self._packets.spread, pairs.packet) * away

    def _divided(self, pairs: Pairs) -> Pairs:
        """Return the packets within packets that may meet the same nodes."""
        run, packet = counted(taken(self._packets.count, pairs.packet), taken(self._packets.first, pairs.packet))
        node = taken(pairs.node, run)
        near, meets = self._met(packet, node, self._faces)
        met = np.flatnonzero(meets)
        return Pairs(taken(packet, met), taken(node, met), taken(near, met))

    def _below(self, packet: np.ndarray, row: np.ndarray) -> Pairs:
        """Return which packets may meet which of the nodes in rows, (m,) each."""
        rows = len(self._tree) // FAN
        near, meets = self._met(packet, row, self._faces.reshape(3, 2, FAN, rows))
        meets &= taken(self._tree.there.reshape(FAN, rows), row)
        met = np.flatnonzero(meets)
        slot, run = np.divmod(met, len(row))
        return Pairs(taken(packet, run), slot * rows + taken(row, run), taken(near.reshape(-1), met))

    def _met(self, packet: np.ndarray, box: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return lower bounds of the t at which packets, (m,), meet boxes, and whether they meet them between the start
        and the farthest t, (..., m) each, given the boxes' places, (m,), in faces (3, 2, ..., b).
        """
        packets, shape = self._packets, (*faces.shape[2:-1], len(box))
        near, far, spare, *ends = (self._scratch(f"{k}", shape, faces.dtype) for k in range(7))
        near.fill(self._start)
        np.copyto(far, taken(self._farthest, packet))
        alone = len(packet) > 0 and packet.min() >= self._first_ray
        for axis in range(3):
            slopes = [taken(packets.least[axis], packet)]
            if not alone:
                slopes.append(taken(packets.largest[axis], packet))
            for k, origins in enumerate((packets.low if alone else packets.high, packets.low)):
                faces[axis, k].take(box, axis=-1, mode="wrap", out=ends[k])
                ends[k] -= taken(origins[axis], packet)
                for slope, end in zip(slopes[::-1], (ends[k + 2], ends[k])[-len(slopes) :], strict=True):
                    np.multiply(ends[k], slope, out=end)  # NaN, of sides that rays do not leave, tells nothing
            for limit, nearer, farther in ((near, np.minimum, np.fmax), (far, np.maximum, np.fmin)):
                nearer(ends[0], ends[1], out=spare)
                for end in ends[2 : 2 * len(slopes)]:
                    nearer(spare, end, out=spare)
                farther(limit, spare, out=limit)
        if self._is_exact:
            return near, near - ROUNDED[0] * np.abs(near) <= far + ROUNDED[0] * np.abs(far)
        return near, near <= far
