"""Where something may be seen: in which pixels of a plan, of its render window or of some columns and rows, and how far
away at least.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..camera.camera import Camera

SAMPLE_MARGIN = 0.5
"""Pixels by which bounds widen when samples lie all over the pixels."""

CORNER_MARGIN = 2.0**-20
"""Pixels by which the bounds of corners widen: rounding moves a corner's image by 1e-9 pixels at most where FARTHEST
holds.
"""

FARTHEST = 1e6
"""Pixels from the picture within which the images of corners count; a corner beyond has its triangle bounded as a ball.
"""


@dataclass(frozen=True, eq=False)
class PixelBounds:
    """See ``shapes.kind.PixelBounds``; bounds are (n, 4) int: x0, x1, y0, y1 in the pixels of the plan."""

    camera: Camera
    sampled: bool
    """Whether rays lie all over the pixels and the aperture."""
    cull: bool = True
    """Whether bounds are worked out at all; else everything may be seen everywhere."""
    columns: np.ndarray | None = None
    """(k,) ascending, of the window, where the plan has only some; None for all."""
    rows: np.ndarray | None = None

    @property
    def whole(self) -> np.ndarray:
        """(4,) int: all pixels of the plan."""
        height, width = self.camera.raster.shape
        wide = width if self.columns is None else len(self.columns)
        high = height if self.rows is None else len(self.rows)
        return np.array([0, wide, 0, high])

    def at(self, columns: np.ndarray, rows: np.ndarray) -> PixelBounds:
        """Return those of some columns and rows, of the render window."""
        return replace(self, columns=columns, rows=rows)

    def of_balls(self, centers: np.ndarray, radii: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """See ``shapes.kind.PixelBounds``."""
        if not self.cull:
            return np.tile(self.whole, (len(radii), 1)), np.ones(len(radii), bool)
        endless = np.isinf(radii)
        with np.errstate(all="ignore"):
            radii = np.where(endless, 0.0, radii)
            if self.sampled and self.camera.aperture is not None:
                away = -centers[:, 2] if self.camera.model.planar else np.sqrt((centers**2).sum(axis=1))
                radii = radii + self.camera.aperture.blur(away, radii)
            frame = self.camera.model.bounds(centers, radii)
        frame[endless] = (-np.inf, np.inf, -np.inf, np.inf)
        return self._in_plan(frame)

    def within(self, bounds: np.ndarray) -> np.ndarray:
        """See ``shapes.kind.PixelBounds``."""
        if self.columns is None or self.rows is None:
            return bounds
        return np.hstack((np.searchsorted(self.columns, bounds[:, :2]), np.searchsorted(self.rows, bounds[:, 2:])))

    def least_t(self, centers: np.ndarray, radii: np.ndarray) -> np.ndarray:
        """See ``shapes.kind.PixelBounds``."""
        if self.camera.model.planar:
            return -centers[:, 2] - radii
        if self.camera.is_rigid and self.camera.from_eye(self.sampled):
            return np.sqrt((centers * centers).sum(axis=1)) - radii
        return np.full(len(radii), -np.inf)

    @property
    def has_straight_lines(self) -> bool:
        """See ``shapes.kind.PixelBounds``."""
        return self.cull and self.camera.model.straight and not (self.sampled and self.camera.aperture)

    def images(self, points: np.ndarray) -> np.ndarray:
        """See ``shapes.kind.PixelBounds``."""
        with np.errstate(all="ignore"):
            found = self.camera.model.project(points)
            found[~(np.abs(found).max(axis=1) <= FARTHEST)] = np.nan
        return found

    def of_corners(self, low: np.ndarray, high: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """See ``shapes.kind.PixelBounds``."""
        frame = np.stack((low[:, 0], high[:, 0], low[:, 1], high[:, 1]), axis=1)
        return self._in_plan(frame + CORNER_MARGIN * np.array([-1, 1, -1, 1]))

    def _in_plan(self, frame: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return what bounds in the full frame are in the pixels of the plan; NaN where nothing is seen."""
        raster = self.camera.raster
        if self.sampled:
            frame = frame + SAMPLE_MARGIN * np.array([-1, 1, -1, 1])
        seen = ~np.isnan(frame).any(axis=1)
        corner, size = np.array([raster.x0, raster.y0]), raster.shape[::-1]
        frame = np.where(seen[:, None], frame, 0.0)
        first = np.clip(np.ceil(frame[:, 0::2] - 0.5) - corner, 0, size)  # pixel centers, not pixels
        last = np.clip(np.floor(frame[:, 1::2] + 0.5) - corner, 0, size)
        bounds = np.stack((first[:, 0], last[:, 0], first[:, 1], last[:, 1]), axis=1).astype(np.int64)
        bounds = self.within(bounds)
        return bounds, seen & (bounds[:, 0] < bounds[:, 1]) & (bounds[:, 2] < bounds[:, 3])
