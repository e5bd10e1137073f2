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
from ..records import INFINITE_PLANE, PLANE
from ..vector import components, cross, difference, is_lattice, linear, matvec, rows
from .placed import Placed

KINDS = (PLANE, INFINITE_PLANE)


@dataclass(frozen=True)
class View:
    """The constants of planes as the eye sees them, one row a plane."""

    matrix: np.ndarray
    """(n, 3, 3): shape_from_camera, its sign such that the eye's ``offset`` is not negative."""
    centre: np.ndarray
    """(n, 3) camera frame."""
    offset: np.ndarray
    """(n,): N_z for rays from the eye."""
    cross: np.ndarray
    """(n, 2, 3): camera direction to the x and y components of N x D, for rays from the eye."""


def view(placed: Placed, at, direction=None) -> View:
    """Return the constants of the planes in these rows; arguments as the sphere's."""
    centre, matrix, offset = placed.centre[at], placed.shape_from_camera[at], placed.offset[at]
    sign = np.where(offset[..., 2] < 0, -1.0, 1.0)[..., None]  # q and -q are the same plane
    matrix, offset = matrix * sign[..., None], offset * sign
    x, y, z = (component[..., None] for component in components(offset))
    to_x, to_y, to_z = (matrix[..., i, :] for i in range(3))
    return View(matrix, centre, offset[..., 2], np.stack((y * to_z - z * to_y, z * to_x - x * to_z), axis=-2))


def intersect(plane: View, kind: int, origin, direction, start: float | None, scratch):
    """Return t of the crossing with the plane, and where it is one: inside and at or beyond ``start``.

    Arguments as the sphere's. Both sides are seen. A ray in the plane does not hit it. None for t: no ray hits it.
    """
    if origin is None and start is None and np.ndim(plane.offset) == 0 and is_lattice(direction):
        return _near_pinhole(plane, kind, direction, scratch)
    matrix = rows(plane.matrix)
    shape = np.broadcast_shapes(np.shape(plane.offset), *map(np.shape, direction), *map(np.shape, origin or ()))
    d_z, t, across = (scratch(name, shape) for name in ("ahead", "found", "across"))
    linear(matrix[2], direction, d_z, across)
    if origin is None:
        np.divide(plane.offset, d_z, out=t)
    else:
        n = matvec(matrix, difference(components(plane.centre), origin))
        np.divide(n[2], d_z, out=t)
    found = t >= (0.0 if start is None else start)
    if kind == PLANE:
        np.abs(d_z, out=d_z)
        for row in range(2):
            if origin is None:
                linear(rows(plane.cross)[row], direction, across, scratch("spare", shape))
            else:
                np.copyto(across, cross(n, matvec(matrix, direction))[row])
            found &= np.abs(across, out=across) <= d_z
    return t, found


def _near_pinhole(plane: View, kind: int, direction, scratch):
    """Return the same for one plane and the rays of a pinhole: where their corners tell that the plane covers them all
    or misses them all, no other is asked.
    """
    x, y, z = direction
    edges = rows(plane.cross) if kind == PLANE else ()
    parts = [(row[0] * x, row[1] * y + row[2] * z) for row in (rows(plane.matrix)[2], *edges)]
    reach = np.array([np.abs(x).max(), np.abs(y).max(), abs(z)])
    doubt = gamma(8) * (np.abs(plane.matrix[2]) @ reach + (np.abs(plane.cross) @ reach).max())
    corners = [row[:, [0, -1]] + column[[0, -1]] for row, column in parts]
    slack = np.array([corners[0], *(corners[0] - across for edge in corners[1:] for across in (edge, -edge))])
    if (slack.max(axis=(1, 2)) < -doubt).any():
        return None, None  # affine in the pixel: what all corners are beyond, all pixels are
    d_z, t, across = (scratch(name, (len(y), x.shape[1])) for name in ("ahead", "found", "across"))
    np.add(*parts[0], out=d_z)
    np.divide(plane.offset, d_z, out=t)
    if (slack > doubt).all():
        return t, None
    found = t >= 0.0
    np.abs(d_z, out=d_z)
    for part in parts[1:]:
        np.add(*part, out=across)
        found &= np.abs(across, out=across) <= d_z
    return t, found


def uv(q):
    """Return (q + 1) / 2: 0 .. 1 across a finite plane, unbounded on an infinite one."""
    return (q[0] + 1) / 2, (q[1] + 1) / 2
