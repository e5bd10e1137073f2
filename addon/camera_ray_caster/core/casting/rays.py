"""The rays of a tile."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..camera.camera import Camera
from ..conventions import gamma
from ..errors.ray_errors import world_rays
from ..maths.speed import Scratch
from ..maths.vector import cut, norm
from ..shapes.shape_frames import WorldRays


@dataclass(frozen=True, eq=False)
class TileRays:
    """The rays through a lattice of pixel centers; components broadcast to (rows, columns)."""

    x: np.ndarray
    """(1, columns): x of the pixel centers."""
    y: np.ndarray
    """(rows, 1): y of the pixel centers."""
    corner: tuple[int, int]
    """Column and row of the first pixel, in the pixels of the plan."""
    from_eye: bool
    """Whether all rays leave the eye."""
    origin: Any
    """Components in the camera frame."""
    direction: Any
    """Components in the camera frame, scaled so that t is Blender's depth."""
    scratch: Scratch
    """The working arrays of the thread, which also hold the hits."""
    camera: Camera | None = None
    """The camera whose rays they are; None for rays that are given in the world, whose numbers are exact."""
    light: Any = None
    """The light that the rays of a sample carry: see ``Model.light``. None if all carry the same."""

    @property
    def of_camera(self) -> Camera:
        """The camera, for what only its rays have."""
        assert self.camera is not None
        return self.camera

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return self.y.shape[0], self.x.shape[1]

    def in_world(self) -> WorldRays:
        """Return the rays in the world, with error bounds."""
        if self.camera is not None:
            return world_rays(self.camera, self.x, self.y)
        size, length = norm(self.origin), norm(self.direction)
        return WorldRays(self.origin, self.direction, length, gamma(8) * size, gamma(8) * length)

    def within(self, window: tuple[slice, slice]) -> TileRays:
        """Return the rays in a window, rows and columns."""
        rows, columns = window
        origin, direction = (tuple(cut(c, window) for c in vector) for vector in (self.origin, self.direction))
        corner = self.corner[0] + (columns.start or 0), self.corner[1] + (rows.start or 0)
        return replace(self, x=self.x[:, columns], y=self.y[rows], corner=corner, origin=origin, direction=direction)


def given_rays(origin: np.ndarray, direction: np.ndarray, scratch: Scratch) -> TileRays:
    """Return rays of the world, (3, n) each, as a tile of one row."""
    x, y = np.arange(origin.shape[1])[None] + 0.5, np.array([[0.5]])
    return TileRays(x, y, (0, 0), False, tuple(origin[:, None]), tuple(direction[:, None]), scratch)


def rays_of(
    camera: Camera, x: np.ndarray, y: np.ndarray, corner: tuple[int, int], scratch: Scratch, sample: int | None = None
) -> TileRays:
    """Return the chief rays, through the pixels' centers and the center of the lens or hole, or those of one sample of
    the pixels and the aperture.
    """
    if sample is None:
        (origin, direction), light = camera.camera_rays(x, y), None
    else:
        (origin, direction), light = camera.sample_rays(x, y, sample), camera.sample_light(x, y, sample)
    return TileRays(x, y, corner, camera.from_eye(sample is not None), origin, direction, scratch, camera, light)
