"""A map from directions to the parts of a picture in which they are seen: bounds of balls for any rays from one eye.

The picture is divided into parts, the directions of whose rays lie in boxes. A box, or a ball, covers an interval of
slopes along each axis of the faces of a cube around the eye. Each face has a pyramid of cells, each half as long as
those above it; a part is entered in the up to four cells that hold its slopes, and a ball has the bounds of the up to
four cells that hold its own. What is entered in a cell also holds in all cells above and below it.
Reference: L. Williams, Pyramidal Parametrics, SIGGRAPH 1983.
"""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ...maths.speed import taken
from .silhouette import everywhere, pinhole_interval

LEVELS = 8
CELLS = 1 << (LEVELS - 1)
"""Cells along a side of a face. With 64 and 256, pictures of two scenes of triangles, 574 x 287, through a panorama by
its formula or by a table of 48 x 24 entries take 1.0 times as long, within a tenth.
"""

REACH, SMALL = 1.5, 1 / 8
"""Largest slope on a face, and radius over depth of balls that lie on one face alone: within 45 degrees and asin(1 / 8)
of its axis.
"""

SLOPE_MARGIN = 1e-9
"""Margin of slopes, far more than their rounding."""

FIRST = np.cumsum([0] + [(CELLS >> level) ** 2 for level in range(LEVELS)])
"""The number of the first cell of each level, the finest first, among those of a face."""


class CubeFace(NamedTuple):
    """The cells of a face of the cube."""

    axis: int
    sign: int
    start: np.ndarray
    """(2,): the slopes at the first cell."""
    scale: np.ndarray
    """(2,): cells over slopes."""
    parts: np.ndarray
    """(cells, 4) float32: x0, -x1, y0, -y1 of what is seen in the directions of a cell; inf for nothing."""


class DirectionMap:
    """See the module's docstring."""

    def __init__(self, low: np.ndarray, high: np.ndarray, parts: np.ndarray):
        """Take the boxes of directions of any length, (3, n) each, and the parts of the picture whose rays have them,
        x0, x1, y0, y1 (n, 4), numbers of float32. Boxes with NaN have no rays.
        """
        turned = parts * (1, -1, 1, -1)
        faces = [_face(axis, sign, low, high, turned) for axis in range(3) for sign in (1, -1)]
        self._faces = {(face.axis, face.sign): face for face in faces if face is not None}

    def bounds(self, centers: np.ndarray, radii: np.ndarray) -> np.ndarray:
        """Return x0, x1, y0, y1 (n, 4) of balls, with centers (n, 3) relative to the eye: parts of the picture outside
        of which no ray meets them; NaN where none does, -inf and inf for balls that hold the eye.
        """
        bounds = np.full((len(radii), 4), np.inf)
        size = np.abs(centers)
        axis = size.argmax(axis=1)
        depth = size[np.arange(len(axis)), axis]
        is_small = radii < SMALL * depth
        for (face_axis, sign), face in self._faces.items():
            balls = np.flatnonzero(is_small & (axis == face_axis) & ((centers[:, face_axis] > 0) == (sign > 0)))
            low, high = _slopes(taken(centers.T, balls), taken(radii, balls), face)
            _look_up(face, balls, low, high, bounds)
        large = np.flatnonzero(~is_small)
        for face in self._faces.values() if large.size else ():
            beside, radius = centers[large], radii[large]
            depth = face.sign * beside[:, face.axis]
            first, second = (pinhole_interval(beside[:, axis], depth, radius) for axis in _across(face.axis))
            _look_up(face, large, np.array((first[0], second[0])), np.array((first[1], second[1])), bounds)
        bounds[:, 1::2] *= -1
        bounds[np.isinf(bounds).any(axis=1)] = np.nan
        holds = (centers * centers).sum(axis=1) <= radii * radii * (1 + SLOPE_MARGIN)
        bounds[holds] = everywhere(int(holds.sum()))
        return bounds


def _across(axis: int) -> tuple[int, int]:
    return (axis + 1) % 3, (axis + 2) % 3


def _face(axis: int, sign: int, low: np.ndarray, high: np.ndarray, parts: np.ndarray) -> CubeFace | None:
    """Return the face of the cube with what is seen through it; None if nothing is."""
    ends = (low[axis], high[axis]) if sign > 0 else (-high[axis], -low[axis])
    near, far = (np.maximum(end, 0.0) for end in ends)
    with np.errstate(all="ignore"):
        slopes = np.array([(np.where(a < 0, a / near, a / far), np.where(b > 0, b / near, b / far))
                           for a, b in ((low[k], high[k]) for k in _across(axis))])  # fmt: skip
    slopes = np.where(np.isnan(slopes), np.array((-np.inf, np.inf))[:, None], slopes)
    here = (far > 0) & (slopes[:, 0] <= REACH).all(axis=0) & (slopes[:, 1] >= -REACH).all(axis=0)
    if not here.any():
        return None
    slopes = np.clip(slopes[:, :, here], -REACH, REACH)
    slopes += np.array((-SLOPE_MARGIN, SLOPE_MARGIN))[:, None]
    start = slopes[:, 0].min(axis=1)
    scale = CELLS / np.maximum(slopes[:, 1].max(axis=1) - start, 1e-6)
    face = CubeFace(axis, sign, start, scale, np.full((FIRST[-1], 4), np.inf, np.float32))
    _, cells = _cells(face, slopes[:, 0], slopes[:, 1])
    cell, bounds = np.concatenate(cells), np.tile(parts[here], (len(cells), 1))
    order = np.argsort(cell, kind="stable")
    starts = np.flatnonzero(np.diff(cell[order], prepend=-1))
    face.parts[cell[order][starts]] = np.minimum.reduceat(bounds[order], starts, axis=0)
    levels = [face.parts[first:last].reshape(CELLS >> level, CELLS >> level, 4)
              for level, (first, last) in enumerate(pairwise(FIRST))]  # fmt: skip
    for above, below in pairwise(levels[::-1]):
        np.minimum(below, above.repeat(2, axis=0).repeat(2, axis=1), out=below)
    for below, above in pairwise(levels):
        pairs = np.minimum(below[::2], below[1::2])
        np.minimum(pairs[:, ::2], pairs[:, 1::2], out=above)
    return face


def _cells(face: CubeFace, low: np.ndarray, high: np.ndarray) -> tuple[np.ndarray, list[np.ndarray]]:
    """Return which intervals of slopes, (2, n) ends, meet the face, by index, and up to four cells that hold each."""
    first = np.floor((low - face.start[:, None]) * face.scale[:, None])
    last = np.floor((high - face.start[:, None]) * face.scale[:, None])
    here = np.flatnonzero(((first < CELLS) & (last >= 0)).all(axis=0))
    first, last = (np.clip(end[:, here], 0, CELLS - 1).astype(np.intp) for end in (first, last))
    level = taken(LEVEL_OF, (last - first).max(axis=0))
    first, last = first >> level, last >> level
    base, wide = taken(FIRST, level), CELLS >> level
    rows = [base + row * wide for row in (first[0], last[0])]
    return here, [row + column for row in rows for column in (first[1], last[1])]


def _slopes(centers: np.ndarray, radii: np.ndarray, face: CubeFace) -> tuple[np.ndarray, np.ndarray]:
    """Return the least and largest slopes, (2, n) each, of small balls."""
    depth, others = face.sign * centers[face.axis], centers[list(_across(face.axis))]
    below = depth * depth - radii * radii
    half = radii * np.sqrt(others * others + below) / below
    middle = others * depth / below
    half += SLOPE_MARGIN
    return middle - half, middle + half


def _look_up(face: CubeFace, balls: np.ndarray, low: np.ndarray, high: np.ndarray, bounds: np.ndarray) -> None:
    """Lower the bounds of balls, by index, to those of a face, given the ends of their slopes, (2, n) each."""
    meeting, cells = _cells(face, low, high)
    parts = face.parts.take(cells[0], axis=0)
    for cell in cells[1:]:
        np.minimum(parts, face.parts.take(cell, axis=0), out=parts)
    balls = balls[meeting]
    bounds[balls] = np.minimum(bounds[balls], parts)


LEVEL_OF = np.ceil(np.log2(np.maximum(np.arange(CELLS), 1))).astype(np.intp)
"""The level on which an interval that ends as many cells further lies in at most two cells."""
