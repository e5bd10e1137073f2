"""The pairs of rays and bodies that may meet, for rays that begin near each other, as those of a camera or a scanner.

Directions belong to the faces of a cube, where they are points (u, v). From the rays' origins the box of a body is seen
within a rectangle of (u, v). Rays are sorted by rows of v, and within a row by columns of u, so that the rays of a
rectangle are a run in each of its rows. Near boxes come first; pairs whose box is behind the ray's hit are left out.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import ceil, inf, sqrt

import numpy as np

from ..maths.speed import taken
from ..shapes.windows import counted

PAIRS_AT_ONCE = 1 << 16
"""Number of pairs that are compared at once. Not tuned."""

MOST_PAIRS = 24
"""Number of pairs for each ray, on average, from which a tree takes less time: of 150,000 triangles bundles of
5, 7, 16 and 58 pairs take 0.4, 0.5, 0.8 and 1.9 times as long.
"""

FAR_TOO_MANY = 4
"""A bundle with this many times MOST_PAIRS, if rays were everywhere, is not counted: of random rays in a room it would
take a tenth of the time.
"""

COLUMNS = 4
"""Number of columns for each ray of a row. Not tuned."""

MOST_CELLS = 1 << 16, 1 << 12
"""Largest numbers of columns and rows."""

ROUNDED = 2.0**-40
"""Relative rounding of boxes as seen from the rays, and of depths, with a wide margin."""

Limit = Callable[[np.ndarray], np.ndarray]
"""A function that returns the largest t of hits of rays, (m,), by their places."""


@dataclass(frozen=True, eq=False)
class FaceRays:
    """The rays of a face of the cube, (n,) arrays by row and column, and runs of them in boxes, (r,) by depth."""

    rays: np.ndarray
    """Their indices."""
    ahead: np.ndarray
    """The components of their directions towards the face."""
    v: np.ndarray
    body: np.ndarray
    """The body of a run."""
    first: np.ndarray
    """The first ray of a run."""
    count: np.ndarray
    box: np.ndarray
    """(3, r): the least distance of the body's box towards the face, the least and the largest v."""

    def pairs(self, limit: Limit) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Yield places in ``rays`` and bodies, (m,) each."""
        ends, end = np.cumsum(self.count), 0
        while end < len(ends):
            start, before = end, ends[end - 1] if end else 0
            end = max(start + 1, int(np.searchsorted(ends, before + PAIRS_AT_ONCE)))
            run, ray = counted(self.count[start:end], self.first[start:end])
            depth, least, largest = self.box[:, start:end]
            v = taken(self.v, ray)
            crossed = np.flatnonzero((taken(least, run) <= v) & (v <= taken(largest, run)))
            run, ray = taken(run, crossed), taken(ray, crossed)
            met = np.flatnonzero(taken(depth, run) <= (1 + ROUNDED) * limit(ray) * taken(self.ahead, ray))
            yield taken(ray, met), taken(self.body[start:end], taken(run, met))


class Bundle:
    """Rays that begin near each other, in the order of their faces: ``order``, (n,) indices."""

    def __init__(self, faces: list[FaceRays]):
        self._faces = faces
        self.order = np.concatenate([face.rays for face in faces])

    def pairs(self, limit: Limit) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Yield places of rays in ``order`` and the bodies that they may meet, (m,) each."""
        start = 0
        for face in self._faces:
            for ray, body in face.pairs(lambda ray, start=start: limit(ray + start)):  # type: ignore[misc]
                yield ray + start, body
            start += len(face.rays)


def bundle_of(
    origin: np.ndarray, direction: np.ndarray, low: np.ndarray, high: np.ndarray, body: np.ndarray
) -> Bundle | None:
    """Return the bundle of rays (3, n), n > 0, for some bodies, (b,) indices, given the corners of their boxes, (3, b)
    each; None if a tree takes less time.
    """
    low, high = low - origin.max(axis=1)[:, None], high - origin.min(axis=1)[:, None]
    low -= ROUNDED * np.abs(low)
    high += ROUNDED * np.abs(high)
    axes = np.abs(direction).argmax(axis=0)
    is_ahead = np.choose(axes, direction) > 0
    faces, budget = [], MOST_PAIRS * len(axes)
    for axis in range(3):
        for side in (True, False):
            rays = np.flatnonzero((axes == axis) & (is_ahead == side))
            if not rays.size:
                continue
            towards = (low[axis], high[axis]) if side else (-high[axis], -low[axis])
            across = [(axis + 1) % 3, (axis + 2) % 3]
            ahead = np.abs(taken(direction[axis], rays))
            places = taken(direction[across], rays) / ahead
            face = _face(rays, ahead, places, (*towards, low[across], high[across]), body, budget)
            if face is None:
                return None
            faces.append(face)
            budget -= int(face.count.sum())
    return Bundle(faces)


def _face(rays: np.ndarray, ahead, places, boxes: tuple[np.ndarray, ...], body, budget: int) -> FaceRays | None:
    """Return a face, given its rays and their (u, v), (2, n), and the boxes of bodies: the ends towards the face, and
    the low and high ends across it, (2, b); None if there are more than ``budget`` pairs.
    """
    near, far, low, high = boxes
    start, end = places.min(axis=1)[:, None], places.max(axis=1)[:, None]
    length = np.maximum(end - start, 1e-300)  # rays may have one u or v
    rows = int(np.clip(sqrt(len(rays)) * np.sqrt(length[1] / length[0]), 1, min(len(rays), MOST_CELLS[1])).item())
    columns = min(COLUMNS * ceil(len(rays) / rows), MOST_CELLS[0])
    cells = np.array([[columns], [rows]])

    def cell(values: np.ndarray) -> np.ndarray:
        return np.clip((values - start) * (cells / length), 0, cells - 1).astype(np.intp)

    ahead_of = np.flatnonzero((far >= 0) & (low <= far).all(axis=0) & (high >= -far).all(axis=0))
    near, far = near[ahead_of], far[ahead_of]
    least, largest = (_slopes(near, far, taken(ends, ahead_of), sign) for ends, sign in ((low, 1), (high, -1)))
    seen = np.flatnonzero(((least <= end) & (largest >= start)).all(axis=0))
    box = np.array((np.maximum(near, 0), least[1], largest[1]))[:, seen]
    nearest = _rank(box[0])
    seen, box = seen[nearest], box[:, nearest]
    (left, top), (right, bottom) = cell(taken(least, seen)), cell(taken(largest, seen))
    cells_of_box = (right - left + 1.0) * (bottom - top + 1)
    if (bottom - top + 1).sum() > budget or cells_of_box.sum() * len(rays) > FAR_TOO_MANY * rows * columns * budget:
        return None
    run, row = counted(bottom - top + 1, top)
    column, row_of_ray = cell(places)
    order = np.argsort(column.astype(np.uint16), kind="stable")
    order = order[np.argsort(row_of_ray[order].astype(np.uint16), kind="stable")]
    number = np.bincount(row_of_ray * columns + column, minlength=rows * columns)
    before = np.concatenate(([0], np.cumsum(number)))
    first = taken(before, row * columns + taken(left, run))
    count = taken(before, row * columns + taken(right, run) + 1) - first
    if count.sum() > budget:
        return None
    full = np.flatnonzero(count)
    run = run[full]
    return FaceRays(
        rays[order], ahead[order], places[1, order],
        taken(body, taken(ahead_of, taken(seen, run))), first[full], count[full], taken(box, run),
    )  # fmt: skip


def _slopes(near: np.ndarray, far: np.ndarray, ends: np.ndarray, sign: int) -> np.ndarray:
    """Return the least (sign 1) or the largest (-1) slopes at which boxes are seen, given their ends in that direction.
    """
    return np.where(sign * ends > 0, ends / far, np.where(near > 0, ends / near, -sign * inf))


def _rank(depth: np.ndarray) -> np.ndarray:
    """Return about the order of numbers >= 0: of the upper halves of their float32: numpy sorts 16 bits fastest."""
    return np.argsort((depth.astype(np.float32).view(np.uint32) >> 16).astype(np.uint16), kind="stable")
