"""Symmetries of models: the rotations that map the vertices, normals and colors of a model onto themselves.

The candidates are n-fold rotations about the axes of the object, n up to MOST, and the rotations of a cube, all about
the mean of the vertices. A model with an n-fold symmetry of at least ROUND counts as a surface of revolution: it
differs from one by up to 2 %, where data sets allow 10 % of its size. Two sets of points are considered equal if their
characteristic functions, the sums of exp(i k x), are equal at some vectors k.
References: see ``object_scenes``.
"""

from itertools import permutations, product
from typing import Any

import numpy as np

from ..maths.rotations import transform

MOST, ROUND = 128, 16

PROBES, SPREAD = 8, 5.0
"""Number of the vectors k, and the spread of their entries; the first ones tell most sets apart."""

EQUAL, RANDOM = 1e-6, 1e-4
"""Largest difference of the sums, as a part of the number of points and of its root: float32 rounds both."""


def symmetries(vertices: np.ndarray, normals: np.ndarray, colors: np.ndarray) -> dict[str, list[Any]]:
    """Return the entries symmetries_discrete, matrices of 16 numbers by rows, and symmetries_continuous, axes with an
    offset, as far as there are any.

    vertices, normals, colors: (n, 3); lengths in those of the entries. Normals of 0 stand for surfaces without a front.
    """
    middle = vertices.mean(axis=0)
    size = np.abs(vertices - middle).max()
    if not size > 0:
        return {}
    points = _Points((vertices - middle) / size, normals, colors)
    turns, axes = [], []
    for axis in range(3):
        moved = points.count_off(axis)
        folds = (n for n in range(MOST, 1, -1) if moved % n == 0 and points.stay(_turn(axis, n)))
        fold = next(folds, 1)
        if fold >= ROUND:
            axes.append(axis)
        elif fold > 1:
            turns.append(_turn(axis, fold))
    turns += [turn for turn in _of_cube() if points.stay(turn)]
    if axes:  # the only other turns are those that swap the ends of the axis
        turns = [turn for turn in turns if len(axes) == 1 and turn[axes[0], axes[0]] < -0.5][:1]
    return _entries(_group(turns), axes, middle)


def of_ellipsoid(size: np.ndarray) -> dict[str, list[Any]]:
    """Return the symmetries of an ellipsoid of one color: continuous ones about an axis if the other two are equal."""
    others = [np.delete(size, axis) for axis in range(3)]
    axes = [axis for axis, (first, second) in enumerate(others) if np.isclose(first, second, rtol=EQUAL)]
    flips = [] if len(axes) > 1 else [_turn(axis, 2) for axis in range(3)]
    if axes:
        flips = [flip for flip in flips if flip[axes[0], axes[0]] < 0][:1]
    return _entries(flips, axes, np.zeros(3))


def _entries(turns: list[np.ndarray], axes: list[int], middle: np.ndarray) -> dict[str, list[Any]]:
    """Return the entries of rotations and of axes of revolution through a point, as far as there are any."""
    entries: dict[str, list[Any]] = {}
    if turns:
        entries["symmetries_discrete"] = [_matrix(turn, middle) for turn in turns]
    if axes:
        offset = middle.tolist()
        entries["symmetries_continuous"] = [{"axis": axis, "offset": offset} for axis in np.eye(3)[axes].tolist()]
    return entries


class _Points:
    """A set of points, and whether rotations map it onto itself."""

    def __init__(self, places: np.ndarray, normals: np.ndarray, colors: np.ndarray):
        self.places, self.normals = places, normals
        random = np.random.default_rng(1)
        self.along, self.across = random.normal(0, SPREAD, (2, PROBES, 3))
        self.tint = colors @ random.normal(0, SPREAD, (3, PROBES))
        self.moments = places.T @ places
        self.allowed = EQUAL * len(places) + RANDOM * np.sqrt(len(places))
        self.sums = [self._sum(np.eye(3), k) for k in range(PROBES)]

    def _sum(self, turn: np.ndarray, k: int) -> complex:
        phase = self.places @ (turn.T @ self.along[k]) + self.normals @ (turn.T @ self.across[k]) + self.tint[:, k]
        return complex(np.exp(1j * phase).sum())

    def count_off(self, axis: int) -> int:
        """Return the number of points that are not on an axis: they move by turns about it in sets of n."""
        return int((np.hypot(*np.delete(self.places, axis, axis=1).T) > EQUAL).sum())

    def stay(self, turn: np.ndarray) -> bool:
        """Return whether a rotation maps the points onto themselves."""
        if np.abs(turn @ self.moments @ turn.T - self.moments).max() > self.allowed:
            return False
        return all(abs(self._sum(turn, k) - self.sums[k]) <= self.allowed for k in range(PROBES))


def _turn(axis: int, fold: int) -> np.ndarray:
    """Return the rotation (3, 3) about an axis by a part of a turn."""
    turn, (i, j) = np.eye(3), [(1, 2), (2, 0), (0, 1)][axis]
    sine, cosine = np.sin(2 * np.pi / fold), np.cos(2 * np.pi / fold)
    turn[i, i] = turn[j, j] = cosine
    turn[i, j], turn[j, i] = -sine, sine
    return turn


def _of_cube() -> list[np.ndarray]:
    """Return the rotations (3, 3) of a cube but the identity."""
    signs = list(product((1, -1), repeat=3))
    signed = [np.eye(3)[list(order)] * sign for order in permutations(range(3)) for sign in signs]
    return [turn for turn in signed if np.linalg.det(turn) > 0 and np.trace(turn) < 2.5]


def _group(turns: list[np.ndarray]) -> list[np.ndarray]:
    """Return all products of rotations but the identity, each once."""
    group = [np.eye(3)]
    for element in group:
        for turn in turns:
            product_ = element @ turn
            if not any(np.allclose(product_, other, atol=1e-9) for other in group):
                group.append(product_)
    return group[1:]


def _matrix(turn: np.ndarray, middle: np.ndarray) -> list[float]:
    return transform(turn, middle - turn @ middle).ravel().tolist()
