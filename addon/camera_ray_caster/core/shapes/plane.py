"""The plane, finite (a parallelogram) or infinite: q_z = 0 in the shape's frame, finite where |q_x|, |q_y| <= 1.

With q(t) = t D - N: t = N_z / D_z, and inside is decided without that division: q_x = (N x D)_y / -D_z and
q_y = (N x D)_x / D_z, so |(N x D)_y| <= |D_z| and |(N x D)_x| <= |D_z|. The cross product comes from constants of the
shape for rays from the eye, so that edges are right to EPS (distance / size), however grazing the plane is; and so does
N_z, which is right to EPS of itself however near the plane's own plane the eye is (see placed).
Reference: the ray-plane intersection of every textbook (Glassner, An Introduction to Ray Tracing, 1989, chapter 2).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..conventions import gamma
from ..maths.vector import cross, difference, linear, matvec
from ..records import INFINITE_PLANE, PLANE
from .in_camera import Placed

KINDS = (PLANE, INFINITE_PLANE)


@dataclass(frozen=True)
class View:
    """The constants of planes as the eye sees them; the last axis counts the planes."""

    matrix: np.ndarray
    """(3, 3, n): shape_from_camera, its sign such that the eye's ``offset`` is not negative."""
    center: np.ndarray
    """(3, n) camera frame."""
    offset: np.ndarray
    """(n,): N_z for rays from the eye."""
    cross: np.ndarray
    """(2, 3, n): camera direction to the x and y components of N x D, for rays from the eye."""


def view(placed: Placed, at, direction=None) -> View:
    """Return the constants of the planes in these rows; arguments as the sphere's."""
    center, offset = placed.center[at].T, placed.offset[at].T
    matrix = placed.shape_from_camera[at].transpose(1, 2, 0)
    sign = np.where(offset[2] < 0, -1.0, 1.0)  # q and -q are the same plane
    matrix, offset = matrix * sign, offset * sign
    (x, y, z), (to_x, to_y, to_z) = offset, matrix
    return View(matrix, center, z, np.stack((y * to_z - z * to_y, z * to_x - x * to_z)))


def intersect(plane: View, kind: int, origin, direction, start: float | None, scratch):
    """Return t of the crossing with the plane, and where it is one: inside and at or beyond ``start``.

    Arguments as the sphere's. Both sides are seen. A ray in the plane does not hit it. None for t: no ray hits it;
    True for where: all do. Either may have one column that stands for all.
    """
    matrix = plane.matrix
    shape = np.broadcast_shapes(np.shape(plane.offset), *map(np.shape, direction), *map(np.shape, origin or ()))
    d_z, t, across = (scratch(name, shape) for name in ("ahead", "found", "across"))
    linear(matrix[2], direction, d_z, across)
    if origin is None:
        np.divide(plane.offset, d_z, out=t)
    else:
        n = matvec(matrix, difference(plane.center, origin))
        np.divide(n[2], d_z, out=t)
    found = (t >= (0.0 if start is None else start)) & (t < np.inf)
    if kind == PLANE:
        np.abs(d_z, out=d_z)
        for row in range(2):
            if origin is None:
                linear(plane.cross[row], direction, across, scratch("spare", shape))
            else:
                np.copyto(across, cross(n, matvec(matrix, direction))[row])
            found &= np.abs(across, out=across) <= d_z
    return t, found


class Lattice:
    """Planes and the rays of a pinhole: x is a row, y a column, z a number. D_z and N x D are affine in the pixel then:
    where the corners of a window tell that a plane covers it all or misses it all, no other is asked.
    """

    def __init__(self, planes: View, kind: int, direction):
        """Take constants with two axes behind the one that counts the planes."""
        x, y, z = direction
        edges = planes.cross if kind == PLANE else planes.cross[:0]
        terms = np.concatenate((planes.matrix[2:], edges))
        self._row, self._column = terms[:, 0] * x, terms[:, 1] * y + terms[:, 2] * z
        reach = np.array([np.abs(x).max(), np.abs(y).max(), abs(z)])
        most = (np.abs(terms) * reach.reshape(3, 1, 1, 1)).sum(axis=1)
        self._doubt = (gamma(8) * (most[0] + most[1:].max(axis=0, initial=0)))[:, 0, 0]
        self._offset = planes.offset
        self._is_level = terms[0, 0, :, 0, 0] == 0

    def meet(self, at: int, window, scratch):
        """Return t in a window of the rays, and where it is a hit, of one plane, as ``intersect`` does."""
        rows, columns = window
        row, column = self._row[:, at, :, columns], self._column[:, at, rows]
        corners = row[..., [0, -1]] + column[:, [0, -1]]
        slack = np.concatenate((corners[:1], corners[0] - corners[1:], corners[0] + corners[1:]))
        if (slack.max(axis=(1, 2)) < -self._doubt[at]).any():
            return None, None
        shape = column.shape[1], row.shape[2]
        d_z = column[0]
        if not self._is_level[at]:  # else all pixels of a row are alike: a floor's, seen by a camera that is not rolled
            d_z = np.add(row[0], column[0], out=scratch("ahead", shape))
        t = np.divide(self._offset[at], d_z, out=scratch("found", d_z.shape))
        if (slack > self._doubt[at]).all():
            return t, True
        found, d_z = (t >= 0.0) & (t < np.inf), np.abs(d_z)
        for part in zip(row[1:], column[1:], strict=True):
            across = np.add(*part, out=scratch("across", shape))
            found = found & (np.abs(across, out=across) <= d_z)
        return t, found


def uv(q):
    """Return (q + 1) / 2: 0 .. 1 across a finite plane, unbounded on an infinite one."""
    return (q[0] + 1) / 2, (q[1] + 1) / 2
