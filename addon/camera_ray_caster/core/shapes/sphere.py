"""The sphere and, by an affine matrix, the ellipsoid: |q| = 1 in the shape's frame.

The unit sphere may be turned at will, so each one is turned until its centre lies on its own z axis, N = (0, 0, n).
With D the ray's direction there, |t D - N|^2 = 1 has a = |D|^2, b = n D_z, c = n^2 - 1 and the discriminant

    b^2 - a c = |D|^2 - |N x D|^2 = D_z^2 - c (D_x^2 + D_y^2):

the perpendicular form, whose error is EPS (distance / radius) where the textbook's is EPS (distance / radius)^2,
so that a sphere is not lost far away, at the price of three products. The root nearest to an origin outside is
c / (b + sqrt), the stable one; c is a constant of the sphere for rays from the eye, and right however near the surface
is (see placed). D is scaled by a power of two to about 1, which rounds nothing, and t by the same afterwards: no size
or distance from 1e-150 to 1e150 overflows.
References: E. Haines et al., Precision Improvements for Ray/Sphere Intersection, Ray Tracing Gems (2019), chapter 7;
D. Goldberg, What Every Computer Scientist Should Know About Floating-Point Arithmetic (1991), section 1.4.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..records import SPHERE
from ..vector import components, cross, difference, dot, linear, matvec, norm, rows
from .placed import Placed

KINDS = (SPHERE,)


@dataclass(frozen=True)
class View:
    """The constants of spheres as the eye sees them, one row a sphere."""

    matrix: np.ndarray
    """(n, 3, 3): camera direction to D, scaled, turned so that the eye sees the centre along its z axis."""
    scale: np.ndarray
    """(n,): the power of two that D is scaled by."""
    centre: np.ndarray
    """(n, 3) camera frame."""
    distance: np.ndarray
    """(n,): n, from the eye to the centre in radii."""
    outside: np.ndarray
    """(n,): c = n^2 - 1, positive where the eye is outside."""
    near: np.ndarray
    """(n,): scale c."""


def view(placed: Placed, at) -> View:
    """Return the constants of the spheres in these rows."""
    offset, outside, matrix = placed.offset[at], placed.outside[at], placed.shape_from_camera[at]
    distance = np.sqrt((offset * offset).sum(axis=-1))
    power = -np.frexp(np.abs(matrix).max(axis=(1, 2)))[1]
    matrix = _towards(offset, distance) @ np.ldexp(matrix, power[:, None, None])
    scale = np.ldexp(1.0, power)
    return View(matrix, scale, placed.centre[at], distance, outside, scale * outside)


def _towards(vectors, length):
    """Return rotations (n, 3, 3) that turn vectors onto +z: two unit normals and the unit vector, as rows.

    The normals follow Duff et al., Building an Orthonormal Basis, Revisited (2017), which has no singular direction.
    """
    somewhere = (length > 0)[:, None]
    x, y, z = components(np.where(somewhere, vectors, (0.0, 0.0, 1.0)) / np.where(somewhere, length[:, None], 1.0))
    sign = np.copysign(1.0, z)
    a = -1 / (sign + z)
    b = x * y * a
    first = np.stack((1 + sign * x * x * a, sign * b, -sign * x), axis=-1)
    second = np.stack((b, sign + y * y * a, -y), axis=-1)
    return np.stack((first, second, np.stack((x, y, z), axis=-1)), axis=-2)


def intersect(sphere: View, kind: int, origin, direction, start: float | None, scratch):
    """Return t of the first crossing at or beyond ``start``, NaN where there is none, and None (no further mask).

    ``sphere`` holds one row, or rows shaped to broadcast with the rays. origin is None for rays from the eye, else
    three broadcastable components in the camera frame, as direction is. start is None where the eye is outside and
    nothing of the sphere lies before the clip start: then the near root alone decides. From inside, the far wall is
    hit. A ray that is NaN hits nothing. ``scratch(i, shape)`` lends the i-th working array; t may lie in one.
    """
    if origin is None and start is None:
        return _near_from_eye(sphere, direction, scratch), None
    d = matvec(rows(sphere.matrix), direction)
    if origin is None:
        b = sphere.distance * d[2]
        c = sphere.outside
        discriminant = d[2] * d[2] - c * (d[0] * d[0] + d[1] * d[1])
    else:
        n = matvec(rows(sphere.matrix / sphere.scale[..., None, None]), difference(components(sphere.centre), origin))
        n_cross_d = cross(n, d)
        distance = norm(n)
        b = dot(n, d)
        c = (distance - 1) * (distance + 1)
        discriminant = dot(d, d) - dot(n_cross_d, n_cross_d)
    root = np.sqrt(discriminant)
    if start is None:
        return sphere.scale * c / (b + root), None
    stable = b + np.copysign(root, b)
    first, second = sphere.scale * c / stable, sphere.scale * stable / dot(d, d)
    near, far = np.minimum(first, second), np.maximum(first, second)
    t = np.where(near >= start, near, far)
    return np.where(t >= start, t, np.nan), None


def _near_from_eye(sphere: View, direction, scratch):
    """Return near / (b + sqrt(D_z |D_z| - c (D_x^2 + D_y^2))): NaN also where the ray looks away (D_z < 0)."""
    to_x, to_y, to_z = rows(sphere.matrix)
    scale = np.sqrt(sphere.outside)
    shape = np.broadcast_shapes(np.shape(sphere.outside), *map(np.shape, direction))
    z, t, across = (scratch(i, shape) for i in range(3))
    linear(to_z, direction, out=z)
    np.abs(z, out=t)
    np.multiply(t, z, out=t)
    for row in (to_x, to_y):
        linear([scale * entry for entry in row], direction, out=across)
        np.subtract(t, np.square(across, out=across), out=t)
    np.sqrt(t, out=t)
    np.add(t, np.multiply(z, sphere.distance, out=z), out=t)
    return np.divide(sphere.near, t, out=t)


def near_blocks(sphere: View, kind: int, direction, step: int, scratch):
    """Yield (rows, t, None) as ``intersect`` gives them for one sphere, rays from the eye and no start.

    direction is a pinhole's, x a row, y a column, z a number: each D is then a row plus a column, made once, and each
    block has ``step`` rows.
    """
    x, y, z = direction
    scale = float(np.sqrt(sphere.outside))
    to_x, to_y, to_z = sphere.matrix.tolist()
    parts = [
        (row[0] * x, row[1] * y + row[2] * z)
        for row in ([scale * entry for entry in to_x], [scale * entry for entry in to_y], to_z)
    ]
    (x_row, x_column), (y_row, y_column), (z_row, z_column) = parts
    distance, near = float(sphere.distance), float(sphere.near)
    for first in range(0, len(y), step):
        rows_here = slice(first, min(first + step, len(y)))
        shape = rows_here.stop - first, x.shape[1]
        ahead, t, across = (scratch(i, shape) for i in range(3))
        np.add(z_row, z_column[rows_here], out=ahead)
        np.abs(ahead, out=t)
        np.multiply(t, ahead, out=t)
        np.add(x_row, x_column[rows_here], out=across)
        np.subtract(t, np.square(across, out=across), out=t)
        np.add(y_row, y_column[rows_here], out=across)
        np.subtract(t, np.square(across, out=across), out=t)
        np.sqrt(t, out=t)
        np.add(t, np.multiply(ahead, distance, out=ahead), out=t)
        yield rows_here, np.divide(near, t, out=t), None


def uv(q):
    """Return u = longitude / 2 pi + 1/2 and v = latitude / pi + 1/2, both 0 .. 1; u is undefined at the poles."""
    x, y, z = q
    return np.arctan2(y, x) / (2 * np.pi) + 0.5, np.arctan2(z, np.hypot(x, y)) / np.pi + 0.5
