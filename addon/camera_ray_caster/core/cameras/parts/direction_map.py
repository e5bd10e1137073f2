"""A map from directions to the parts of a picture in which they are seen: bounds of balls for any rays from one eye.

The picture is divided into parts, the directions of whose rays lie in boxes. A box, or a ball, covers an interval of
slopes along each axis of the faces of a cube around the eye. Each face has a pyramid of cells, each half as long as
those above it; a part is entered in the up to four cells that hold its slopes, and a ball has the bounds of the up to
four cells that hold its own. What is entered in a cell also holds in all cells above and below it.
Reference: L. Williams, Pyramidal Parametrics, SIGGRAPH 1983.
"""

from itertools import pairwise
from typing import Any, NamedTuple

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
        made = [_face(axis, sign, low, high, turned) for axis in range(3) for sign in (-1, 1)]
        seen = np.flatnonzero([face is not None for face in made])
        faces = [face for face in made if face is not None]
        self._axis, self._sign = seen // 2, 2 * (seen % 2) - 1
        self._number = np.full(6, -1)
        self._number[seen] = np.arange(len(seen))
        self._start = np.array([face.start for face in faces]).reshape(-1, 2).T
        self._scale = np.array([face.scale for face in faces]).reshape(-1, 2).T
        self._parts = np.concatenate([np.zeros((0, 4), np.float32), *(face.parts for face in faces)])

    def bounds(self, centers: np.ndarray, radii: np.ndarray) -> np.ndarray:
        """Return x0, x1, y0, y1 (n, 4) of balls, with centers (n, 3) relative to the eye: parts of the picture outside
        of which no ray meets them; NaN where none does, -inf and inf for balls that hold the eye.
        """
        bounds = np.full((len(radii), 4), np.inf)
        size = np.abs(centers)
        axis = size.argmax(axis=1)
        depth = size[np.arange(len(axis)), axis]
        is_small = radii < SMALL * depth
        face = taken(self._number, 2 * axis + (centers[np.arange(len(axis)), axis] > 0))
        small = np.flatnonzero(is_small & (face >= 0))
        face = taken(face, small)
        bounds[small] = self._look_up(face, *_slopes(*self._beside(small, face, centers), taken(radii, small)))
        large, count = np.flatnonzero(~is_small), len(self._axis)
        if large.size and count:
            balls, face = np.repeat(large, count), np.tile(np.arange(count), len(large))
            depth, others = self._beside(balls, face, centers)
            low, high = pinhole_interval(others, depth, taken(radii, balls))
            bounds[large] = self._look_up(face, low, high).reshape(-1, count, 4).min(axis=1)
        bounds[:, 1::2] *= -1
        bounds[np.isinf(bounds).any(axis=1)] = np.nan
        holds = (centers * centers).sum(axis=1) <= radii * radii * (1 + SLOPE_MARGIN)
        bounds[holds] = everywhere(int(holds.sum()))
        return bounds

    def _beside(self, balls: np.ndarray, face: np.ndarray, centers: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the depths (m,) of balls before faces, and their places across these, (2, m)."""
        axis, first = taken(self._axis, face), 3 * balls
        depth, *others = (taken(centers.reshape(-1), first + side) for side in (axis, *_across(axis)))
        return taken(self._sign, face) * depth, np.array(others)

    def _look_up(self, face: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
        """Return x0, -x1, y0, -y1 (m, 4) of what is seen on faces within slopes, (2, m) ends; inf for nothing."""
        seen = np.full((len(face), 4), np.inf)
        here, cells = _cells(taken(self._start, face), taken(self._scale, face), low, high)
        first = taken(face, here) * FIRST[-1]
        parts = self._parts.take(first + cells[0], axis=0)
        for cell in cells[1:]:
            np.minimum(parts, self._parts.take(first + cell, axis=0), out=parts)
        seen[here] = parts
        return seen


def _across(axis: Any) -> tuple[Any, Any]:
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
    face = CubeFace(start, scale, np.full((FIRST[-1], 4), np.inf, np.float32))
    _, cells = _cells(start[:, None], scale[:, None], slopes[:, 0], slopes[:, 1])
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


def _cells(start: np.ndarray, scale: np.ndarray, low: np.ndarray, high: np.ndarray):
    """Return which intervals of slopes, (2, n) ends, meet their faces, by index, and up to four cells that hold each,
    given the first slopes and the scales of the faces, which broadcast.
    """
    first, last = (np.floor((end - start) * scale) for end in (low, high))
    here = np.flatnonzero(((first < CELLS) & (last >= 0)).all(axis=0))
    first, last = (np.clip(end[:, here], 0, CELLS - 1).astype(np.intp) for end in (first, last))
    level = taken(LEVEL_OF, (last - first).max(axis=0))
    first, last = first >> level, last >> level
    base, wide = taken(FIRST, level), CELLS >> level
    rows = [base + row * wide for row in (first[0], last[0])]
    return here, [row + column for row in rows for column in (first[1], last[1])]


def _slopes(depth: np.ndarray, others: np.ndarray, radii: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the least and largest slopes, (2, n) each, of small balls at depths (n,), at places (2, n) across these.
    """
    below = depth * depth - radii * radii
    half = radii * np.sqrt(others * others + below) / below
    middle = others * depth / below
    half += SLOPE_MARGIN
    return middle - half, middle + half


LEVEL_OF = np.ceil(np.log2(np.maximum(np.arange(CELLS), 1))).astype(np.intp)
"""The level on which an interval that ends as many cells further lies in at most two cells."""
