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

from ..maths.speed import lazy, taken
from ..shapes.windows import counted
from .packets import Packets
from .tree import FAN, Tree

PAIRS_AT_ONCE = 1 << 15
"""Number of pairs divided at once. With 2**13 or 2**17, rays in a room take 1.0 to 1.4 times as long."""

SPLIT = 8.0
"""A packet is divided, not the node, if this many packets side by side would be wider than the node's box.

Relative times of other values: random rays from a point and around it, in a room and on a street, take 1.2 to 5 times
as long with 1, 1.0 to 1.6 times with 4 and 0.7 to 1.0 times with 16; rays of pictures 0.8 to 1.1 times with 1 and 1.0
to 1.15 times with 16.
"""

ROUNDED = 2.0**-40
"""Relative rounding of a box test, with a wide margin."""


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
    """The search of a tree for the rays of some packets, from t = ``start``."""

    def __init__(self, tree: Tree, packets: Packets, start: float, farthest: Callable[[], np.ndarray]):
        """Take a function that returns the largest t, packet by packet, up to which hits count; it is asked again after
        each step of ``pairs``.
        """
        self._tree, self._packets, self._start, self._ask = tree, packets, start, farthest
        self._farthest = farthest()
        self._first_ray = len(packets.count) - packets.rays
        self._faces = tree.faces if packets.eye is None else tree.faces - packets.eye

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
        return self._tree.size

    @lazy
    def _middle(self) -> np.ndarray:
        return self._tree.middle

    def _width(self, pairs: Pairs) -> np.ndarray:
        """Return about how wide packets are where they pass nodes."""
        away = np.zeros(len(pairs.node))
        for middle, origin in zip(self._middle, self._packets.low, strict=True):
            np.maximum(away, np.abs(taken(middle, pairs.node) - taken(origin, pairs.packet)), out=away)
        return taken(self._packets.wide, pairs.packet) + taken(self._packets.spread, pairs.packet) * away

    def _divided(self, pairs: Pairs) -> Pairs:
        """Return the packets within packets that may meet the same nodes."""
        run, packet = counted(taken(self._packets.count, pairs.packet), taken(self._packets.first, pairs.packet))
        node = taken(pairs.node, run)
        near, meets = self._met(packet, node, self._faces, len(self._tree))
        met = np.flatnonzero(meets)
        return Pairs(taken(packet, met), taken(node, met), taken(near, met))

    def _below(self, packet: np.ndarray, row: np.ndarray) -> Pairs:
        """Return which packets may meet which of the nodes in rows, (m,) each."""
        rows = len(self._tree) // FAN
        near, meets = self._met(packet[:, None], row, self._faces.reshape(3, -1, FAN), rows)
        meets &= self._tree.there.reshape(-1, FAN).take(row, axis=0, mode="wrap")
        met = np.flatnonzero(meets)
        run, slot = np.divmod(met, FAN)
        return Pairs(taken(packet, run), taken(row, run) * FAN + slot, taken(near.reshape(-1), met))

    def _met(self, packet: np.ndarray, box: np.ndarray, faces: np.ndarray, other: int):
        """Return lower bounds of the t at which packets meet boxes, and whether they meet them between the start and
        the farthest t. The boxes are those at ``box`` of the faces, the highest sides ``other`` places behind the
        lowest.
        """
        packets = self._packets
        near, far = np.array(self._start), taken(self._farthest, packet)
        alone = len(packet) > 0 and packet.min() >= self._first_ray
        for axis in range(3):
            low = faces[axis].take(box, axis=0, mode="wrap")
            high = faces[axis].take(box + other, axis=0, mode="wrap")
            if packets.eye is None:
                high -= taken(packets.low[axis], packet)
                low -= taken((packets.low if alone else packets.high)[axis], packet)
            least = taken(packets.least[axis], packet)
            ends = [low * least, high * least]  # NaN, of sides that rays do not leave, tells nothing
            if not alone:
                largest = taken(packets.largest[axis], packet)
                ends += [low * largest, high * largest]
            enter, leave = np.minimum(ends[0], ends[1]), np.maximum(ends[0], ends[1])
            for end in ends[2:]:
                np.minimum(enter, end, out=enter)
                np.maximum(leave, end, out=leave)
            near, far = np.fmax(near, enter), np.fmin(far, leave)
        return near, near - ROUNDED * np.abs(near) <= far + ROUNDED * np.abs(far)
