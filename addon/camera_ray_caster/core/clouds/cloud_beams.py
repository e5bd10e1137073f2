"""The beams of a point cloud: the rays of a camera's picture, or rays that are given as arrays, with what they hit."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .. import arguments
from ..any_rays.door import RayPattern, cast_rays
from ..camera.camera import Camera
from ..cameras.parts.pose import pose_matrix
from ..cameras.scanner import Scanner
from ..cast import cast
from ..maths.rotations import transform
from ..maths.vector import stacked
from ..records import InputError, Shapes
from ..units import UNIT_SCALE

PASSES = ("distance", "position", "normal", "albedo", "shape_index", "object_index")
"""What points are made of."""

FROM_CAMERA = np.array(((0.0, 0.0, -1.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0)))
"""From the camera's axes, x right, y up, z back, to the sensor's."""

MOST_RING = np.iinfo(np.uint16).max

Places = tuple[np.ndarray, np.ndarray]
"""Rows and columns of some beams, (n,) each."""


@dataclass(frozen=True, eq=False)
class CloudBeams(ABC):
    """Beams in rows and columns, and what they hit."""

    name: str
    pose: np.ndarray
    """(4, 4): from the sensor's axes to the world, at ``frame``."""
    images: Mapping[str, np.ndarray]
    """The passes PASSES, (rows, columns[, channels])."""
    directions: np.ndarray
    """(rows, columns, 3): of unit length, in the world."""
    frame: float
    times: np.ndarray | None
    """(rows, columns): frames; None where all is seen at once."""
    rate: float
    """Frames per second."""
    meters: float
    """See ``PointCloud``."""

    def seconds(self, at: Places) -> np.ndarray:
        """Return the times of beams after the frame of the cloud."""
        return np.zeros(len(at[0])) if self.times is None else (self.times[at] - self.frame) / self.rate

    @abstractmethod
    def places(self, hit: np.ndarray) -> Places:
        """Return the places of those beams for which ``hit``, (rows, columns), is set, in the order of their firing."""

    @abstractmethod
    def rays(self, at: Places) -> tuple[np.ndarray, np.ndarray]:
        """Return origins and unit directions of beams in the sensor's axes as these fire, (n, 3) each."""

    @abstractmethod
    def turned(self, at: Places, vectors: np.ndarray) -> np.ndarray:
        """Return vectors in the world, (n, 3), in the sensor's axes as the beams fire."""

    @abstractmethod
    def rings(self, at: Places) -> np.ndarray:
        """Return the numbers of beams, (n,) uint16, as the device's own files count."""


@dataclass(frozen=True, eq=False)
class CameraBeams(CloudBeams):
    """The chief rays of a camera, fired column by column, from the lowest row up."""

    camera: Camera

    @classmethod
    def of(cls, camera: Camera, shapes: Shapes) -> CameraBeams:
        """Return the beams of a camera."""
        images = cast(camera, shapes, passes=PASSES, dtype=np.float64)
        rays, settings = camera.rays(), camera.record.settings
        pose = transform(camera.pose.basis @ FROM_CAMERA.T, camera.pose.eye)
        rate = settings.get("fps", 24) / settings.get("fps_base", 1.0)
        frame, meters = float(settings.get("frame", 0.0)), settings.get(UNIT_SCALE, 1.0)
        return cls(camera.name, pose, images, rays.directions, frame, rays.time, rate, meters, camera)

    def places(self, hit: np.ndarray) -> Places:
        column, row = np.nonzero(hit.T)
        return row, column

    def rays(self, at: Places) -> tuple[np.ndarray, np.ndarray]:
        (row, column), raster = at, self.camera.raster
        x, y = raster.x0 + column + 0.5, raster.y0 + row + 0.5
        origin, direction = (stacked(vector, x.shape) for vector in self.camera.model.rays(x, y))
        direction = direction / np.linalg.norm(direction, axis=-1, keepdims=True)
        return origin @ FROM_CAMERA.T, direction @ FROM_CAMERA.T

    def turned(self, at: Places, vectors: np.ndarray) -> np.ndarray:
        camera, motion, basis = self.camera, self.camera.motion, self.camera.pose.basis
        bases = np.broadcast_to(basis, (len(vectors), 3, 3))
        if self.times is not None and motion is not None:
            frames, frame_index = np.unique(self.times[at], return_inverse=True)
            poses = motion.poses_at(frames)
            bases = np.array([camera.at(frame).pose.basis for frame in frames.tolist()]) if poses is None else poses[1]
            bases = bases.reshape(-1, 3, 3)[frame_index]
        return np.einsum("nji,nj->ni", bases, vectors) @ FROM_CAMERA.T

    def rings(self, at: Places) -> np.ndarray:
        """See CloudBeams: of cameras that are no scanners, the rows."""
        row = at[0] + self.camera.raster.y0
        if isinstance(self.camera.model, Scanner):
            beams = self.camera.model.beams
            row = beams.ring[(row * len(beams)) // self.camera.raster.height]
        return row.astype(np.uint16)


@dataclass(frozen=True, eq=False)
class RayBeams(CloudBeams):
    """Rays that are given, fired in their order: the last axis of their arrays has the columns."""

    origins: np.ndarray
    """(rows, columns, 3): in the world."""
    numbers: np.ndarray
    """(rows, columns): the rings."""

    @classmethod
    def of(cls, pattern: RayPattern, shapes: Shapes, name: str, pose, rate: float) -> RayBeams:
        """Return the beams of some rays. Without a ``pose``, of a sensor in the world's axes, at the origin of the rays
        if they share one.
        """
        how = {"times": pattern.times, "near": pattern.near, "far": pattern.far}
        images = cast_rays(pattern.origins, pattern.directions, shapes, passes=PASSES, **how)
        shape = images["distance"].shape
        size = (int(np.prod(shape[:-1])), shape[-1]) if shape else (1, 1)
        origins, directions = (
            np.broadcast_to(np.asarray(vectors, np.float64), (*shape, 3)).reshape(*size, 3)
            for vectors in (pattern.origins, pattern.directions)
        )
        with np.errstate(invalid="ignore"):
            directions = directions / np.linalg.norm(directions, axis=-1, keepdims=True)
        times = pattern.times
        times = None if times is None else np.broadcast_to(np.asarray(times, float), shape).reshape(size)
        sensor = np.eye(4)
        if pose is not None:
            sensor = np.array(pose_matrix(pose))
            sensor[:3, :3] = sensor[:3, :3] @ FROM_CAMERA.T
        elif origins.size and (origins == origins[0, 0]).all():
            sensor[:3, 3] = origins[0, 0]
        passes = {key: image.reshape(*size, *image.shape[len(shape) :]) for key, image in images.items()}
        first = 0.0 if times is None or not times.size else float(times.min())
        rings = _rings(pattern.rings, shape).reshape(size)
        return cls(name, sensor, passes, directions, first, times, rate, 1.0, origins, rings)

    def places(self, hit: np.ndarray) -> Places:
        row, column = np.nonzero(hit)
        return row, column

    def rays(self, at: Places) -> tuple[np.ndarray, np.ndarray]:
        return (self.origins[at] - self.pose[:3, 3]) @ self.pose[:3, :3], self.directions[at] @ self.pose[:3, :3]

    def turned(self, at: Places, vectors: np.ndarray) -> np.ndarray:
        return vectors @ self.pose[:3, :3]

    def rings(self, at: Places) -> np.ndarray:
        return self.numbers[at].astype(np.uint16)


def _rings(rings, shape: tuple[int, ...]) -> np.ndarray:
    """Return the ring of each ray; by default the row."""
    if rings is None:
        count = shape[-1] if shape else 1
        return np.minimum(np.arange(int(np.prod(shape))) // max(count, 1), MOST_RING).reshape(shape)
    ring_of = arguments.numbers(rings, "rings")
    if not ((ring_of >= 0) & (ring_of <= MOST_RING) & (ring_of % 1 == 0)).all():
        raise InputError(f"rings must be whole numbers from 0 to {MOST_RING}")
    try:
        return np.broadcast_to(ring_of, shape)
    except ValueError as error:
        raise InputError(f"rings of shape {ring_of.shape} do not broadcast to rays of shape {shape}") from error
