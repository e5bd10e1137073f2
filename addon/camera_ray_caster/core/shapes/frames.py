"""The frames of shapes as one camera sees them, and rays in these frames with what rounding has done to them.

All lengths of error vectors are Euclidean, in the manner of gamma(n): they hold for every rounding, not on average.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..conventions import gamma
from ..maths.vector import cross, dot, matrix_rows, matvec, norm
from ..records import Pose, Shapes

MARGIN = 1 + 1e-9
"""Widens what holds a shape: rounding moves its edge by 1e-12 of its size at most."""


@dataclass(frozen=True, eq=False)
class InCamera:
    """Shapes as one camera sees them; one row a shape.

    A ray o + t d is q(t) = t D - N in a shape's own frame, with D = shape_from_camera d and N = shape_from_camera
    (center - o). The eye's relative position is taken first, in world coordinates, where float32 input makes the
    difference exact or nearly so; it is scaled afterwards.
    """

    shapes: Shapes
    pose: Pose
    center: np.ndarray
    """(n, 3) camera frame."""
    shape_from_world: np.ndarray
    """(n, 3, 3)."""
    rounding: np.ndarray
    """(n,): by how much of its length each row of ``shape_from_world`` is wrong at most."""
    shape_from_camera: np.ndarray
    """(n, 3, 3)."""
    offset: np.ndarray
    """(n, 3): N of rays from the eye."""
    offset_rest: np.ndarray
    """(n, 3): what to add to ``offset`` for twice the digits, where the kind finds the eye close; NaN elsewhere."""
    radius: np.ndarray
    """(n,): of a sphere about the center that holds the shape, camera frame; inf for infinite shapes."""
    reach: np.ndarray
    """(n,): how far the shape reaches from its center along the camera's Z; inf for infinite shapes."""


@dataclass(frozen=True, eq=False)
class WorldRays:
    """Rays in the world, relative to the eye, as components, and the most that rounding has done to them."""

    origin: Any
    direction: Any
    """Scaled so that t is depth."""
    origin_error: Any
    direction_error: Any

    def only(self, some: np.ndarray) -> WorldRays:
        """Return those that are meant, bool; each component is a number or has this shape."""

        def part(values):
            return values[some] if np.ndim(values) else values

        origin, direction = (tuple(map(part, vector)) for vector in (self.origin, self.direction))
        return WorldRays(origin, direction, part(self.origin_error), part(self.direction_error))


@dataclass(frozen=True, eq=False)
class LocalRays:
    """Rays in the frames of shapes, one shape a pixel: q(t) = t D - N, D scaled by a power of two to about 1.

    Components and their errors; ``row_d`` and ``row_n`` are the errors of each component, ``d_error`` and ``n_error``
    those of the vectors.
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
    size: Any
    """The length of the unscaled matrix's rows, times ``away``."""
    away: Any
    """Length of the vector from the ray's origin to the shape's center, world."""
    from_eye: bool

    @property
    def cross(self):
        """N x D."""
        return cross(self.n, self.d)

    @property
    def inner(self):
        """N . D."""
        return dot(self.n, self.d)

    def product_error(self):
        """Return the error of ``inner``, and of ``cross``: of the vector, and so of each component."""
        n, d = norm(self.n), norm(self.d)
        return n * self.d_error + d * self.n_error + self.n_error * self.d_error + gamma(4) * n * d

    def q(self, tau):
        """Return the points tau D - N."""
        return tuple(tau * d - n for d, n in zip(self.d, self.n, strict=True))


def local_rays(shapes: InCamera, at: np.ndarray, rays: WorldRays, from_eye: bool) -> LocalRays:
    """Return the rays in the frames of the shapes ``at``, indices that broadcast with them."""
    matrix = shapes.shape_from_world[at]
    power = -np.frexp(np.abs(matrix).max(axis=(-2, -1)))[1]
    unscaled = tuple(norm(row) for row in matrix_rows(matrix))
    matrix = np.ldexp(matrix, power[..., None, None])
    scale = np.ldexp(1.0, power)
    rounding = shapes.rounding[at]
    lengths = tuple(norm(row) for row in matrix_rows(matrix))
    d = matvec(matrix_rows(matrix), rays.direction)
    relative = rays.direction_error + (rounding + gamma(4)) * norm(rays.direction)
    row_d = tuple(length * relative for length in lengths)

    center = (shapes.shapes.center - shapes.pose.eye)[at]
    towards = tuple(center[..., i] - rays.origin[i] for i in range(3))
    away, origin = norm(towards), norm(rays.origin)
    if from_eye:
        n = tuple(shapes.offset[at][..., i] for i in range(3))
        move = gamma(2) * away
    else:
        n = tuple(component / scale for component in matvec(matrix_rows(matrix), towards))
        move = gamma(4) * (norm(tuple(center[..., i] for i in range(3))) + origin) + rays.origin_error
    row_n = tuple(length * (move + (rounding + gamma(4)) * away) for length in unscaled)
    size = norm(unscaled) * away
    turn = rounding + gamma(4)
    d_error = _largest(matrix) * rays.direction_error + turn * norm(lengths) * norm(rays.direction)
    n_error = _largest(matrix) / scale * move + turn * norm(unscaled) * away
    return LocalRays(matrix, scale, rounding, d, n, row_d, row_n, d_error, n_error, size, away, from_eye)


def _largest(matrix):
    """Return a bound of the spectral norm: the root of the largest sums of a row and of a column."""
    return np.sqrt(np.abs(matrix).sum(axis=-1).max(axis=-1) * np.abs(matrix).sum(axis=-2).max(axis=-1))


def least(*terms):
    """Return the least of several bounds, those that are NaN left out."""
    return np.fmin.reduce(np.broadcast_arrays(*terms))
