"""The sphere and, by an affine matrix, the ellipsoid: |q| = 1 in the shape's frame.

With q(t) = t D - N: a t^2 - 2 b t + c = 0, a = |D|^2, b = N . D, c = |N|^2 - 1, and the discriminant
b^2 - a c = |D|^2 - |N x D|^2, the perpendicular form: its error is EPS (distance / radius) where the textbook's
is EPS (distance / radius)^2, so that a sphere is not lost far away. The root nearest to the origin is the stable one:
c / (b + sqrt) for an origin outside, with c = (|N| - 1)(|N| + 1).
References: Haines et al. (see placed); Goldberg, What Every Computer Scientist Should Know About Floating-Point
Arithmetic (1991), section 1.4 for the stable root.
"""

from __future__ import annotations

import numpy as np

from ..records import SPHERE
from ..vector import components, cross, difference, dot, matvec, norm, rows
from .placed import Placed

KINDS = (SPHERE,)


def intersect(shape: Placed, kind: int, origin, direction, start: float, end: float):
    """Return t of the first crossing with start <= t <= end, inf where there is none.

    ``shape`` holds the constants of one shape, or of one a ray (``Placed.take``). origin is None for rays from the
    eye, else a tuple of three broadcastable components in the camera frame, as direction is. From inside, the
    far wall is hit; a crossing before ``start`` is passed over. A ray that is NaN hits nothing.
    """
    d = matvec(rows(shape.shape_from_camera), direction)
    if origin is None:
        n_cross_d = matvec(rows(shape.cross_from_camera), direction)
        b = dot(components(shape.along_from_camera), direction)
        c = shape.outside
    else:
        n = matvec(rows(shape.shape_from_camera), difference(components(shape.centre), origin))
        n_cross_d = cross(n, d)
        b = dot(n, d)
        distance = norm(n)
        c = (distance - 1) * (distance + 1)
    a = dot(d, d)
    root = np.sqrt(a - dot(n_cross_d, n_cross_d))
    stable = b + np.copysign(root, b)
    first, second = c / stable, stable / a
    near, far = np.minimum(first, second), np.maximum(first, second)
    t = np.where(near >= start, near, far)
    return np.where((t >= start) & (t <= end), t, np.inf)


def normal_covector(shape_from_camera, q):
    """Return the outward normal at q as a camera-frame covector, not of unit length: shape_from_camera^T q."""
    return matvec(zip(*shape_from_camera, strict=True), q)


def uv(q):
    """Return u = longitude / 2 pi + 1/2 and v = latitude / pi + 1/2, both 0 .. 1; u is undefined at the poles."""
    x, y, z = q
    return np.arctan2(y, x) / (2 * np.pi) + 0.5, np.arctan2(z, np.hypot(x, y)) / np.pi + 0.5
