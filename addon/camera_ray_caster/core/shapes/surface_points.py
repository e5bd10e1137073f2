"""Points of surfaces that move with their shapes from one reading of a scene to another."""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from ..conventions import gamma
from ..maths.speed import taken
from ..maths.vector import components, difference, matrix_rows, matvec, norm
from ..records import Shapes
from .shape_frames import InCamera


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
    now = shapes.shapes

    def moved(then: Shapes, rows: np.ndarray, indices: np.ndarray) -> Moved:
        result = Moved(np.zeros((3, len(indices))), *np.zeros((2, len(indices))))
        seen = np.zeros(len(now), bool)
        seen[at[indices]] = True
        here = np.flatnonzero(seen)  # points are many, shapes are few
        shift, turn = then.center[rows[here]] - now.center[here], then.axes[rows[here]] - now.axes[here]
        moves = (shift != 0).any(axis=1) | (turn != 0).any(axis=(1, 2))
        if not moves.any():
            return result
        entry = np.zeros(len(now), int)
        entry[here[moves]] = 1 + np.flatnonzero(moves)
        shape = taken(entry, taken(at, indices)) - 1
        moving = np.flatnonzero(shape >= 0)
        shape, points = shape[moving], indices[moving]
        shift, turn, inner = shift[shape].T, turn[shape], shapes.shape_from_world[here[shape]]
        offset = difference([c[points] for c in point], components(now.center[here[shape]] - shapes.pose.eye))
        by = np.array(matvec(matrix_rows(turn), np.array(matvec(matrix_rows(inner), offset)))) + shift
        spread = np.sqrt((turn * turn).sum(axis=(1, 2))) * np.sqrt((inner * inner).sum(axis=(1, 2)))
        doubt = (shapes.rounding[here[shape]] + gamma(8)) * norm(offset)
        for values, new in zip(result, (by, spread, doubt * spread + gamma(8) * (norm(shift) + norm(by))), strict=True):
            values[..., moving] = new
        return result

    return moved
