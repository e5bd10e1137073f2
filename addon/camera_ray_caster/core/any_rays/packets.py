"""Packets of rays: single rays, and groups of FAN of them, level by level, with boxes of origins and directions."""

from dataclasses import dataclass

import numpy as np

from ..maths.vector import norm
from .tree import morton

FAN = 8
"""Number of packets in a packet."""


def coherent_order(origin: np.ndarray, direction: np.ndarray, reach: float) -> np.ndarray:
    """Return an order of rays, (3, n) each, in which neighbors begin near each other and look in similar directions:
    along Morton's curve through origins and unit directions, both as they move the rays at the distance ``reach``.

    If directions and origins count the same, rays whose origins differ by 15 mm take 1.5 times as long.
    """
    ahead = direction / norm(direction)
    return np.argsort(morton(np.concatenate((origin, reach * ahead)), even=True), kind="stable")


@dataclass(frozen=True, eq=False)
class Packets:
    """Packets from the roots to single rays; the last ``rays`` of them are the rays. (3, n) and (n,) arrays.

    Where a packet's directions have both signs along an axis, 1 / direction is unbounded, and the axis tells nothing.
    """

    low: np.ndarray
    """The least components of the origins."""
    high: np.ndarray
    """The largest components."""
    least: np.ndarray
    """The least 1 / direction."""
    largest: np.ndarray
    """The largest 1 / direction."""
    wide: np.ndarray
    """(n,): the longest side of the box of the origins."""
    spread: np.ndarray
    """(n,): the largest difference of a component of the unit directions."""
    first: np.ndarray
    """The first child."""
    count: np.ndarray
    """The number of children; 0 for rays."""
    starts: tuple[np.ndarray, ...]
    """The first child of each packet of a level, counted in the level below, from the rays upwards."""
    rays: int
    roots: int

    def farthest(self, t: np.ndarray) -> np.ndarray:
        """Return the largest t of the rays of each packet, (n,), given those of the rays."""
        levels = [t]
        for starts in self.starts:
            levels.append(np.maximum.reduceat(levels[-1], starts))
        return np.concatenate(levels[::-1])


def packets_of(origin: np.ndarray, direction: np.ndarray) -> Packets:
    """Return the packets of rays, (3, n) each, with unit directions, in the order in which they are given."""
    inverse = 1 / direction
    ends: tuple[np.ufunc, ...] = (np.minimum, np.maximum) * 3
    parts: list[tuple[np.ndarray, ...]] = [(origin, origin, inverse, inverse, direction, direction)]
    starts, counts = [], [np.zeros(origin.shape[1], np.intp)]
    while parts[-1][0].shape[1] > FAN:
        size = parts[-1][0].shape[1]
        first = np.arange(0, size, FAN)
        parts.append(tuple(end.reduceat(level, first, axis=1) for end, level in zip(ends, parts[-1], strict=True)))
        starts.append(first)
        counts.append(np.minimum(FAN, size - first))
    sizes = [len(count) for count in counts][::-1]
    below = np.cumsum(sizes)  # the children of a level's packets are those of the next level
    firsts = [first + base for first, base in zip(starts[::-1], below, strict=False)] + [np.zeros(sizes[-1], np.intp)]
    low, high, least, largest, left, right = (np.concatenate(level[::-1], axis=1) for level in zip(*parts, strict=True))
    mixed = np.signbit(least) & ~np.signbit(largest)
    least[mixed], largest[mixed] = -np.inf, np.inf
    return Packets(
        low=low,
        high=high,
        least=least,
        largest=largest,
        wide=(high - low).max(axis=0),
        spread=(right - left).max(axis=0),
        first=np.concatenate(firsts),
        count=np.concatenate(counts[::-1]),
        starts=tuple(starts),
        rays=sizes[-1],
        roots=sizes[0],
    )
