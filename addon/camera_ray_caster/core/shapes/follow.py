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
    """The displacements of points."""

    by: np.ndarray
    """(3, k) world; exactly 0 where nothing moved."""
    spread: np.ndarray
    """(k,): upper bound of the difference of ``by`` between neighboring points, over their distance."""
    error: np.ndarray
    """(k,): upper bound of the error of ``by``, as a vector's length, not counting the errors of the points."""


Follow = Callable[[Shapes, np.ndarray, np.ndarray], Moved]
"""Given the shapes at another moment, the rows (n,) that all shapes of this moment have there, and the indices (k,) of
some points whose shapes have such rows, returns how these points move.
"""


def follow_frames(shapes: InCamera, at: np.ndarray, point: Any) -> Follow:
    """Return a function that moves points with the frames of their shapes; the points are given as (m,) components
    relative to the eye, the shapes by their indices (m,).
    """
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
