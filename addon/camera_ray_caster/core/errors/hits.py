"""Forward error bounds of hits: how far, at most, t, the position and the normal are from the exact picture's.

Exact means: in real numbers, from the camera's and the shapes' numbers as they are stored. The bounds do not follow
the kernels' steps. They put the t that was found back into the shape's equation: its residual there, plus what rounding
may do to the residual, over the slope of the equation bounds the distance to the exact root, whichever way t was
computed. They hold for a root before and behind, from inside and outside, at a tangent as far as there is a hit at all.
References: pbrt, section 6.8 (bounds beside the values); N. Higham, Accuracy and Stability of Numerical Algorithms, 2nd
ed., chapters 1 and 3; S. Rump, Verification Methods, Acta Numerica 19 (2010), section 2 (a residual bounds a root).
"""

from __future__ import annotations

import numpy as np

from ..conventions import EPS, gamma
from ..maths.speed import lazy
from ..maths.vector import dot, matvec, norm, rows
from ..records import PLANE, SPHERE
from ..shapes.in_camera import GRAZING
from .rays import Local, discriminant, inner_error, least, local_rays, world_rays


class Bounds:
    """The bounds of the pixels of a tile that hit something; (m,) arrays over them.

    pixels: the pixel coordinates of the tile, where they are not neighbors.
    """

    def __init__(self, hits, pixels=None):
        self.where = hits.seen
        self.t = hits.t[self.where]
        self.at = hits.index[self.where]
        self.plan = hits.plan
        x, y = (np.broadcast_to(c, hits.t.shape)[self.where] for c in pixels or hits.pixels)
        with np.errstate(all="ignore"):
            self.rays = world_rays(self.plan.camera, x, y)
            self.local = local_rays(self.plan, self.at, self.rays, hits.from_eye)

    @lazy
    def is_sphere(self) -> np.ndarray:
        """Which of the pixels hit a sphere."""
        return self.plan.shapes.kind[self.at] == SPHERE

    @lazy
    def t_error(self) -> np.ndarray:
        """Of t, the depth that Blender's pass shows; inf where nothing is known."""
        with np.errstate(all="ignore"):
            tau = self.t / self.local.scale
            error = np.where(self.is_sphere, _sphere(self.local, tau), _plane(self.local, tau))
            return np.where(np.isnan(error), np.inf, error * self.local.scale) + EPS * np.abs(self.t)

    @lazy
    def distance(self) -> np.ndarray:
        """Of the distance along the ray; bounds depth, too, since directions are not shorter than 1."""
        length = norm(self.rays.direction)
        return self.t_error * length + np.abs(self.t) * (self.rays.direction_error + gamma(4) * length)

    @lazy
    def point(self) -> np.ndarray:
        """Of the hit point relative to the eye, as a vector's length."""
        rays = self.rays
        along = self.t_error * norm(rays.direction)
        aside = np.abs(self.t) * (rays.direction_error + gamma(4) * norm(rays.direction))
        return along + aside + rays.origin_error + gamma(4) * norm(rays.origin)

    @lazy
    def position(self) -> np.ndarray:
        """Of the hit point in the world, as a vector's length."""
        eye = self.plan.camera.pose.eye
        place = tuple(o + self.t * d + e for o, d, e in zip(self.rays.origin, self.rays.direction, eye, strict=True))
        return self.point + EPS * norm(place)

    @lazy
    def normal(self) -> np.ndarray:
        """Of the unit normal, as a vector's length; 2 where nothing is known."""
        local = self.local
        with np.errstate(all="ignore"):
            q = tuple(self.t / local.scale * d - n for d, n in zip(local.d, local.n, strict=True))
            gradient = matvec(rows(np.swapaxes(local.matrix, -1, -2)), q)
            length = norm(gradient)
            span = self.t * norm(self.rays.direction) + local.away
            reach = self.point + (local.rounding + gamma(8)) * (self.point + span)
            aside, along = 0.0, 0.0
            for i, row in enumerate(rows(local.matrix)):
                row = tuple(row)
                size, share = norm(row), dot(row, gradient) / length
                tilt = norm(tuple(r - share * g / length for r, g in zip(row, gradient, strict=True))) + gamma(8) * size
                q_error = size / local.scale * reach
                aside = aside + tilt * q_error + size * (local.rounding + gamma(8)) * (np.abs(q[i]) + q_error)
                along = along + size * q_error
            curved = np.where(along < length / 2, aside / (length - along), 2.0)
            if self.plan.normals.unit:
                is_round = self.plan.normals.constants[0, self.at] > 0  # whose normals are stored as long as they come
                curved = curved + np.where(is_round, along / length, 0.0)
            error = np.where(self.is_sphere, curved, local.rounding) + gamma(8)
            return np.where(error < 2, error, 2.0)


def _sphere(local: Local, tau):
    """Return how far tau may be from a root of |tau D - N|^2 = 1."""
    d, a = norm(local.d), dot(local.d, local.d)
    a_error = 2 * d * local.d_error + local.d_error**2 + gamma(4) * a
    q = tuple(tau * x - n for x, n in zip(local.d, local.n, strict=True))
    length = norm(q)
    q_error = np.abs(tau) * local.d_error + local.n_error + gamma(2) * (np.abs(tau) * d + norm(local.n))
    far = np.abs((length - 1) * (length + 1)) + 2 * length * q_error + q_error**2 + gamma(6) * (length * length + 1)
    b, b_error, c = dot(local.n, local.d), inner_error(local), local.outside
    terms = a * tau * tau + 2 * np.abs(b * tau) + np.abs(c)
    near = np.abs((a * tau - 2 * b) * tau + c) + gamma(8) * terms + local.outside_error
    near = near + tau * tau * a_error + 2 * np.abs(tau) * b_error
    residual = least(far, near)
    slope = np.abs(dot(q, local.d))
    slope_error = length * local.d_error + d * q_error + gamma(4) * length * d
    low, high = slope - slope_error, slope + slope_error
    room = low * low - (a + a_error) * residual
    apart = np.sqrt(high * high + (a + a_error) * residual)
    return np.where((low > 0) & (room > 0), residual / (low + np.sqrt(room)), (high + apart) / (a - a_error))


def _plane(local: Local, tau):
    """Return how far tau may be from the root of tau D_z = N_z."""
    d, n, d_error = local.d[2], local.n[2], local.row_d[2]
    parts = norm(tuple(local.matrix[..., 2, i] for i in range(3))) / local.scale * local.away
    exact = (np.abs(n) < GRAZING / 4 * parts) & local.from_eye
    n_error = np.where(exact, gamma(4) * np.abs(n) + 64 * EPS * EPS * parts, local.row_n[2])
    residual = np.abs(tau * d - n) + np.abs(tau) * d_error + n_error + gamma(2) * (np.abs(tau * d) + np.abs(n))
    steep = np.abs(d) - d_error
    return np.where(steep > 0, residual / steep, np.inf)


def decision(plan, at: int, x, y):
    """Return what decides whether rays at pixel coordinates x, y hit one shape, and the bound below which it is open.

    Positive on a hit, negative on a miss where the value is beyond the bound. For a sphere the discriminant, for a
    plane by how much the crossing is inside of its edges, for an infinite one how steep the ray is.
    """
    with np.errstate(all="ignore"):
        rays = world_rays(plan.camera, x, y)
        shape = np.broadcast_shapes(np.shape(x), np.shape(y))
        local = local_rays(plan, np.full(shape, at), rays, plan.camera.model.central)
        kind = plan.shapes.kind[at]
        if kind == SPHERE:
            return discriminant(local)
        steep = np.abs(local.d[2])
        if kind != PLANE:
            return steep, local.row_d[2]
        across = local.cross
        inside = np.minimum(steep - np.abs(across[0]), steep - np.abs(across[1]))
        return inside, local.row_d[2] + local.cross_error()
