"""Bounds of the pixels, in the render window or in some columns and rows, that may see something, and of its t."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from ..camera.camera import Camera
from ..conventions import EPS
from ..maths.speed import taken
from ..shapes.shape_frames import InCamera

SAMPLE_MARGIN = 0.5
"""Margin of bounds, in pixels, when samples are spread over the pixels."""

POINT_MARGIN = 2.0**-20
"""Margin of the bounds of points, in pixels: within FARTHEST rounding moves an image by at most 1e-9 pixels."""

FARTHEST = 1e6
"""Largest coordinate, in pixels, at which the image of a point counts; a triangle with a corner beyond is bounded as a
ball.
"""


@dataclass(frozen=True, eq=False)
class CameraPixelBounds:
    """See ``shapes.kind.PixelBounds``. Bounds are (n, 4) int: x0, x1, y0, y1 in the pixels of the plan."""

    camera: Camera
    sampled: bool
    """Whether rays are spread over the pixels and the aperture."""
    cull: bool = True
    """Whether bounds are computed; else everything may be seen everywhere."""
    columns: np.ndarray | None = None
    """(2, k), both ascending: the first and the last column of the window that each column of the plan stands for, and
    in ``rows`` the same for its rows; None for all.
    """
    rows: np.ndarray | None = None

    @property
    def whole(self) -> np.ndarray:
        """(4,) int: all pixels of the plan."""
        height, width = self.camera.raster.shape
        wide = width if self.columns is None else self.columns.shape[1]
        high = height if self.rows is None else self.rows.shape[1]
        return np.array([0, wide, 0, high])

    def at(self, columns: np.ndarray, rows: np.ndarray) -> CameraPixelBounds:
        """Return the bounds for some columns and rows of the render window: see ``Plan.at_pixels``."""
        columns, rows = (np.broadcast_to(places, (2, places.shape[-1])) for places in (columns, rows))
        return replace(self, columns=columns, rows=rows)

    def of_balls(self, centers: np.ndarray, radii: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        bounds = np.tile(self.whole, (len(radii), 1))
        if not self.cull:
            return bounds, np.ones(len(radii), bool)
        endless = np.isinf(radii)
        with np.errstate(all="ignore"):
            radii = np.where(endless, 0.0, radii)
            if self.sampled and self.camera.aperture is not None:
                radii = radii + self.camera.aperture.blur(centers, radii, self.camera.model.planar)
            frame = self.camera.model.bounds(centers, radii)
        frame[endless] = (-np.inf, np.inf, -np.inf, np.inf)
        seen = ~np.isnan(frame).any(axis=1)
        self._in_plan(np.where(seen[:, None], frame, 0.0).T, bounds)
        return bounds, seen & (bounds[:, 0] < bounds[:, 1]) & (bounds[:, 2] < bounds[:, 3])

    def within(self, bounds: np.ndarray) -> np.ndarray:
        if self.columns is None or self.rows is None:
            return bounds
        in_plan = np.empty_like(bounds)
        sides = zip((self.columns, self.rows), self.camera.raster.shape[::-1], strict=True)
        for k, ((first, last), side) in enumerate(sides):
            for column, ends in ((2 * k, last), (2 * k + 1, first)):
                before = np.searchsorted(ends, np.arange(side + 1)).astype(in_plan.dtype)  # a table: bounds are many
                in_plan[:, column] = taken(before, bounds[:, column])
        return in_plan

    def least_t(self, centers: np.ndarray, radii: np.ndarray) -> np.ndarray:
        if self.is_planar:
            return -centers[:, 2] - radii
        if self.camera.from_eye(self.sampled) and not self.camera.is_rigid:  # t has another scale in each direction
            return np.full(len(radii), -np.inf)
        return np.sqrt((centers * centers).sum(axis=1)) - radii

    def t_range(self, shapes: InCamera) -> tuple[np.ndarray, np.ndarray]:
        """Return lower and upper bounds of the t of each shape, (n,) each; -inf and inf where none are known."""
        reach = shapes.radius
        if self.is_planar:
            middle, reach = -shapes.center[:, 2], shapes.reach
        elif self.camera.is_rigid and self.camera.from_eye(self.sampled):
            middle = np.sqrt((shapes.center * shapes.center).sum(axis=1))
        else:
            return np.full(len(reach), -np.inf), np.full(len(reach), np.inf)
        reach = reach * (1 + 16 * EPS)
        return middle - reach, middle + reach

    @property
    def is_planar(self) -> bool:
        return self.camera.model.planar

    @property
    def has_straight_lines(self) -> bool:
        return self.cull and self.camera.model.straight and not (self.sampled and self.camera.aperture)

    def of_points(self, points: np.ndarray, out: np.ndarray) -> np.ndarray:
        with np.errstate(all="ignore"):
            x, y = self.camera.model.project(points).T
            counts = (np.abs(x) <= FARTHEST) & (np.abs(y) <= FARTHEST)
        if not counts.all():
            x, y = np.where(counts, (x, y), 0.0)
        self._in_plan((x, x, y, y), out, POINT_MARGIN)
        return counts

    def _in_plan(self, frame: Iterable[np.ndarray], out: np.ndarray, margin: float = 0.0) -> None:
        """Write bounds x0, x1, y0, y1 in the full frame, (n,) each, as bounds in the pixels of the plan, (n, 4)."""
        raster = self.camera.raster
        away = margin + (SAMPLE_MARGIN if self.sampled else 0.0) + 0.5  # pixel centers, not pixels
        sides = (raster.x0, raster.shape[1]), (raster.y0, raster.shape[0])
        for k, bound in enumerate(frame):
            corner, size = sides[k // 2]
            edge = np.floor(bound + away) if k % 2 else np.ceil(bound - away)
            edge -= corner
            out[:, k] = np.clip(edge, 0, size, out=edge)
        out[...] = self.within(out)
