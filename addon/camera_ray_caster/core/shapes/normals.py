"""Unit normals of many shapes at once: one table row a shape, looked up by each pixel's shape index.

As far as its direction goes, the normal at P of a round sphere is P - centre, of a plane its third inverse row, and of
an ellipsoid A^-T q with q = A^-1 (P - centre) in two steps: the product A^-T A^-1 would square the ratio of its axes,
whereas an error of q along a short axis is an error along the normal, which does not count. A last row of zeros serves
the pixels that hit nothing (index -1).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..records import SPHERE, Pose, Shapes
from ..vector import components, dot, matvec, rows
from .placed import Placed


@dataclass(frozen=True)
class NormalTable:
    """The constants of the normals, world frame, with a row of zeros at the end."""

    gain: np.ndarray
    """(n + 1,): 1 for round spheres, else 0."""
    offset: np.ndarray
    """(3, n + 1): from the centre to the eye for round spheres, towards the eye for planes."""
    ellipsoid: np.ndarray | None
    """(n + 1,) bool; None where there is none."""
    matrix: np.ndarray
    """(n, 3, 3): shape_from_world, scaled by powers of two to about 1."""
    centre: np.ndarray
    """(n, 3): matrix @ (centre - eye)."""

    def look_up(self, index, point):
        """Return unit normals as components for shape indices and eye-relative world points of the same shape.

        index is an array like the points, or one number for all. Zero where it is -1. Outward on spheres, towards
        the eye on planes. Right to EPS (distance / radius).
        """
        gain = self.gain[index]
        if np.ndim(index) == 0 and gain == 0:
            turned = tuple(self.offset[:, index])
        else:
            turned = tuple(gain * p + np.take(o, index) for p, o in zip(point, self.offset, strict=True))
        if self.ellipsoid is not None and self.ellipsoid[index].any():
            turned = tuple(np.array(np.broadcast_to(component, np.shape(point[0]))) for component in turned)
            where = np.broadcast_to(self.ellipsoid[index], turned[0].shape)
            index = np.broadcast_to(index, where.shape)
            for component, curved in zip(turned, self._curved(index[where], point, where), strict=True):
                component[where] = curved
        length = np.sqrt(dot(turned, turned))
        length = np.maximum(length, np.finfo(float).tiny)
        return tuple(component / length for component in turned)

    def _curved(self, at, point, where):
        matrix = self.matrix[at]
        point = tuple(np.broadcast_to(component, where.shape)[where] for component in point)
        q = tuple(r - c for r, c in zip(matvec(rows(matrix), point), components(self.centre[at]), strict=True))
        return matvec(rows(np.swapaxes(matrix, 1, 2)), q)


def normal_table(shapes: Shapes, placed: Placed, pose: Pose) -> NormalTable:
    """Return the table of these shapes as seen from a pose."""
    n = len(shapes)
    sphere = shapes.kind == SPHERE
    is_round = sphere & (shapes.axes == shapes.axes[:, :1, :1] * np.eye(3)).all(axis=(1, 2))
    towards = np.where(placed.offset[:, 2] > 0, -1.0, 1.0)[:, None]
    gain = np.append(is_round.astype(float), 0.0)
    offset = np.zeros((n + 1, 3))
    offset[:n] = np.where(is_round[:, None], pose.eye - shapes.centre, placed.shape_from_world[:, 2] * towards)
    matrix = placed.shape_from_world
    power = -np.frexp(np.abs(matrix).max(axis=(1, 2), initial=0.0))[1]
    curved = sphere & ~is_round
    return NormalTable(
        gain,
        np.ascontiguousarray(offset.T),
        np.append(curved, False) if curved.any() else None,
        np.ldexp(matrix, power[:, None, None]),
        np.ldexp(placed.offset, power[:, None]),
    )
