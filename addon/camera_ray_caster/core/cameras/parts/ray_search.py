"""The inverse of a table of rays: the place of the table whose interpolated ray passes through a point.

Newton's method begins at the entry whose ray passes nearest. With m and o the interpolated direction and origin, by u
and v their derivatives, and t the point's place on the ray, r = p - o - t m is what the ray misses the point by, and
(w_v x m) . r / D and (m x w_u) . r / D are the steps in u and v, w = o' + t m', D = m . (w_u x w_v): Cramer's rule,
as in ``core.camera.jacobian``. The table is continued into its holes and beyond its edges, so that a search may pass
there.
"""

import numpy as np

from ...conventions import EPS
from .ray_grid import BORDER_ENTRIES, LINEAR, RayGrid, weights_of

STARTS = 32
"""Entries on each axis among which the search begins."""

REGIONS, TRIES = 4, 6
"""Regions on each axis, and from how many of them a point is sought, from the best entry of each: near the poles of
panoramas and at their seams the nearest entry may lead nowhere.
"""

NEWTON_STEPS, FULL = 24, 8
"""Largest number of steps, and of full ones: a smooth table takes about six. Later ones are halved, which ends cycles
between the cells of a table with kinks.
"""

MEETING_ANGLE = 64
"""A ray meets a point within this many times EPS (1 + s), as an angle: s is the sum of the distances of the point and
of the ray's origin from the eye, over the distance between the two.
"""

HALF_DIAGONAL = 0.7072
"""Half of the diagonal of a square of entries, with a margin: no point between four rays is lost."""

PRODUCTS = 1 << 20
"""Number of points times entries that are held against each other at once."""

AT_ONCE = 2048
"""Number of points sought at once: their working arrays take some megabytes."""

OF_BLOCKS, IN_BLOCK = 24, 4
"""Number of blocks in which a point is sought, those whose rays pass nearest, and of entries on each axis of a block
among which the search begins, at least.
"""

INSIDE = 0.5 - 1e-11
"""Entries beyond its outermost ones that belong to a block; the margin is for the rounding of pixel coordinates."""


def places_of(grid: RayGrid, points: np.ndarray) -> np.ndarray:
    """Return the places u, v (n, 2) in entries whose rays pass through points (n, 3); NaN where none was found. A place
    may be in a hole of the table or beyond it. If several rays pass through a point, it is one of them.
    """
    places, starts = np.full((len(points), 2), np.nan), _Starts(grid)
    finite = np.flatnonzero(np.isfinite(points).all(axis=1))
    at_once = min(AT_ONCE, max(1, PRODUCTS // len(starts.places)))
    for first in range(0, len(finite), at_once):
        chosen = finite[first : first + at_once]
        block = points[chosen]
        near = starts.nearest(block)
        block_places = _search(grid, block, near[0])
        for start in near[1 : TRIES if grid.blocks.many == 1 else OF_BLOCKS]:
            lost = np.flatnonzero(np.isnan(block_places[:, 0]))
            if lost.size:
                lost = lost[~np.isnan(grid.seen_parts.bounds(block[lost], np.zeros(len(lost)))[:, 0])]
            if not lost.size:
                break
            block_places[lost] = _search(grid, block[lost], start[lost])
        places[chosen] = block_places
    return places


def entries_of(grid: RayGrid, points: np.ndarray) -> np.ndarray:
    """Return the places u, v (n, 2) of the entries of a table without interpolation that see points (n, 3): those whose
    rays pass nearest, of several the first; NaN where the point is farther from this ray than this share of the way to
    the nearest entry beside it. Each point is held against each entry.
    """
    row, column = np.nonzero(grid.known)
    ahead = grid.directions[row, column]
    eyes = np.zeros(3) if grid.origins is None else grid.origins[row, column]
    places, step = np.full((len(points), 2), np.nan), max(1, PRODUCTS // len(row))
    for first in range(0, len(points), step):
        block = points[first : first + step]
        away = block[:, None] - eyes
        t = np.einsum("nmk,mk->nm", away, ahead)
        away = away - t[..., None] * ahead
        missed = np.where(t > 0, np.einsum("nmk,nmk->nm", away, away), np.inf)
        best = missed.argmin(axis=1)
        indices = np.arange(len(best))
        reach = HALF_DIAGONAL * _beside(grid, row[best], column[best], t[indices, best])
        rounding = MEETING_ANGLE * EPS * (np.sqrt(_dot(block, block)) + grid.farthest)
        sees = np.flatnonzero(missed[indices, best] <= np.maximum(reach, rounding) ** 2)
        places[first + sees] = np.stack((column[best], row[best]), axis=1)[sees]
    return places


def _beside(grid: RayGrid, row: np.ndarray, column: np.ndarray, t: np.ndarray) -> np.ndarray:
    """Return the distances, (n,), at t of the rays of entries from the nearest other ray of the four entries beside; 0
    if there is none.
    """
    wide = np.pad(grid.values, ((1, 1), (1, 1), (0, 0)), constant_values=np.nan)
    least = np.full(len(row), np.inf)
    for down, right in ((0, 1), (2, 1), (1, 0), (1, 2)):
        change = wide[row + down, column + right] - wide[row + 1, column + 1]
        change[:, :3] *= t[:, None]
        apart = change[:, :3] + (0.0 if grid.origins is None else change[:, 3:])
        distance = np.sqrt(_dot(apart, apart))
        least = np.fmin(least, np.where(distance > 0, distance, np.inf))
    return np.where(least < np.inf, least, 0.0)


def _search(grid: RayGrid, points: np.ndarray, places: np.ndarray) -> np.ndarray:
    active, ends = np.arange(len(points)), np.array(grid.blocks.size[::-1], np.float64)
    column, row = (places // ends).astype(np.intp).T
    block, first, places = row * grid.blocks.per_axis[1] + column, places // ends * ends, places % ends
    for count in range(NEWTON_STEPS):
        beside, step, _ = _missed(grid, points[active], places[active], block[active])
        size = np.abs(step).max(axis=1)
        step *= np.minimum(1.0, np.maximum(ends.max() / STARTS, 1.0) / size)[:, None]
        step = np.where(np.isfinite(step), step, 0.0)
        moved = np.clip(places[active] + (step if count < FULL else step / 2), -1.0, ends)
        still = np.abs(moved - places[active]).max(axis=1) <= 2 * EPS * ends.max()
        places[active] = moved
        active = active[~still]
        if not len(active):
            break
    beside, _, missed = _missed(grid, points, places, block)
    reach = np.sqrt((points * points).sum(axis=1)) + grid.farthest
    distance = np.sqrt((beside * beside).sum(axis=1))
    meets = missed <= MEETING_ANGLE * EPS * (distance + reach)
    if grid.blocks.many > 1:
        inside = np.clip(places, -INSIDE, ends - 1 + INSIDE)
        column, row = np.floor(first + inside + 0.5).astype(np.intp).T
        meets &= (abs(inside - places).max(axis=1) <= 2 * (0.5 - INSIDE)) & grid.known[row, column]
        places = first + inside
    return np.where(meets[:, None], places, np.nan)


def _missed(
    grid: RayGrid, points: np.ndarray, places: np.ndarray, block: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the way (n, 3) from the rays' origins to points, Newton's steps (n, 2), and the distance (n,) by which the
    rays miss the points; infinity for points behind the origins.
    """
    value, by_u, by_v = _derivatives(grid, places, block)
    m, m_u, m_v = (values[:, :3] for values in (value, by_u, by_v))
    beside = points if grid.origins is None else points - value[:, 3:]
    t = (_dot(beside, m) / _dot(m, m))[:, None]
    r = beside - t * m
    w_u, w_v = t * m_u, t * m_v
    if grid.origins is not None:
        w_u, w_v = w_u + by_u[:, 3:], w_v + by_v[:, 3:]
    to_u, to_v = np.cross(w_v, m), np.cross(m, w_u)
    step = np.stack((_dot(to_u, r), _dot(to_v, r)), axis=1) / _dot(w_u, to_u)[:, None]
    return beside, step, np.where(t[:, 0] > 0, np.sqrt(_dot(r, r)), np.inf)


def _derivatives(grid: RayGrid, places: np.ndarray, block: np.ndarray) -> list[np.ndarray]:
    """Return the interpolated vectors at places (n, 2) of blocks (n,), and their derivatives by u and by v, each (n, 3
    or 6).
    """
    cell = np.clip(np.floor(places), -1, np.array(grid.blocks.size[::-1]) - 1)
    (across, across_by), (up, up_by) = (_weights(places[:, k] - cell[:, k], grid.kind) for k in (0, 1))
    first, taps = cell.astype(np.intp) + BORDER_ENTRIES - (grid.kind != LINEAR), np.arange(across.shape[1])
    read = grid.nodes[first[:, 1, None, None] + taps[:, None], first[:, 0, None, None] + taps, block[:, None, None]]
    rows, rows_by = ((read * weights[:, :, None, None]).sum(axis=1) for weights in (up, up_by))
    pairs = (rows, across), (rows, across_by), (rows_by, across)
    return [(lines * weights[:, :, None]).sum(axis=1) for lines, weights in pairs]


def _weights(t: np.ndarray, kind: str) -> tuple[np.ndarray, np.ndarray]:
    """Return the weights of ``weights_of`` at t (n,) and their derivatives, each (n, 4), or (n, 2) for LINEAR."""
    s = 1 - t
    by = [-s * s / 2, t * (3 * t - 4) / 2, s * (4 - 3 * s) / 2, t * t / 2]
    if kind == LINEAR:
        by = [np.full(t.shape, -1.0), np.ones(t.shape)]
    return np.stack(weights_of(t, kind), axis=1), np.stack(by, axis=1)


class _Starts:
    """Entries of a table, some on each axis, in REGIONS x REGIONS regions, or one for each block if these are more."""

    def __init__(self, grid: RayGrid):
        sides, axes = [max(1, REGIONS // count) * count for count in grid.blocks.per_axis], []
        for axis, (side, count) in enumerate(zip(*grid.blocks, strict=True)):
            in_block = np.unique(np.linspace(0, side - 1, max(IN_BLOCK, STARTS // count)).round().astype(int))
            axes.append((grid.blocks.starts(axis)[:, None] + in_block).ravel())
        entries = np.ix_(*axes)
        if not grid.known[entries].any():
            entries = np.ix_(*map(np.arange, grid.shape))
        known = grid.known[entries]
        row, column = (np.broadcast_to(axis, known.shape)[known] for axis in entries)
        regions = row * sides[0] // grid.shape[0] * sides[1] + column * sides[1] // grid.shape[1]
        order = np.argsort(regions, kind="stable")
        self.places = np.stack((column, row), axis=1)[order].astype(np.float64)
        self.ahead = grid.directions[row, column][order]
        self.eyes = None if grid.origins is None else grid.origins[row, column][order]
        self.first = np.flatnonzero(np.diff(regions[order], prepend=-1))

    def nearest(self, points: np.ndarray) -> np.ndarray:
        """Return the places (regions, n, 2) of the entry of each region whose ray makes the least angle with the way
        from its origin to each point; for each point those of the least angles first.
        """
        along = points @ self.ahead.T
        if self.eyes is not None:
            along -= _dot(self.eyes, self.ahead)
            away = _dot(points, points)[:, None] - 2 * points @ self.eyes.T + _dot(self.eyes, self.eyes)
            along /= np.sqrt(np.maximum(away, np.finfo(float).tiny))
        along = np.where(np.isnan(along), -np.inf, along)
        ends = (*self.first[1:].tolist(), len(self.places))
        best = [start + along[:, start:end].argmax(axis=1) for start, end in zip(self.first, ends, strict=True)]
        chosen = np.stack(best, axis=1)
        order = np.argsort(-np.take_along_axis(along, chosen, axis=1), axis=1, kind="stable")
        return self.places[np.take_along_axis(chosen, order, axis=1).T]


def _dot(left: np.ndarray, right: np.ndarray) -> np.ndarray:
    return (left * right).sum(axis=1)
