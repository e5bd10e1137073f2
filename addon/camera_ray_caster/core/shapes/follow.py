"""Points of surfaces that move with their shapes from one reading of a scene to another."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from ..conventions import gamma
from ..maths.vector import components, difference, matrix_rows, matvec, norm
from ..records import Shapes
from .frames import InCamera


class Moved(NamedTuple):
    """How far points are from where they were."""

    by: np.ndarray
    """(3, k) world; exactly 0 where nothing moved."""
    spread: np.ndarray
    """(k,): how much farther ``by`` takes apart points beside each other, at most, over their distance."""
    error: np.ndarray
    """(k,): how wrong ``by`` is at most, as a vector's length, beside what the points' own errors make of it."""


Follow = Callable[[Shapes, np.ndarray, np.ndarray], Moved]
"""Given the shapes at another moment, the rows (n,) there of all shapes of this one, and the indices (k,) of some of
the points, whose shapes have rows, tells how these move.
"""


def follow_frames(shapes: InCamera, at: np.ndarray, point: Any) -> Follow:
    """Return what moves points (m,), components relative to the eye, with the frames of the shapes at indices (m,)."""
    now, inner = shapes.shapes, shapes.shape_from_world[at]
    offset = difference(point, components(now.center[at] - shapes.pose.eye))
    place = np.array(matvec(matrix_rows(inner), offset))
    size, condition = norm(offset), np.sqrt((inner * inner).sum(axis=(1, 2)))
    doubt = (shapes.rounding[at] + gamma(8)) * size

    def moved(then: Shapes, rows: np.ndarray, some: np.ndarray) -> Moved:
        here, there = at[some], rows[at[some]]
        shift, turn = then.center[there] - now.center[here], then.axes[there] - now.axes[here]
        by = np.array(matvec(matrix_rows(turn), place[:, some])) + shift.T
        spread = np.sqrt((turn * turn).sum(axis=(1, 2))) * condition[some]
        return Moved(by, spread, doubt[some] * spread + gamma(8) * (norm(shift.T) + norm(by)))

    return moved
