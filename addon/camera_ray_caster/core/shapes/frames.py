"""The frames of shapes as one camera sees them, and rays in the world with what rounding has done to them.

All lengths of error vectors are Euclidean, in the manner of gamma(n): they hold for every rounding, not on average.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..conventions import gamma
from ..maths.speed import lazy
from ..maths.vector import dot, norm
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
    def frames(self) -> Frames:
        """What error bounds need to know of the shapes."""
        return Frames(self)

    @lazy
    def eye_offsets(self) -> Offsets:
        """What they need to know of rays from the eye."""
        center = self.frames.center
        return Offsets(self.frames, center, gamma(2) * norm(center), np.ascontiguousarray(self.offset.T))

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
    length: Any
    """Of the direction."""
    origin_error: Any
    direction_error: Any

    def only(self, of: Callable) -> WorldRays:
        """Return those of some pixels: ``of`` gives components there as ``HitPixels.of``. Numbers stay numbers."""

        def part(values):
            return of((values,))[0] if np.ndim(values) else values

        origin, direction = (tuple(map(part, vector)) for vector in (self.origin, self.direction))
        return WorldRays(origin, direction, *map(part, (self.length, self.origin_error, self.direction_error)))


class Frames:
    """The frames of shapes as error bounds need them; the last axis of each array counts the shapes, or rays."""

    def __init__(self, shapes: InCamera):
        matrix = np.ascontiguousarray(shapes.shape_from_world.transpose(1, 2, 0))
        power = -np.frexp(np.abs(matrix).max(axis=(0, 1)))[1]
        self.scale = np.ldexp(1.0, power)
        """(n,): the power of two that brings the matrix to about 1."""
        self.matrix = matrix * self.scale
        """(3, 3, n): shape_from_world, scaled."""
        self.rounding = shapes.rounding
        """(n,): by how much of its length each row is wrong at most."""
        self.rows = norm(self.matrix.swapaxes(0, 1))
        """(3, n): the lengths of the rows."""
        self.size = norm(self.rows)
        """(n,): the length of these."""
        self.row_error = self.rows * (self.rounding + gamma(4))
        """(3, n): how wrong each component of the matrix's product with a unit vector is at most."""
        self.error = self.size * (self.rounding + gamma(4))
        """(n,): the same, as a vector."""
        sizes = np.abs(self.matrix)
        self.stretch = np.sqrt(sizes.sum(axis=0).max(axis=0) * sizes.sum(axis=1).max(axis=0))
        """(n,): a bound of the spectral norm, the root of the largest sums of a row and of a column."""
        self.center = np.ascontiguousarray((shapes.shapes.center - shapes.pose.eye).T)
        """(3, n): relative to the eye, world."""
        self.is_scalar = shapes.is_scalar
        """(n,): see ``InCamera``."""


class Offsets:
    """N in frames: of rays from the eye, one a shape, or of rays with origins of their own, one a ray."""

    def __init__(self, frames: Any, towards: Any, moved: Any, vector: Any = None):
        """Take the frames, the vectors to the centers and how wrong these are, world; and N where it is known."""
        self._frames, self._moved = frames, moved
        self.away = norm(towards)
        """The distance to the center, world."""
        self.vector = dot(frames.matrix.swapaxes(0, 1), towards) / frames.scale if vector is None else vector
        """(3, n): N."""

    @lazy
    def length(self) -> np.ndarray:
        """(n,): that of N."""
        return norm(self.vector)

    @lazy
    def error(self) -> np.ndarray:
        """(n,): how wrong N is at most, as a vector."""
        return (self._frames.stretch * self._moved + self._frames.error * self.away) / self._frames.scale

    @lazy
    def row_error(self) -> np.ndarray:
        """(3, n): how wrong each component is at most."""
        return (self._frames.rows * self._moved + self._frames.row_error * self.away) / self._frames.scale

    @lazy
    def parts(self) -> np.ndarray:
        """(3, n): no less than what each component is the sum of: the lengths of the matrix's rows times ``away``."""
        return self._frames.rows / self._frames.scale * self.away

    def row(self, name: str, i: int) -> np.ndarray:
        """Return one row of what has this name, (n,)."""
        return getattr(self, name)[i]
