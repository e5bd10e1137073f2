"""The rays of a tile."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..camera.camera import Camera
from ..maths.speed import Scratch
from ..maths.vector import cut


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

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return self.y.shape[0], self.x.shape[1]

    def within(self, window: tuple[slice, slice]) -> TileRays:
        """Return the rays in a window, rows and columns."""
        rows, columns = window
        origin, direction = (tuple(cut(part, window) for part in vector) for vector in (self.origin, self.direction))
        corner = self.corner[0] + (columns.start or 0), self.corner[1] + (rows.start or 0)
        return replace(self, x=self.x[:, columns], y=self.y[rows], corner=corner, origin=origin, direction=direction)


def chief_rays(camera: Camera, x: np.ndarray, y: np.ndarray, corner: tuple[int, int], scratch: Scratch) -> TileRays:
    """Return the rays through the pixels' centers and the center of the lens or hole."""
    origin, direction = camera.camera_rays(x, y)
    return TileRays(x, y, corner, camera.from_eye(sampled=False), origin, direction, scratch)


def sampled_rays(
    camera: Camera, x: np.ndarray, y: np.ndarray, sample: int, corner: tuple[int, int], scratch: Scratch
) -> TileRays:
    """Return the rays of one sample of the pixels and the aperture."""
    origin, direction = camera.sample_rays(x, y, sample)
    return TileRays(x, y, corner, camera.from_eye(sampled=True), origin, direction, scratch)
