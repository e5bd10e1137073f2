"""The frames of shapes as one camera sees them, and rays in these frames with what rounding has done to them.

All lengths of error vectors are Euclidean, in the manner of gamma(n): they hold for every rounding, not on average.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..conventions import gamma
from ..maths.speed import lazy
from ..maths.vector import cross, difference, dot, matvec, norm
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

    @lazy
    def tables(self) -> Tables:
        """What error bounds look up."""
        return Tables(self)

    @lazy
    def is_scalar(self) -> np.ndarray:
        """(n,) bool: whether the axes are one number times the world's."""
        axes = self.shapes.axes
        return (axes == axes[:, :1, :1] * np.eye(3)).all(axis=(1, 2))


@dataclass(frozen=True, eq=False)
class WorldRays:
    """Rays in the world, relative to the eye, as components, and the most that rounding has done to them."""

    origin: Any
    direction: Any
    """Scaled so that t is depth."""
    origin_error: Any
    direction_error: Any

    @lazy
    def length(self) -> Any:
        """Of the direction."""
        return norm(self.direction)

    def only(self, some: np.ndarray) -> WorldRays:
        """Return those that are meant, bool; components broadcast to its shape, and numbers stay numbers."""

        def part(values):
            return np.broadcast_to(values, some.shape)[some] if np.ndim(values) else values

        origin, direction = (tuple(map(part, vector)) for vector in (self.origin, self.direction))
        return WorldRays(origin, direction, part(self.origin_error), part(self.direction_error))


class Tables:
    """What error bounds need to know of shapes, whichever rays hit them; the last axis counts the shapes."""

    def __init__(self, shapes: InCamera):
        matrix = np.ascontiguousarray(shapes.shape_from_world.transpose(1, 2, 0))
        power = -np.frexp(np.abs(matrix).max(axis=(0, 1)))[1]
        self.matrix = np.ldexp(matrix, power)
        """(3, 3, n): shape_from_world, scaled by a power of two to about 1."""
        self.scale = np.ldexp(1.0, power)
        """(n,): that power."""
        self.rounding = shapes.rounding
        """(n,): of each row of the matrix."""
        self.rows = norm(self.matrix.swapaxes(0, 1))
        """(3, n): the lengths of the matrix's rows."""
        self.size = norm(self.rows)
        """(n,): the length of these."""
        sizes = np.abs(self.matrix)
        self.stretch = np.sqrt(sizes.sum(axis=0).max(axis=0) * sizes.sum(axis=1).max(axis=0))
        """(n,): a bound of the matrix's spectral norm, the root of the largest sums of a row and of a column."""
        self.center = np.ascontiguousarray((shapes.shapes.center - shapes.pose.eye).T)
        """(3, n): relative to the eye, world."""
        self.away = norm(self.center)
        """(n,): the length of that."""
        self.offset = np.ascontiguousarray(shapes.offset.T)
        """(3, n): N of rays from the eye."""


@dataclass(frozen=True, eq=False)
class LocalRays:
    """Rays in the frames of shapes, one shape a ray: q(t) = t D - N, D scaled by a power of two to about 1."""

    tables: Tables
    at: np.ndarray
    """Indices of the shapes, which broadcast with the rays."""
    rays: WorldRays
    from_eye: bool

    def of(self, table: np.ndarray) -> np.ndarray:
        """Return what a table of all shapes, (..., n), has for each ray."""
        return table.take(self.at, axis=-1)

    @lazy
    def scale(self) -> np.ndarray:
        """That of D."""
        return self.of(self.tables.scale)

    @lazy
    def rounding(self) -> np.ndarray:
        """Of each row of the matrix."""
        return self.of(self.tables.rounding)

    @lazy
    def matrix(self) -> np.ndarray:
        """(3, 3, ...): shape_from_world, scaled."""
        return self.of(self.tables.matrix)

    @lazy
    def size(self) -> np.ndarray:
        """The length of the matrix's rows."""
        return self.of(self.tables.size)

    @lazy
    def _towards(self) -> Any:
        """From the ray's origin to the shape's center, world."""
        return difference(self.of(self.tables.center), self.rays.origin)

    @lazy
    def away(self) -> Any:
        """The length of that."""
        return self.of(self.tables.away) if self.from_eye else norm(self._towards)

    @lazy
    def d(self) -> Any:
        """D."""
        return matvec(self.matrix, self.rays.direction)

    @lazy
    def n(self) -> Any:
        """N."""
        if self.from_eye:
            return self.of(self.tables.offset)
        return tuple(component / self.scale for component in matvec(self.matrix, self._towards))

    @lazy
    def d_error(self) -> np.ndarray:
        """How wrong D is at most, as a vector."""
        return self.of(self.tables.stretch) * self.rays.direction_error + self.size * self._d_turned

    @lazy
    def n_error(self) -> np.ndarray:
        """How wrong N is at most, as a vector."""
        return (self.of(self.tables.stretch) * self._moved + self.size * self._n_turned) / self.scale

    def component(self, i: int) -> tuple[Any, Any, Any, Any]:
        """Return one component of D and of N, and how wrong they are at most."""
        row, length = self.of(self.tables.matrix[i]), self.of(self.tables.rows[i])
        d_error = length * (self.rays.direction_error + self._d_turned)
        n_error = length / self.scale * (self._moved + self._n_turned)
        n = self.of(self.tables.offset[i]) if self.from_eye else dot(row, self._towards) / self.scale
        return dot(row, self.rays.direction), n, d_error, n_error

    @lazy
    def _moved(self) -> Any:
        """How wrong the vector to the center is at most."""
        if self.from_eye:
            return gamma(2) * self.away
        return gamma(4) * (self.of(self.tables.away) + norm(self.rays.origin)) + self.rays.origin_error

    @lazy
    def _d_turned(self) -> Any:
        """What the rounding of a row, and of its product, does to a component of D, for a row of length 1."""
        return (self.rounding + gamma(4)) * self.rays.length

    @lazy
    def _n_turned(self) -> Any:
        """The same of N."""
        return (self.rounding + gamma(4)) * self.away

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
