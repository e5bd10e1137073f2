"""The plane, finite (a parallelogram) or infinite: q_z = 0 in the shape's frame, finite where |q_x|, |q_y| <= 1.

With q(t) = t D - N, the hit is at t = N_z / D_z. There q_x = (N x D)_y / -D_z and q_y = (N x D)_x / D_z, so the test
whether it is inside needs no division: |(N x D)_y| <= |D_z| and |(N x D)_x| <= |D_z|. For rays from the eye the cross
product and N_z come from constants of the shape. Edges are therefore right to EPS (distance / size) at any grazing
angle, and N_z is right to EPS of itself however close the eye is to the plane (see ``in_camera``). The normal is the
third row of the inverse axes.
Reference: A. Glassner (ed.), An Introduction to Ray Tracing, 1989, chapter 2 (ray-plane intersection).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..conventions import EPS, gamma
from ..maths.vector import cross, difference, linear, matvec
from ..records import INFINITE_PLANE, PLANE, Shapes
from ..shape_records import KIND_NAMES
from .affine import AffineErrors, AffineKind
from .kind import PixelNormals
from .shape_frames import InCamera

GRAZING = 1 / 16
"""If N_z is below this fraction of the sum of its terms' magnitudes, it is computed with twice the digits."""


@dataclass(frozen=True)
class PlaneConstants:
    """Planes as the eye sees them; the last axis counts the planes."""

    matrix: np.ndarray
    """(3, 3, n): shape_from_camera, with the sign that makes ``offset`` non-negative."""
    center: np.ndarray
    """(3, n) camera frame."""
    offset: np.ndarray
    """(n,): N_z for rays from the eye."""
    cross: np.ndarray
    """(2, 3, n): matrix from a camera direction to the x and y components of N x D, for rays from the eye."""


class Plane(AffineKind):
    """Parallelograms."""

    number = PLANE
    name = KIND_NAMES[PLANE]
    meets_once = True
    faces_eye = True
    has_edges = True

    def extent(self, shapes: Shapes, at: np.ndarray, axes: np.ndarray):
        """See ``Kind``. The sphere holds the farther pair of corners."""
        gram = np.abs(np.einsum("nij,nkj->nik", axes, axes))
        ahead = np.abs(axes[..., 2])
        return np.sqrt(gram[:, 0, 0] + gram[:, 1, 1] + 2 * gram[:, 0, 1]), ahead[:, 0] + ahead[:, 1]

    def half_sides(self, axes: np.ndarray) -> Any:
        return np.abs(axes[..., :2]).sum(axis=2)

    def is_close(self, offset: np.ndarray, shape_from_world: np.ndarray, away: np.ndarray) -> np.ndarray:
        """See ``Kind``: N_z cancels if the eye is near the plane."""
        return np.abs(offset[:, 2]) < GRAZING * np.abs(shape_from_world[:, 2] * away).sum(axis=-1)

    def constants(self, shapes: InCamera, at: np.ndarray, parallel=None) -> PlaneConstants:
        center, offset = shapes.center[at].T, shapes.offset[at].T
        matrix = shapes.shape_from_camera[at].transpose(1, 2, 0)
        sign = np.where(offset[2] < 0, -1.0, 1.0)  # q and -q are the same plane
        matrix, offset = matrix * sign, offset * sign
        (x, y, z), (to_x, to_y, to_z) = offset, matrix
        return PlaneConstants(matrix, center, z, np.stack((y * to_z - z * to_y, z * to_x - x * to_z)))

    def intersect(self, constants: PlaneConstants, origin, direction, start: Any, scratch):
        """See ``AffineKind``. Both sides are visible. A ray within the plane does not hit it."""
        matrix = constants.matrix
        shape = np.broadcast_shapes(np.shape(constants.offset), *map(np.shape, direction), *map(np.shape, origin or ()))
        d_z, t, across = (scratch(name, shape) for name in ("ahead", "found", "across"))
        linear(matrix[2], direction, d_z, across)
        if origin is None:
            np.divide(constants.offset, d_z, out=t)
        else:
            n = matvec(matrix, difference(constants.center, origin))
            np.divide(n[2], d_z, out=t)
        hit = (t >= (0.0 if start is None else start)) & (t < np.inf)
        if self.has_edges:
            np.abs(d_z, out=d_z)
            for row in range(2):
                if origin is None:
                    linear(constants.cross[row], direction, across, scratch("spare", shape))
                else:
                    np.copyto(across, cross(n, matvec(matrix, direction))[row])
                hit &= np.abs(across, out=across) <= d_z
        return t, hit

    def in_front(self, constants: PlaneConstants) -> np.ndarray:
        """See ``AffineKind``; all are 0 for planes through the eye, which rays of both sides hit at t = 0."""
        ahead = constants.matrix[2:]
        functions = np.concatenate((ahead, constants.cross)) if self.has_edges else ahead
        return np.where(constants.offset > 0, functions, 0.0)

    def lattice(self, constants: PlaneConstants, direction) -> PlaneLattice:
        return PlaneLattice(constants, self.has_edges, direction)

    def normals(self, shapes: InCamera, at: np.ndarray) -> tuple[np.ndarray, PixelNormals | None]:
        """See ``Kind``; the normals point towards the eye."""
        normal = shapes.shape_from_world[at, 2] * np.where(shapes.offset[at, 2] > 0, -1.0, 1.0)[:, None]
        normal = normal / np.abs(normal).max(axis=1, initial=0.0, keepdims=True)
        normal = normal / np.sqrt((normal * normal).sum(axis=1, keepdims=True)) + 0.0  # never -0
        return np.hstack((np.zeros((len(at), 1)), normal)), None

    def surface_coordinates(self, q):
        """Return (q + 1) / 2: 0 .. 1 across a finite plane, unbounded on an infinite one."""
        return (q[0] + 1) / 2, (q[1] + 1) / 2

    def root_error(self, hits: AffineErrors) -> np.ndarray:
        """Return an error bound of tau as the root of tau D_z = N_z."""
        local, tau = hits.local, hits.tau
        d, n, d_error, n_error = local.z()
        size, along = np.abs(n), tau * d
        if local.from_eye:
            parts = local.offset.row("parts", 2)
            exact = size < GRAZING / 4 * parts
            n_error = np.where(exact, gamma(4) * size + 64 * EPS * EPS * parts, n_error)
        residual = np.abs(along - n) + np.abs(tau) * d_error + n_error + gamma(2) * (np.abs(along) + size)
        steep = np.abs(d) - d_error
        return np.where(steep > 0, residual / steep, np.inf)

    def normal_error(self, hits: AffineErrors, point: np.ndarray) -> np.ndarray:
        return hits.local.frame.rounding


class InfinitePlane(Plane):
    """Planes without edges: infinite planes."""

    number = INFINITE_PLANE
    name = KIND_NAMES[INFINITE_PLANE]
    has_edges = False

    def half_sides(self, axes: np.ndarray) -> Any:
        """See ``AffineKind``: there is no box."""
        return np.inf

    def extent(self, shapes: Shapes, at: np.ndarray, axes: np.ndarray):
        return np.inf, np.inf


class PlaneLattice:
    """Planes and the rays of a pinhole: x is a row, y a column, z a number. D_z and N x D are affine in the pixel then:
    if the corners of a window show that a plane covers or misses all of it, no other pixel is tested.
    """

    def __init__(self, planes: PlaneConstants, has_edges: bool, direction):
        """Take constants with two more axes behind the axis that counts the planes."""
        x, y, z = direction
        edges = planes.cross if has_edges else planes.cross[:0]
        terms = np.concatenate((planes.matrix[2:], edges))
        self._row, self._column = terms[:, 0] * x, terms[:, 1] * y + terms[:, 2] * z
        reach = np.array([np.abs(x).max(), np.abs(y).max(), abs(z)])
        largest = (np.abs(terms) * reach.reshape(3, 1, 1, 1)).sum(axis=1)
        self._doubt = (gamma(8) * (largest[0] + largest[1:].max(axis=0, initial=0)))[:, 0, 0]
        self._offset = planes.offset
        self._is_level = terms[0, 0, :, 0, 0] == 0

    def meet(self, k: int, window, scratch):
        """Return t of the k-th plane in a window of the rays, and where t is a hit, as ``Large.solve`` does."""
        rows, columns = window
        row, column = self._row[:, k, :, columns], self._column[:, k, rows]
        corners = row[..., [0, -1]] + column[:, [0, -1]]
        slack = np.concatenate((corners[:1], corners[0] - corners[1:], corners[0] + corners[1:]))
        if (slack.max(axis=(1, 2)) < -self._doubt[k]).any():
            return None, None
        shape = column.shape[1], row.shape[2]
        d_z = column[0]
        if not self._is_level[k]:  # otherwise d_z depends on the row alone: a floor, a camera without roll
            d_z = np.add(row[0], column[0], out=scratch("ahead", shape))
        t = np.divide(self._offset[k], d_z, out=scratch("found", d_z.shape))
        if (slack > self._doubt[k]).all():
            return t, True
        hit, d_z = (t >= 0.0) & (t < np.inf), np.abs(d_z)
        for terms in zip(row[1:], column[1:], strict=True):
            across = np.add(*terms, out=scratch("across", shape))
            hit = hit & (np.abs(across, out=across) <= d_z)
        return t, hit


PLANES = Plane()
INFINITE_PLANES = InfinitePlane()
