"""A table of rays, prepared for the interpolation between its entries: checked, continued, with its errors and bounds.

Row 0 is the bottom row. An entry is a direction of any length and, unless all rays leave the eye, an origin. Where one
of the numbers is NaN, there is no ray. Directions are interpolated as unit vectors, component by component.
"""

from __future__ import annotations

import math

import numpy as np

from ...conventions import EPS32
from ...maths.recording import Entries
from ...maths.speed import lazy
from ...memory import require
from ...records import InputError
from .extended import WIDE, control_points, extended
from .seen_parts import PARTS, SeenParts

CUBIC, LINEAR, SPLINE, NONE = "CUBIC", "LINEAR", "SPLINE", "NONE"
"""Kinds of interpolation: a cubic spline through the entries, straight lines between them, a cubic B-spline whose
control points the entries are, and none: the ray of the nearest entry, whatever its neighbors are.
"""

AROUND = 2
"""Entries beyond the outermost ones that the interpolation reads."""

FOLDED = 8 * EPS32
"""Size, over the sides of a cell of unit vectors, of a volume that float32's rounding may have turned around."""

BYTES_PER_NUMBER = 64
"""Memory that a number of a table takes while it is prepared."""


class RayGrid:
    """A table of rays. Its attributes never change; ``lazy`` ones are computed at first use."""

    def __init__(self, directions: np.ndarray, origins: np.ndarray | None, kind: str):
        """Prepare a table: directions and origins (rows, columns, 3), origins None for rays that leave the eye.

        Raises InputError, which says which entry is wrong, for another shape, a table without rays, directions of
        length 0 or infinite numbers, neighbors more than 90 degrees apart, and a table that folds.
        """
        self.kind, self.shape = kind, directions.shape[:2]
        least = {SPLINE: 4, NONE: 1}.get(kind, 2)
        if directions.ndim != 3 or directions.shape[2] != 3 or min(self.shape) < least:
            raise InputError(f"directions are of shape {directions.shape}: they must be (rows, columns, 3), {least} or "
                             "more rows and columns")  # fmt: skip
        if origins is not None and origins.shape != directions.shape:
            raise InputError(f"origins are of shape {origins.shape}, and directions of {directions.shape}")
        count = 3 if origins is None else 6
        sides = "{1} x {0}".format(*self.shape)
        require(BYTES_PER_NUMBER * count * self.shape[0] * self.shape[1], f"the rays of a table of {sides}",
                "give a coarser table: rays between its entries are interpolated")  # fmt: skip
        if np.isinf(directions).any() or (origins is not None and np.isinf(origins).any()):
            raise InputError("it has infinite numbers: give NaN where there is no ray")
        with np.errstate(invalid="ignore", over="ignore"):
            scaled = directions / np.abs(directions).max(axis=2, keepdims=True)
            length = np.sqrt((scaled * scaled).sum(axis=2, keepdims=True))
        self.known = np.isfinite(directions).all(axis=2)
        none = self.known & (directions == 0).all(axis=2)
        _refuse(none, "is a direction of length 0: give NaN where there is no ray")
        if origins is not None:
            self.known &= np.isfinite(origins).all(axis=2)
        if not self.known.any():
            raise InputError("it has no ray: each entry has NaN")
        self.directions = np.where(self.known[..., None], scaled / length, np.nan)
        self.origins = None if origins is None or not np.nan_to_num(origins).any() else origins
        if kind != NONE:
            _check_neighbors(self.directions, self.origins)

    def slid(self) -> RayGrid:
        """Return the table with each origin moved along its ray to the foot of the perpendicular from the mean origin.

        Origins are arbitrary along a ray: where they jump from entry to entry, the rays do not.
        """
        if self.origins is None:
            return self
        middle = self.origins[self.known].mean(axis=0)
        along = ((middle - self.origins) * self.directions).sum(axis=2, keepdims=True)
        return RayGrid(self.directions, self.origins + along * self.directions, self.kind)

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
        """The numbers that the interpolation sums with weights, (rows + 4, columns + 4, 3 or 6): control points, or for
        LINEAR the entries and their continuation.
        """
        return nodes_of(self.values, self.known, self.kind)

    @lazy
    def columns(self) -> list[Entries]:
        """The components of ``nodes``, each as a flat table: a row after the other."""
        table = self.nodes.reshape(-1, self.nodes.shape[2])
        return [Entries(table, column) for column in range(table.shape[1])]

    @lazy
    def has_ray(self) -> Entries:
        """Flat table of 1 for entries with a ray and 0 for others."""
        return Entries(self.known.reshape(-1, 1).astype(np.float64))

    @lazy
    def farthest(self) -> float:
        """The largest distance of an origin from the eye."""
        return 0.0 if self.origins is None else float(np.sqrt((self.nodes[..., 3:] ** 2).sum(axis=2)).max())

    @lazy
    def largest(self) -> float:
        """The largest length of a control point of directions."""
        return float(np.sqrt((self.nodes[..., :3] ** 2).sum(axis=2)).max())

    @lazy
    def shortest(self) -> float:
        """A length that interpolated directions have at least: 0.9 of the least in the middle of a cell."""
        if self.kind == NONE:
            return 1.0
        row, column = (np.arange(side - 1) + 0.5 for side in self.shape)
        whole = self.known[1:, 1:] & self.known[1:, :-1] & self.known[:-1, 1:] & self.known[:-1, :-1]
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
        worst = [(0.0, 0.0)]
        for first in (0, 1):
            half = self.values[first::2, first::2]
            known = self.known[first::2, first::2]
            if min(known.shape) < 2 or not known.any():
                continue
            row, column = (np.arange(side) / 2 - first / 2 for side in self.shape)
            interpolated = between(nodes_of(half, known, self.kind), row[:, None], column, self.kind)
            near = known[np.ix_(*(np.clip(np.floor(positions + 0.5).astype(int), 0, side - 1)
                                  for positions, side in zip((row, column), known.shape, strict=True)))]  # fmt: skip
            worst.append(self._off(interpolated, near & self.known))
        order = 2 if self.kind == LINEAR else 4
        angle, distance = np.max(worst, axis=0) / 2**order
        return float(angle), float(distance)

    def _off(self, rays: np.ndarray, counts: np.ndarray) -> tuple[float, float]:
        """Return the largest angle between the table's directions and others, and distance of its origins."""
        if not counts.any():
            return 0.0, 0.0
        rays, entries = rays[counts], self.values[counts]
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
        nodes, known = self.nodes, np.pad(self.known, 1)
        if self.kind == LINEAR:
            nodes = nodes[1:-1, 1:-1]
        places, scales = [], []
        for side in self.shape:  # rows, then columns: each step turns the table
            finer = max(0, math.ceil(math.log2(PARTS / (side + 1))))
            for _ in range(finer):
                nodes = _finer(nodes, self.kind)
            cells = (side + 1) << finer
            places.append(np.unique(np.linspace(0, cells, min(cells, 2 * PARTS) + 1).astype(int)))
            scales.append(0.5**finer)
            nodes, known = nodes.swapaxes(0, 1), (known[1:] | known[:-1]).repeat(1 << finer, axis=0).swapaxes(0, 1)
        low, high = (_blocks(end, nodes, known, places) for end in (np.fmin, np.fmax))
        v, u = (np.stack((ends[:-1], ends[1:]), axis=1) * scale - 1
                for ends, scale in zip(places, scales, strict=True))  # fmt: skip
        return SeenParts(low, high, np.concatenate(np.broadcast_arrays(u[None], v[:, None]), axis=2))

    def _seen_entries(self) -> SeenParts:
        places = [np.unique(np.linspace(0, side, min(side, 2 * PARTS) + 1).astype(int)) for side in self.shape]
        low = high = self.values
        for axis, ends in enumerate(places):
            low, high = (end.reduceat(each, ends[:-1], axis=axis) for end, each in ((np.fmin, low), (np.fmax, high)))
        v, u = (np.stack((ends[:-1], ends[1:]), axis=1) - 0.5 for ends in places)
        return SeenParts(low, high, np.concatenate(np.broadcast_arrays(u[None], v[:, None]), axis=2))


def nodes_of(values: np.ndarray, known: np.ndarray, kind: str) -> np.ndarray:
    """Return what the interpolation of a table (rows, columns, k) sums with weights: (rows + 4, columns + 4, k)."""
    if kind == NONE:
        return np.pad(np.nan_to_num(values), ((AROUND, AROUND), (AROUND, AROUND), (0, 0)), mode="edge")
    wide = extended(values, known, 1 if kind == LINEAR else 3)
    kept = slice(WIDE - AROUND, AROUND - WIDE)
    return (control_points(wide) if kind == CUBIC else wide)[kept, kept]


def _finer(nodes: np.ndarray, kind: str) -> np.ndarray:
    """Return the nodes of the halves of cells along the first axis: the same curve."""
    middle = (nodes[1:] + nodes[:-1]) / 2
    finer = np.empty((2 * len(nodes) - (1 if kind == LINEAR else 3), *nodes.shape[1:]))
    if kind == LINEAR:
        finer[::2], finer[1::2] = nodes, middle
    else:  # E. Catmull and J. Clark, Recursively Generated B-Spline Surfaces, CAD 10 (1978)
        finer[::2], finer[1::2] = middle, (middle[1:] + middle[:-1] + 2 * nodes[1:-1]) / 4
    return finer


def _blocks(end: np.ufunc, nodes: np.ndarray, known: np.ndarray, places: list[np.ndarray]) -> np.ndarray:
    """Return the least or largest components of what blocks of cells read; NaN for blocks without rays."""
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
    """Return the interpolated vectors (rows, columns, k) of ``nodes_of`` at places (rows, 1) and (columns,)."""
    for positions in (row[:, 0], column):
        cell = np.floor(positions).astype(int)
        first = cell + AROUND - (kind != LINEAR)
        weights = weights_of(positions - cell, kind)
        nodes = sum(nodes[first + k] * weight[:, None, None] for k, weight in enumerate(weights)).swapaxes(0, 1)
    return nodes


def _check_neighbors(directions: np.ndarray, origins: np.ndarray | None) -> None:
    """Raise InputError for neighbors more than 90 degrees apart, and if the table folds: if the rays of some of its
    cells turn the other way round than those of most.
    """
    for first, second in ((directions[:-1], directions[1:]), (directions[:, :-1], directions[:, 1:])):
        _refuse((first * second).sum(axis=2) < 0, "is more than 90 degrees away from its neighbor's ray: give a finer "
                "table, or NaN between parts of the picture that do not belong together")  # fmt: skip
    ways = _turns(directions, directions)
    if not any(way.any() for way in ways) and origins is not None:  # the rays are parallel
        ways = _turns(directions, origins)
    fewer = min(ways, key=np.count_nonzero)
    _refuse(fewer, "and its neighbors fold over: the table turns back there, so that several pixels see one point")


def _turns(directions: np.ndarray, corners: np.ndarray) -> list[np.ndarray]:
    """Return which cells (rows - 1, columns - 1) turn one way, seen along their directions, and which the other way."""
    right, up = corners[:, 1:] - corners[:, :-1], corners[1:] - corners[:-1]
    right, up = right[1:] + right[:-1], up[:, 1:] + up[:, :-1]
    middle = directions[1:, 1:] + directions[:-1, :-1]
    volume = (middle * np.cross(right, up)).sum(axis=2)
    lengths = [np.sqrt((side * side).sum(axis=2)) for side in (right, up)]
    with np.errstate(invalid="ignore"):
        scale = np.nanmax(np.abs(corners)) * (lengths[0] + lengths[1])
        return [volume > FOLDED * scale, volume < -FOLDED * scale]


def _refuse(where: np.ndarray, reason: str) -> None:
    """Raise InputError that names the first entry at which ``where`` holds."""
    if where.any():
        row, column = np.argwhere(where)[0].tolist()
        raise InputError(f"the ray in column {column}, row {row} (from the bottom left) {reason}")
