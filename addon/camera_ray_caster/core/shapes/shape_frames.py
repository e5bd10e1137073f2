"""The frames of shapes as one camera sees them, and rays in the world with their rounding errors.

All error bounds of vectors are Euclidean lengths. Like gamma(n), they are worst-case bounds, not averages.
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

BOUNDS_FACTOR = 1 + 1e-9
"""Factor by which bounding volumes are enlarged: rounding moves the edge of a shape by at most 1e-12 of its size."""


@dataclass(frozen=True, eq=False)
class InCamera:
    """Shapes as one camera sees them; one row per shape.

    A ray o + t d is q(t) = t D - N in a shape's own frame, with D = shape_from_camera d and N = shape_from_camera
    (center - o). The difference center - eye is computed first, in world coordinates, where float32 input makes it
    exact or nearly so; it is scaled afterwards.
    """

    shapes: Shapes
    pose: Pose
    center: np.ndarray
    """(n, 3) camera frame."""
    shape_from_world: np.ndarray
    """(n, 3, 3)."""
    rounding: np.ndarray
    """(n,): upper bound of the error of each row of ``shape_from_world``, over the length of the row."""
    shape_from_camera: np.ndarray
    """(n, 3, 3)."""
    offset: np.ndarray
    """(n, 3): N of rays from the eye."""
    offset_rest: np.ndarray
    """(n, 3): low part to add to ``offset`` for twice the digits, for shapes that their kind finds close; else NaN."""
    radius: np.ndarray
    """(n,): radius of a sphere about the center that holds the shape, camera frame; inf for infinite shapes."""
    reach: np.ndarray
    """(n,): how far the shape reaches from its center along the camera's Z; inf for infinite shapes."""

    @lazy
    def frames(self) -> Frames:
        """The frames of the shapes, for error bounds."""
        return Frames(self)

    @lazy
    def eye_offsets(self) -> Offsets:
        """N of rays from the eye, for error bounds."""
        center = self.frames.center
        return Offsets(self.frames, center, gamma(2) * norm(center), np.ascontiguousarray(self.offset.T))

    @lazy
    def surfaces(self) -> np.ndarray:
        """(n + s + 1,) int32: indices into ``Shapes.surfaces`` of shapes, of ``Slots`` and of no shape, -1 for plain
        materials.
        """
        of_shapes, slots = self.shapes.surface, self.shapes.slots
        of_slots = np.zeros(0) if slots is None else slots.surface
        count = 0 if slots is None else len(slots.color)
        parts = [numbers if len(numbers) == size else np.full(size, -1)
                 for numbers, size in ((of_shapes, len(self.shapes)), (of_slots, count))]  # fmt: skip
        return np.concatenate((*parts, [-1])).astype(np.int32)

    @lazy
    def is_scalar(self) -> np.ndarray:
        """(n,) bool: whether the axes are a scalar times the identity matrix."""
        axes = self.shapes.axes
        return (axes == axes[:, :1, :1] * np.eye(3)).all(axis=(1, 2))


@dataclass(frozen=True, eq=False)
class WorldRays:
    """Rays in the world, relative to the eye, as components, and bounds of their rounding errors."""

    origin: Any
    direction: Any
    """Scaled so that t is depth."""
    length: Any
    """Length of the direction."""
    origin_error: Any
    direction_error: Any

    def only(self, of: Callable) -> WorldRays:
        """Return the rays of some pixels; ``of`` takes components as ``HitPixels.of`` does. Numbers stay numbers."""

        def chosen(values):
            return of((values,))[0] if np.ndim(values) else values

        origin, direction = (tuple(map(chosen, vector)) for vector in (self.origin, self.direction))
        return WorldRays(origin, direction, *map(chosen, (self.length, self.origin_error, self.direction_error)))


class Frames:
    """The frames of shapes, for error bounds; the last axis of each array counts the shapes, or the rays."""

    def __init__(self, shapes: InCamera):
        matrix = np.ascontiguousarray(shapes.shape_from_world.transpose(1, 2, 0))
        power = -np.frexp(np.abs(matrix).max(axis=(0, 1)))[1]
        self.scale = np.ldexp(1.0, power)
        """(n,): the power of two that scales the matrix to about 1."""
        self.matrix = matrix * self.scale
        """(3, 3, n): shape_from_world, scaled."""
        self.rounding = shapes.rounding
        """(n,): see ``InCamera``."""
        self.rows = norm(self.matrix.swapaxes(0, 1))
        """(3, n): the lengths of the rows."""
        self.size = norm(self.rows)
        """(n,): the Frobenius norm of ``matrix``."""
        self.row_error = self.rows * (self.rounding + gamma(4))
        """(3, n): upper bound of the error of each component of the matrix's product with a unit vector."""
        self.error = self.size * (self.rounding + gamma(4))
        """(n,): upper bound of the error of that product, as a vector's length."""
        sizes = np.abs(self.matrix)
        self.stretch = np.sqrt(sizes.sum(axis=0).max(axis=0) * sizes.sum(axis=1).max(axis=0))
        """(n,): a bound of the spectral norm: the root of the product of the largest absolute row and column sums."""
        self.center = np.ascontiguousarray((shapes.shapes.center - shapes.pose.eye).T)
        """(3, n): the centers relative to the eye, world."""
        self.is_scalar = shapes.is_scalar
        """(n,): see ``InCamera``."""


class Offsets:
    """N in frames: one per shape for rays from the eye, or one per ray for rays with origins of their own."""

    def __init__(self, frames: Any, towards: Any, moved: Any, vector: Any = None):
        """Take the frames, the vectors to the centers and their error bounds, world; and N if it is known already."""
        self._frames, self._moved = frames, moved
        self.away = norm(towards)
        """The distance to the center, world."""
        self.vector = dot(frames.matrix.swapaxes(0, 1), towards) / frames.scale if vector is None else vector
        """(3, n): N."""

    @lazy
    def length(self) -> np.ndarray:
        """(n,): the length of N."""
        return norm(self.vector)

    @lazy
    def error(self) -> np.ndarray:
        """(n,): upper bound of the error of N, as a vector's length."""
        return (self._frames.stretch * self._moved + self._frames.error * self.away) / self._frames.scale

    @lazy
    def row_error(self) -> np.ndarray:
        """(3, n): upper bound of the error of each component of N."""
        return (self._frames.rows * self._moved + self._frames.row_error * self.away) / self._frames.scale

    @lazy
    def parts(self) -> np.ndarray:
        """(3, n): bound of the sum of each component's terms' magnitudes: the row's length times ``away``."""
        return self._frames.rows / self._frames.scale * self.away

    def row(self, name: str, i: int) -> np.ndarray:
        """Return row i of the attribute with this name, (n,)."""
        return getattr(self, name)[i]
