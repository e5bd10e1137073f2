"""Pixels of each shape in a picture: its visible pixels, and the pixels that it would have alone."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from ..camera.camera import Camera
from ..cast import cast
from ..motion.apart import of_rows, rows_of
from ..motion.evaluations import Motion
from ..records import Shapes
from ..timeline import ONE_TIME, Timeline

Box = tuple[int, int, int, int]
"""x0, x1, y0, y1 in the pixels of the render window, row 0 at the bottom, x1 and y1 not included."""


@dataclass(frozen=True)
class Silhouette:
    """A shape in a picture. A pixel belongs to the shape if the pixel's chief ray hits it."""

    row: int
    """Row in ``Shapes``."""
    whole: Box
    """Box of the pixels that the shape would have alone."""
    whole_pixels: int
    visible: Box | None = None
    """Box of the shape's visible pixels; None if there are none."""
    visible_pixels: int = 0
    alone: np.ndarray = field(default_factory=lambda: np.zeros((0, 0), bool))
    """(rows, columns) bool: the pixels in ``whole`` that the shape would have alone."""


def silhouettes(camera: Camera, shapes: Shapes) -> tuple[list[Silhouette], np.ndarray]:
    """Return the silhouettes of all shapes that have pixels in the render window, and the shape index of each pixel,
    (rows, columns) int32.

    Each shape is cast by itself, in its bounds.
    """
    images = cast(camera, shapes, ("shape_index",))
    index = images["shape_index"]
    rows, columns = np.nonzero(index >= 0)
    found = dict(zip(*_boxes(index[rows, columns], columns, rows), strict=True))
    everywhere = 0, camera.raster.shape[1], 0, camera.raster.shape[0]
    if camera.pixel_time is None:
        bounds = dict(zip(images.plan.seen.tolist(), images.plan.bounds.tolist(), strict=True))
    else:
        bounds = dict.fromkeys(range(len(shapes)), everywhere)
    result = []
    for row, (x0, x1, y0, y1) in bounds.items():
        raster = camera.raster
        window = replace(raster, x0=raster.x0 + x0, x1=raster.x0 + x1, y0=raster.y0 + y0, y1=raster.y0 + y1)
        alone = cast(replace(camera, raster=window), _alone(shapes, row), ("shape_index",), threads=1)["shape_index"]
        own_rows, own_columns = np.nonzero(alone >= 0)
        for whole, count in _boxes(alone[own_rows, own_columns], own_columns + x0, own_rows + y0)[1]:
            own = alone[whole[2] - y0 : whole[3] - y0, whole[0] - x0 : whole[1] - x0] >= 0
            visible, pixels = found.get(row, (None, 0))
            result.append(Silhouette(row, whole, count, visible, pixels, own))
    return result, index


def _boxes(index: np.ndarray, columns: np.ndarray, rows: np.ndarray) -> tuple[list[int], list[tuple[Box, int]]]:
    """Return the shapes of pixels (m,) by index, and for each shape the box and the number of its pixels."""
    order = np.argsort(index, kind="stable")
    which, first, counts = np.unique(index[order], return_index=True, return_counts=True)
    if not which.size:
        return [], []
    x, y = columns[order], rows[order]
    ends = (np.minimum.reduceat(x, first), np.maximum.reduceat(x, first) + 1,
            np.minimum.reduceat(y, first), np.maximum.reduceat(y, first) + 1)  # fmt: skip
    boxes = [tuple(box) for box in np.transpose(ends).tolist()]
    return which.tolist(), list(zip(boxes, counts.tolist(), strict=True))


def _alone(shapes: Shapes, row: int) -> Shapes:
    """Return a single shape, with its motion."""
    motion, only = shapes.timeline.motion, np.array([row])
    timeline = Timeline(of_rows(motion, only)) if isinstance(motion, Motion) else ONE_TIME
    return replace(rows_of(shapes, only), timeline=timeline)
