"""Camera and shapes between a few evaluations: polynomials through them, in which rotations stay rotations."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass, replace
from functools import cached_property
from math import prod

import numpy as np

from ..camera.camera import Camera
from ..maths.rotations import polar, rotation, rotation_vector
from ..records import Pose, Shapes
from .appearance import appearance
from .deformation import alike, deformed
from .means import mean, mixed

PLACE = "center", "axes"
"""Fields of ``Shapes`` that say where a shape is."""

State = tuple[Camera, Shapes]
"""A scene as it was evaluated at one frame."""


@dataclass(frozen=True)
class TimeInterval:
    """The evaluations of one interval, in order, and the polynomial through them."""

    frames: tuple[float, ...]
    states: tuple[State, ...]

    @classmethod
    def of(cls, states: dict[float, State], frames: tuple[float, ...]) -> TimeInterval:
        """Return the interval of the evaluations at some frames."""
        return cls(frames, tuple(states[frame] for frame in frames))

    def camera_at(self, frame: float) -> Camera:
        """Return the camera at a frame."""
        cameras = [camera for camera, _ in self.states]
        if frame in self.frames:
            return cameras[self.frames.index(frame)]
        weights = self._weights(frame)
        lens = [(camera.model, camera.aperture, camera.clip_start, camera.clip_end) for camera in cameras]
        model, aperture, start, end = mixed(lens, weights)
        basis = self._camera_axes.at(weights)[0]
        pose = Pose(mean([camera.pose.eye for camera in cameras], weights), basis / np.linalg.norm(basis, axis=0))
        model = model.settled().posed(pose)
        return replace(cameras[0], pose=pose, model=model, aperture=aperture, clip_start=start, clip_end=end)

    def poses_at(self, frames: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the eyes (n, 3) and the bases (n, 3, 3) of the camera at frames (n,)."""
        weights = [weight[:, None] for weight in self.weights(frames)]
        eyes = mean([camera.pose.eye[None] for camera, _ in self.states], weights)
        bases = self._camera_axes.at(weights)
        return np.broadcast_to(eyes, (len(frames), 3)), bases / np.linalg.norm(bases, axis=1, keepdims=True)

    def centers_at(self, rows: slice, frames: np.ndarray) -> np.ndarray:
        """Return the centers of some shapes at frames (n,), (shapes, n, 3), but for rounding at evaluations."""
        weights = [weight[:, None] for weight in self.weights(frames)]
        centers = mean([shapes.center[rows, None] for _, shapes in self.states], weights)
        return np.broadcast_to(centers, (len(centers), len(frames), 3))

    def place_at(self, row: int, frames: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the centers (n, 3) and the axes (n, 3, 3) of one shape at frames (n,), those of ``shapes_at``."""
        weights = [weight[:, None] for weight in self.weights(frames)]
        centers, axes = ([getattr(shapes, name)[row : row + 1] for _, shapes in self.states] for name in PLACE)
        center, turned = np.empty((len(frames), 3)), np.empty((len(frames), 3, 3))
        center[...], turned[...] = mean(centers, weights), Turning.of(axes).at(weights)
        for frame, *known in zip(self.frames, centers, axes, strict=True):
            center[frames == frame], turned[frames == frame] = known
        return center, turned

    def shapes_at(self, frame: float) -> Shapes:
        """Return the shapes at a frame. What is not interpolated (indices, and all if shapes appear or disappear) is
        that of the last evaluation before it.
        """
        shapes = [shapes for _, shapes in self.states]
        last = shapes[max(bisect_right(self.frames, frame) - 1, 0)]
        if frame in self.frames or self._shape_axes is None:
            return last
        weights = self._weights(frame)
        center = mean([evaluation.center for evaluation in shapes], weights)
        moved = replace(last, center=center, axes=self._shape_axes.at(weights))
        return deformed(appearance(moved, shapes, weights), shapes, weights)

    def at(self, frame: float) -> State:
        """Return camera and shapes at a frame."""
        return self.camera_at(frame), self.shapes_at(frame)

    def weights(self, frames: np.ndarray) -> list[np.ndarray]:
        """Return the weight of each evaluation at frames (n,), (n,) each."""
        return [np.broadcast_to(weight, frames.shape) for weight in self._weights(frames)]

    def _weights(self, frame) -> list:
        """Return the weight of each evaluation in the polynomial at a frame, or at frames (n,) (Lagrange)."""
        return [
            prod((frame - other) / (node - other) for other in self.frames if other != node)
            for node in self.frames
        ]  # fmt: skip

    @cached_property
    def _camera_axes(self) -> Turning:
        return Turning.of([camera.pose.basis[None] for camera, _ in self.states])

    @cached_property
    def _shape_axes(self) -> Turning | None:
        """The axes of the shapes; None if the evaluations do not have the same shapes."""
        shapes = [shapes for _, shapes in self.states]
        if not all(matched(shapes[0], other) for other in shapes[1:]):
            return None
        return Turning.of([evaluation.axes for evaluation in shapes])


@dataclass(frozen=True)
class Turning:
    """Matrices (n, 3, 3) at some times, decomposed so that rotations are interpolated as rotations."""

    first: np.ndarray
    rotations: np.ndarray
    """Rotation matrices (n, 3, 3) at the first time."""
    turns: list[np.ndarray]
    """Rotation vectors (n, 3) from the first time to each time."""
    stretches: tuple[np.ndarray, ...]
    still: np.ndarray
    """(n, 1, 1) bool: matrices that never change, which stay exact."""

    @classmethod
    def of(cls, matrices) -> Turning:
        """Return the decomposition of the matrices of some times."""
        rotations, stretches = zip(*map(polar, matrices), strict=True)
        back = np.swapaxes(rotations[0], 1, 2)
        turns = [rotation_vector(other @ back) for other in rotations]
        still = np.all([matrices[0] == other for other in matrices], axis=(0, 2, 3))
        return cls(matrices[0], rotations[0], turns, stretches, still[:, None, None])

    def at(self, weights) -> np.ndarray:
        """Return the matrices interpolated with the weights of the times: numbers, or for one matrix (m, 1) arrays."""
        each = [weight[..., None] if np.ndim(weight) else weight for weight in weights]
        moved = rotation(mean(self.turns, weights)) @ self.rotations @ mean(self.stretches, each)
        return np.where(self.still, self.first, moved)


def matched(before: Shapes, after: Shapes) -> bool:
    """Whether two evaluations have the same shapes, row by row."""
    return (
        before.names == after.names
        and np.array_equal(before.kind, after.kind)
        and np.array_equal(before.name_index, after.name_index)
        and np.array_equal(before.identity, after.identity)
        and np.array_equal(before.mesh, after.mesh)
        and alike(before.meshes, after.meshes)
    )
