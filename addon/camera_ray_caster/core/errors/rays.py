"""What rounding does to the rays of a camera and to their images in a shape's frame: the data of the error bounds.

All lengths of error vectors are Euclidean, in the manner of gamma(n): they hold for every rounding, not on average.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..camera.camera import Camera
from ..conventions import EPS, gamma
from ..maths.vector import cross, dot, matvec, norm, rows

STEP = 2.0**-20
"""Pixels by which a ray is moved to see how fast the picture's rays turn: beside singular rims still on the picture."""

@dataclass(frozen=True)
class WorldRays:
    """Rays in the world, relative to the eye, as components, and the most that rounding has done to them."""

    origin: Any
    direction: Any
    """Scaled so that t is depth."""
    origin_error: Any
    direction_error: Any


def world_rays(camera: Camera, x, y) -> WorldRays:
    """Return the rays at pixel coordinates with their errors: a model's rounding is that of a slightly moved pixel.

    How far a moved pixel moves the ray is measured, whatever the model: near a singular place, as the rim of a mirror
    ball, rays turn fast and errors grow.
    """
    here = camera.camera_rays(x, y)
    moves = ((STEP, 0.0), (-STEP, 0.0)), ((0.0, STEP), (0.0, -STEP))
    basis = camera.pose.basis.tolist()
    stretch = np.linalg.norm(camera.pose.basis, 2)
    in_pixels = camera.model.pixel_rounding(x, y)
    parts = []
    for part in range(2):
        error = camera.model.ray_rounding * norm(here[part])
        for axis in range(2):
            turned = [_moved(camera.camera_rays(x + dx, y + dy)[part], here[part]) for dx, dy in moves[axis]]
            error = error + in_pixels[axis] / STEP * np.fmax(*turned)
        parts.append((matvec(basis, here[part]), stretch * error + gamma(8) * norm(here[part])))
    return WorldRays(parts[0][0], parts[1][0], parts[0][1], parts[1][1])


def _moved(there, here):
    return norm(tuple(a - b for a, b in zip(there, here, strict=True)))


@dataclass(frozen=True)
class Local:
    """Rays in the frames of shapes, one shape a pixel: q(t) = t D - N, D scaled by a power of two to about 1.

    Components and their errors; ``row_D`` and ``row_N`` are the errors of each component, D and N those of the vectors.
    """

    matrix: np.ndarray
    """(..., 3, 3) shape_from_world, scaled."""
    scale: np.ndarray
    rounding: np.ndarray
    """Of each row of the matrix."""
    d: Any
    n: Any
    row_d: Any
    row_n: Any
    d_error: np.ndarray
    n_error: np.ndarray
    outside: Any
    """|N|^2 - 1 where it is a constant of the shape, NaN elsewhere; right to gamma(4) and ``outside_error``."""
    outside_error: Any
    away: Any
    """Length of the vector from the ray's origin to the shape's center, world."""
    from_eye: bool

    @property
    def cross(self):
        """N x D."""
        return cross(self.n, self.d)

    def cross_error(self):
        """Return the error of ``cross``: of the vector, and so of each component."""
        n, d = norm(self.n), norm(self.d)
        return n * self.d_error + d * self.n_error + self.n_error * self.d_error + gamma(4) * n * d


def local_rays(plan, at, rays: WorldRays, from_eye: bool) -> Local:
    """Return the rays in the frames of the shapes ``at``, an index that broadcasts with them."""
    placed, shapes = plan.placed, plan.shapes
    matrix = placed.shape_from_world[at]
    power = -np.frexp(np.abs(matrix).max(axis=(-2, -1)))[1]
    unscaled = tuple(norm(row) for row in rows(matrix))
    matrix = np.ldexp(matrix, power[..., None, None])
    scale = np.ldexp(1.0, power)
    rounding = placed.rounding[at]
    lengths = tuple(norm(row) for row in rows(matrix))
    d = matvec(rows(matrix), rays.direction)
    relative = rays.direction_error + (rounding + gamma(4)) * norm(rays.direction)
    row_d = tuple(length * relative for length in lengths)

    center = (shapes.center - plan.camera.pose.eye)[at]
    towards = tuple(center[..., i] - rays.origin[i] for i in range(3))
    away, origin = norm(towards), norm(rays.origin)
    if from_eye:
        n = tuple(placed.offset[at][..., i] for i in range(3))
        move = gamma(2) * away
        outside = np.where(norm(n) < 1.9, placed.outside[at], np.nan)
    else:
        n = tuple(component / scale for component in matvec(rows(matrix), towards))
        move = gamma(4) * (norm(tuple(center[..., i] for i in range(3))) + origin) + rays.origin_error
        outside = np.full(np.shape(away), np.nan)
    row_n = tuple(length * (move + (rounding + gamma(4)) * away) for length in unscaled)
    size = norm(unscaled) * away
    turn = rounding + gamma(4)
    d_error = _largest(matrix) * rays.direction_error + turn * norm(lengths) * norm(rays.direction)
    n_error = _largest(matrix) / scale * move + turn * norm(unscaled) * away
    return Local(
        matrix, scale, rounding, d, n, row_d, row_n, d_error, n_error, outside,
        64 * EPS * EPS * (1 + size * size), away, from_eye,
    )  # fmt: skip


def _largest(matrix):
    """Return a bound of the spectral norm: the root of the largest sums of a row and of a column."""
    return np.sqrt(np.abs(matrix).sum(axis=-1).max(axis=-1) * np.abs(matrix).sum(axis=-2).max(axis=-1))


def least(*terms):
    """Return the least of several bounds, those that are NaN left out."""
    return np.fmin.reduce(np.broadcast_arrays(*terms))


def discriminant(local: Local):
    """Return the sphere's |D|^2 - |N x D|^2, in scaled units, and the bound below which hit or miss is undecided.

    The bound is the lesser of two: of this form, EPS (distance / radius), and of b^2 - |D|^2 c where c is exact, which
    is better near the surface.
    """
    d, across = norm(local.d), norm(local.cross)
    moved = local.cross_error()
    value = (d - across) * (d + across)
    error = 2 * d * local.d_error + 2 * across * moved + local.d_error**2 + moved**2
    error = error + gamma(8) * (d * d + across * across)
    b, b_error = dot(local.n, local.d), inner_error(local)
    c, c_error = local.outside, gamma(4) * np.abs(local.outside) + local.outside_error
    d_squared = 2 * d * local.d_error + local.d_error**2
    near = 2 * np.abs(b) * b_error + b_error**2 + (np.abs(c) + c_error) * d_squared + d * d * c_error
    near = near + gamma(8) * (b * b + d * d * np.abs(c))
    return np.where(near < error, b * b - d * d * c, value), least(error, near)


def inner_error(local: Local):
    """Return the error of N . D."""
    n, d = norm(local.n), norm(local.d)
    return n * local.d_error + d * local.n_error + local.n_error * local.d_error + gamma(4) * n * d
