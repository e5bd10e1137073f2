"""A tree of boxes: each node has FAN nodes below it, some of which may be empty, and each leaf up to LEAF bodies.

The boxes are divided at medians. Reference: J. Bentley, Multidimensional Binary Search Trees, CACM 18 (1975).
"""

from dataclasses import dataclass

import numpy as np

from ..maths.speed import lazy

FAN = 4
"""Number of nodes below a node. With 2 and 8, random rays in a room take 1.0 and 1.1 times as long."""

LEAF = 4
"""Maximum number of bodies in a leaf. With 2, they take 1.0 to 1.3 times as long."""

FAR = 3.0
"""Distance from the middle of a tree, in units of its reach, within which boxes are tested in float32."""

MARGIN = 2.0**-19
"""Length by which these boxes are enlarged: 32 u with u = 2^-24. The roundings of a face, of an origin and of their
difference add up to 8 u, those of the inverse of a direction and of its product with the difference to 12 u.
"""

SMALLEST = 0.1
"""Part of the leaves whose boxes may be smaller than 16 MARGIN."""

BOX_MARGIN = 2.0**-30
"""Fraction by which boxes are enlarged. It exceeds the rounding of vertices, of box tests, and of t (see
``triangles.STEEP``), so that no hit lies outside of its box.
"""


@dataclass(frozen=True, eq=False)
class Tree:
    """Nodes from the roots to the leaves, in rows of FAN: the first row holds the roots. In arrays (n,) the first nodes
    of all rows come first, then the second ones.
    """

    faces: np.ndarray
    """(3, 2, n): along each axis the lowest sides of the boxes, and the highest."""
    there: np.ndarray
    """bool: whether a node is not empty."""
    row: np.ndarray
    """The row of the nodes below a node, or of a leaf the first of its places in ``body``."""
    count: np.ndarray
    """The number of bodies of a leaf; 0 for other nodes."""
    body: np.ndarray
    """(b,): the bodies, leaf by leaf."""

    def __len__(self) -> int:
        return len(self.row)

    @lazy
    def middle(self) -> np.ndarray:
        """(3,): the middle of the box of all bodies."""
        return self._ends.mean(axis=0)

    @lazy
    def reach(self) -> float:
        """Half of the longest side of the box of all bodies."""
        return float((self._ends[1] - self._ends[0]).max() / 2) or 1.0

    @lazy
    def _ends(self) -> np.ndarray:
        roots = self.faces[..., :: len(self) // FAN]
        return np.array((np.nanmin(roots[:, 0], axis=1), np.nanmax(roots[:, 1], axis=1)))

    @lazy
    def near_faces(self) -> np.ndarray | None:
        """The faces as float32, from the middle, in units of the reach, for rays that begin within FAR of the middle;
        None if some boxes are so small that MARGIN would enlarge them by much.
        """
        faces = (self.faces - self.middle[:, None, None]) / self.reach
        sizes = (faces[:, 1] - faces[:, 0]).max(axis=0)[(self.count > 0) & self.there]
        if np.quantile(sizes, SMALLEST) < 16 * MARGIN:
            return None
        faces += np.array((-MARGIN, MARGIN))[:, None]
        return faces.astype(np.float32)


def enlarged(low: np.ndarray, high: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the corners of boxes, (3, b) each, outside of which no hit lies by rounding."""
    reach = BOX_MARGIN * (high - low + np.maximum(np.abs(low), np.abs(high)))
    return low - reach, high + reach


def tree_of(low: np.ndarray, high: np.ndarray, body: np.ndarray) -> Tree:
    """Return the tree of some bodies, (b,) indices, b > 0, given the corners of their boxes, (3, b) each."""
    order = _order(low / 2 + high / 2)
    levels = [(low[:, order], high[:, order])]
    step = LEAF
    while len(levels) < 2 or levels[-1][0].shape[1] > FAN:
        starts = np.arange(0, levels[-1][0].shape[1], step)
        low, high = levels[-1]
        lowest, highest = np.fmin.reduceat(low, starts, axis=1), np.fmax.reduceat(high, starts, axis=1)
        levels.append((_padded(lowest), _padded(highest)))
        step = FAN
    sizes = [level[0].shape[1] for level in levels[:0:-1]]
    rows = np.cumsum(sizes) // FAN  # the first row of the next level
    row = np.concatenate([first + np.arange(size) for first, size in zip(rows, sizes, strict=True)])
    count = np.zeros(len(row), np.intp)
    leaves = slice(-sizes[-1], None)
    row[leaves] = np.arange(sizes[-1]) * LEAF
    count[leaves] = np.clip(len(body) - row[leaves], 0, LEAF)
    faces = np.array([np.concatenate([level[k] for level in levels[:0:-1]], axis=1) for k in (0, 1)]).swapaxes(0, 1)
    faces = _by_slot(faces)
    return Tree(faces, ~np.isnan(faces[0, 0]), _by_slot(row), _by_slot(count), body[order])


def _by_slot(values: np.ndarray) -> np.ndarray:
    """Return values of nodes, (..., n), that stand row by row, with the nodes of a row as many places apart as there
    are rows.
    """
    rows = values.reshape(*values.shape[:-1], -1, FAN)
    return np.ascontiguousarray(rows.swapaxes(-1, -2)).reshape(values.shape)


def _padded(values: np.ndarray) -> np.ndarray:
    """Return values (3, n) with as many NaN as fill the last row."""
    return np.pad(values, ((0, 0), (0, -values.shape[1] % FAN)), constant_values=np.nan)


def _order(middle: np.ndarray) -> np.ndarray:
    """Return the order in which the middles of boxes, (3, b), are divided again and again: at the median along the axis
    in which the part is longest.
    """
    count = middle.shape[1]
    order, position, step = np.arange(count), np.arange(count), LEAF
    while step < count:
        step *= 2
    while step > LEAF:
        ordered, starts, run = middle[:, order], np.arange(0, count, step), position // step
        length = np.maximum.reduceat(ordered, starts, axis=1) - np.minimum.reduceat(ordered, starts, axis=1)
        order = order[np.lexsort((ordered[length.argmax(axis=0)[run], position], run))]
        step //= 2
    return order


def morton(points: np.ndarray, bits: int = 10, even: bool = False) -> np.ndarray:
    """Return the places of points (d, n) along Morton's curve through the box of all points, (n,) int64. Each side of
    the box is divided into 2^bits steps, or, if these are ``even``, the longest one.
    """
    axes = len(points)
    spread = np.zeros(1 << bits, np.int64)
    for bit in range(bits):
        spread |= (np.arange(1 << bits) >> bit & 1) << (bit * axes)
    least, sides = points.min(axis=1), np.ptp(points, axis=1)
    code = np.zeros(points.shape[1], np.int64)
    for axis, side in enumerate(np.full(axes, sides.max()) if even else sides):
        if side > 0:
            steps = (points[axis] - least[axis]) * (((1 << bits) - 1) / side)
            code |= spread.take(steps.astype(np.intp), mode="clip") << axis
    return code
