"""Pixels of each shape in a picture: its visible pixels, and the pixels that it would have alone."""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from ..any_rays.choice import uses_tree
from ..camera.camera import Camera
from ..cast import Images, cast
from ..casting.pixels import is_hit
from ..casting.plan import Plan
from ..maths.speed import lending
from ..motion.apart import of_rows, rows_of
from ..motion.evaluations import Motion
from ..records import Shapes

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


def silhouettes(camera: Camera, shapes: Shapes, images: Images | None = None) -> tuple[list[Silhouette], np.ndarray]:
    """Return the silhouettes of all shapes that have pixels in the render window, and the shape index of each pixel,
    (rows, columns) int32.

    Each shape is cast by itself, in its bounds. ``images``: a cast of these, if there is one.
    """
    if images is None or "shape_index" not in images:
        images = cast(camera, shapes, passes=("shape_index",))
    index = images["shape_index"]
    rows, columns = np.nonzero(index >= 0)
    boxes = dict(zip(*_boxes(index[rows, columns], columns, rows), strict=True))
    result = []
    for row, x, y, pixels in _alone(camera, shapes, images.plan):
        (y0, y1), (x0, x1) = (_ends(pixels.any(axis=1 - axis)) for axis in (0, 1))
        inside = pixels[y0:y1, x0:x1]
        whole = x0 + x, x1 + x, y0 + y, y1 + y
        visible, count = boxes.get(row, (None, 0))
        result.append(Silhouette(row, whole, int(np.count_nonzero(inside)), visible, count, inside))
    return result, index


def _alone(camera: Camera, shapes: Shapes, plan: Plan) -> Iterator[tuple[int, int, int, np.ndarray]]:
    """Yield the row of each shape that has pixels of its own, the first column and row of a window, and which pixels of
    the window would show the shape alone, (rows, columns) bool.
    """
    if camera.pixel_time is not None or uses_tree(plan):
        for row in range(len(shapes)):
            pixels = cast(camera, _only(shapes, row), passes=("shape_index",), threads=1)["shape_index"] >= 0
            if pixels.any():
                yield row, 0, 0, pixels
        return
    with lending() as lend:
        scratch = lend()
        for k, (row, bounds) in enumerate(zip(plan.seen.tolist(), plan.bounds.tolist(), strict=True)):
            pixels = is_hit(plan.of_shape(k), scratch)
            if pixels.any():
                yield row, bounds[0], bounds[2], pixels


def _ends(flags: np.ndarray) -> tuple[int, int]:
    """Return the first and the last index of what is set in some flags (n,), the last plus 1."""
    return int(flags.argmax()), len(flags) - int(flags[::-1].argmax())


def _boxes(index: np.ndarray, columns: np.ndarray, rows: np.ndarray) -> tuple[list[int], list[tuple[Box, int]]]:
    """Return the shapes of pixels (m,) by index, and for each shape the box and the number of its pixels."""
    order = np.argsort(index, kind="stable")
    shapes, first, counts = np.unique(index[order], return_index=True, return_counts=True)
    if not shapes.size:
        return [], []
    x, y = columns[order], rows[order]
    ends = (np.minimum.reduceat(x, first), np.maximum.reduceat(x, first) + 1,
            np.minimum.reduceat(y, first), np.maximum.reduceat(y, first) + 1)  # fmt: skip
    boxes = [tuple(box) for box in np.transpose(ends).tolist()]
    return shapes.tolist(), list(zip(boxes, counts.tolist(), strict=True))


def _only(shapes: Shapes, row: int) -> Shapes:
    """Return a single shape, with its motion."""
    motion, only = shapes.motion, np.array([row])
    return replace(rows_of(shapes, only), motion=of_rows(motion, only) if isinstance(motion, Motion) else None)
