"""The plane, finite (a parallelogram) or infinite: q_z = 0 in the shape's frame, finite where |q_x|, |q_y| <= 1.

With q(t) = t D - N: t = N_z / D_z, and inside is decided without that division: q_x = (N x D)_y / -D_z and
q_y = (N x D)_x / D_z, so |(N x D)_y| <= |D_z| and |(N x D)_x| <= |D_z|. The cross product comes from constants of the
shape for rays from the eye, so that edges are right to EPS (distance / size), however grazing the plane is.
Reference: the ray-plane intersection of every textbook (Glassner, An Introduction to Ray Tracing, 1989, chapter 2).
"""

from __future__ import annotations

import numpy as np

from ..records import INFINITE_PLANE, PLANE
from ..vector import components, cross, difference, matvec, rows
from .placed import Placed

KINDS = (PLANE, INFINITE_PLANE)


def intersect(shape: Placed, kind: int, origin, direction, start: float, end: float):
    """Return t of the crossing where start <= t <= end, inf where there is none; arguments as the sphere's.

    Both sides are seen. A ray in the plane does not hit it.
    """
    normal_row = components(shape.shape_from_camera[..., 2, :])
    d_z = dot_row(normal_row, direction)
    if origin is None:
        n_z = shape.offset[..., 2]
    else:
        n_z = dot_row(normal_row, difference(components(shape.centre), origin))
    t = n_z / d_z
    inside = (t >= start) & (t <= end)
    if kind == PLANE:
        if origin is None:
            cross_x, cross_y, _ = matvec(rows(shape.cross_from_camera), direction)
        else:
            matrix = rows(shape.shape_from_camera)
            n = matvec(matrix, difference(components(shape.centre), origin))
            cross_x, cross_y, _ = cross(n, matvec(matrix, direction))
        reach = np.abs(d_z)
        inside &= (np.abs(cross_x) <= reach) & (np.abs(cross_y) <= reach)
    return np.where(inside, t, np.inf)


def dot_row(row, vector):
    """Return one row of a matrix times a vector."""
    return matvec((row,), vector)[0]


def normal_covector(shape_from_camera, q):
    """Return the normal as a camera-frame covector, not of unit length: the same at every q."""
    return shape_from_camera[2]


def uv(q):
    """Return (q + 1) / 2: 0 .. 1 across a finite plane, unbounded on an infinite one."""
    return (q[0] + 1) / 2, (q[1] + 1) / 2
