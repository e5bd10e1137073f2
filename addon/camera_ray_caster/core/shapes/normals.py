"""Unit normals of many shapes at once: one table column a shape, looked up by each pixel's shape index.

As far as its direction goes, the normal at P of a round sphere is P - center, of a plane its third inverse row, and of
an ellipsoid A^-T q with q = A^-1 (P - center) in two steps: the product A^-T A^-1 would square the ratio of its axes,
whereas an error of q along a short axis is an error along the normal, which does not count. A last column of zeros
serves the pixels that hit nothing (index -1).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..maths.vector import components, difference, matvec, norm, rows, unit
from ..records import SPHERE, Pose, Shapes
from .in_camera import Placed

ZERO = np.zeros((3, 1, 1))
"""The term that adds nothing."""

FAR = 1e4
"""Radii. The normal of a sphere nearer than that has unit length to 1e-11 as it comes: the root is left out."""


@dataclass(frozen=True)
class NormalTable:
    """The constants of the normals, world frame, with a column of zeros at the end."""

    constants: np.ndarray
    """(4, n + 1): the gain, 1 / radius for round spheres, else 0, and the offset, from the center to the eye in radii
    for round spheres, unit normals towards the eye for planes.
    """
    unit: bool
    """Whether gain times point plus offset has unit length as it comes."""
    curved: Curved | None
    """The ellipsoids; None where there is none."""

    @property
    def is_sum(self) -> bool:
        """Whether gain times point plus offset is all there is to do."""
        return self.unit and self.curved is None

    def look_up(self, hits) -> tuple[np.ndarray, np.ndarray]:
        """Return two terms whose sum is the unit normal where something is hit, (3, rows, columns) components in arrays
        of the hits' scratch; the second is ZERO where there is more to do than to add them.

        Outward on spheres, towards the eye on planes. Right to EPS (distance / radius), in length, too.
        """
        constants = hits.look_up(self.constants, "constants")
        gain, offset = constants[0], constants[1:]
        normal = np.multiply(gain, hits.point, out=hits.scratch("turned", offset.shape, np.float64))
        if self.is_sum:
            return normal, offset
        np.add(normal, offset, out=normal)
        if self.curved is not None:
            self.curved.put(hits, normal)
        if not self.unit:
            np.divide(normal, np.maximum(norm(normal), np.finfo(float).tiny), out=normal)
        return normal, ZERO


@dataclass(frozen=True)
class Curved:
    """The constants of the ellipsoids' normals."""

    where: np.ndarray
    """(n + 1,): which shapes are ellipsoids, bool."""
    matrix: np.ndarray
    """(n, 3, 3): shape_from_world, scaled by powers of two to about 1."""
    center: np.ndarray
    """(n, 3): matrix @ (center - eye)."""

    def put(self, hits, normal) -> None:
        """Write the ellipsoids' unit normals over what the components have there."""
        where = hits.look_up(self.where, "curved")
        at = hits.rows[where]
        q = difference(matvec(rows(self.matrix[at]), [part[where] for part in hits.point]), components(self.center[at]))
        for component, part in zip(normal, unit(matvec(rows(np.swapaxes(self.matrix[at], 1, 2)), q)), strict=True):
            component[where] = part


def normal_table(shapes: Shapes, placed: Placed, pose: Pose, seen) -> NormalTable:
    """Return the table of these shapes as seen from a pose; ``seen``: the rows of those that can be."""
    n = len(shapes)
    sphere = shapes.kind == SPHERE
    is_round = sphere & (shapes.axes == shapes.axes[:, :1, :1] * np.eye(3)).all(axis=(1, 2))
    flat = placed.shape_from_world[:, 2] * np.where(placed.offset[:, 2] > 0, -1.0, 1.0)[:, None]
    flat = flat / np.abs(flat).max(axis=1, initial=0.0, keepdims=True)
    gain, offset = np.zeros(n + 1), np.zeros((n + 1, 3))
    gain[:n][is_round] = 1 / np.abs(shapes.axes[is_round, 0, 0])
    flat = flat / np.sqrt((flat * flat).sum(axis=1, keepdims=True))
    offset[:n] = np.where(is_round[:, None], (pose.eye - shapes.center) * gain[:n, None], flat) + 0.0  # never -0
    curved = sphere & ~is_round
    far = np.abs(offset[seen]).max(initial=0.0)
    return NormalTable(
        np.vstack((gain, offset.T)), bool(far < FAR), _curved(placed, curved) if curved[seen].any() else None
    )


def _curved(placed: Placed, where) -> Curved:
    matrix = placed.shape_from_world
    power = -np.frexp(np.abs(matrix).max(axis=(1, 2), initial=0.0))[1]
    scaled = np.ldexp(matrix, power[:, None, None])
    return Curved(np.append(where, False), scaled, np.ldexp(placed.offset, power[:, None]))
