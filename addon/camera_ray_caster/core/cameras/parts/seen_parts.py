"""Parts of a picture by the rays that they have: the bounds of balls for a model without a closed form of its own."""

import math
from collections.abc import Callable
from itertools import pairwise, product
from typing import Any

import numpy as np

from ...maths.recording import NotRecordable, Record
from ...maths.recording.ranges import ANY, ranges
from ...maths.speed import lazy
from ...maths.vector import stacked
from .direction_map import SLOPE_MARGIN, DirectionMap

PARTS = 288
"""Parts along the longer side of a frame, of 2 x 2 pixels or more; a table has as many to twice as many on each axis.
With 192, the pictures of ``direction_map.CELLS`` take 1.0 to 1.35 times as long; with 128, 1.0 to 1.6 times.
"""

MAPS = 16
"""Groups of parts if rays have several origins. With 64, these scenes through tables of a cross-slit, a pushbroom and a
twisted orthographic camera take 0.85 to 1.7 times as long; with one, 1.0, 6 and 5 times.
"""

FAR = 32
"""Balls at this distance, over the reach of all origins, are looked up with all origins at once. Processor time of
pictures, 640 x 360, of a street, a room and a table through tables with origins within 3 cm, of that with groups alone:
16 and 64: 0.55 to 0.85; 256: 0.75 to 1.1.
"""

TOGETHER = 32
"""Number of consecutive balls asked for together first: whether rays meet the ball around all of them."""

BALL_MARGIN = 1 + 1e-9
"""Factor of radii of balls around balls, for their rounding."""

Group = tuple[np.ndarray, float, tuple[slice, slice]]
"""The middle of the origins of some parts' rays, the distance within which these lie, and the place of the parts."""


class SeenParts:
    """Parts of a picture, x0, x1, y0, y1 (rows, columns, 4), and the least and largest components of their rays: the
    directions, of any length, and the origins unless these are all 0, (rows, columns, 3 or 6); NaN without a ray.
    """

    def __init__(self, low: np.ndarray, high: np.ndarray, parts: np.ndarray):
        self._low, self._high, self._parts = low, high, parts
        several = low.shape[2] == 6
        self._whole = self._maps(_groups(low, high, 1, 1) if several else [(np.zeros(3), 0.0, np.s_[:, :])])

    @lazy
    def _near(self) -> list[tuple[np.ndarray, float, DirectionMap]]:
        """The maps of several groups, for balls near the origins."""
        ways = [_groups(self._low, self._high, 1 << k, MAPS >> k) for k in range(MAPS.bit_length())]
        return self._maps(min(ways, key=lambda way: max((reach for _, reach, _ in way), default=0.0)))

    def _maps(self, groups: list[Group]) -> list[tuple[np.ndarray, float, DirectionMap]]:
        maps = []
        for middle, reach, group in groups:
            least, greatest = (end[group][..., :3].reshape(-1, 3).T for end in (self._low, self._high))
            maps.append((middle, reach, DirectionMap(least, greatest, self._parts[group].reshape(-1, 4))))
        return maps

    def bounds(self, centers: np.ndarray, radii: np.ndarray) -> np.ndarray:
        """Return x0, x1, y0, y1 (n, 4): parts outside of which no ray meets the balls, by centers (n, 3) and radii
        (n,); NaN where no part's rays do, -inf and inf for a ball near origins.
        """
        bounds = np.full((len(radii), 4), np.nan)
        for middle, reach, directions in self._whole:
            away = centers - middle
            is_near = (away * away).sum(axis=1) < (FAR * reach) ** 2  # a ball at NaN may be anywhere
            far, near = np.flatnonzero(~is_near), np.flatnonzero(is_near)
            bounds[far] = directions.bounds(away[far], radii[far] + reach)
            if near.size:
                bounds[near] = self._near_bounds(centers[near], radii[near])
        return bounds

    def _near_bounds(self, centers: np.ndarray, radii: np.ndarray) -> np.ndarray:
        """Return ``bounds`` by several groups, each of which has a smaller reach."""
        turn, bounds = np.array((1, -1, 1, -1)), np.full((len(radii), 4), np.nan)
        starts = np.arange(0, len(radii), TOGETHER)
        together = len(starts) > TOGETHER
        if together:
            low, high = np.minimum.reduceat(centers, starts), np.maximum.reduceat(centers, starts)
            middles = low / 2 + high / 2
            wide = np.sqrt(((high - middles) ** 2).sum(axis=1)) * BALL_MARGIN + np.maximum.reduceat(radii, starts)
        for middle, reach, directions in self._near:
            chosen: Any = slice(None)
            if together:
                may = ~np.isnan(directions.bounds(middles - middle, wide + reach)[:, 0])
                chosen = np.flatnonzero(may.repeat(TOGETHER)[: len(radii)])
            seen = directions.bounds(centers[chosen] - middle, radii[chosen] + reach)
            bounds[chosen] = np.fmin(bounds[chosen], seen * turn)
        return bounds * turn


def parts_of(formula: Callable[[], Record], size: tuple[int, int], central: bool) -> SeenParts:
    """Return the parts of a picture, by the recorded formula of its rays: pixel coordinates to origin and direction.

    If it cannot be recorded, all parts may have any ray.
    """
    side = max(2, math.ceil(max(size) / PARTS))
    x, y = np.meshgrid(*(np.arange(-1.0, math.ceil(length / side) * side + 1, side) for length in size))
    try:
        ends = ((first - SLOPE_MARGIN, first + side + SLOPE_MARGIN) for first in (x, y))
        intervals = ranges(formula(), tuple(ends))
    except NotRecordable:
        intervals = (ANY,) * 6
    components = intervals[3:] if central else intervals[3:] + intervals[:3]
    low, high = (stacked([component[end] for component in components], x.shape) for end in (0, 1))
    return SeenParts(low, high, np.stack((x, x + side, y, y + side), axis=2))


def _groups(low: np.ndarray, high: np.ndarray, rows: int, columns: int) -> list[Group]:
    """Divide parts with origins into rows and columns of groups; those without rays are left out."""
    groups: list[Group] = []
    counts = zip(low.shape[:2], (rows, columns), strict=True)
    cuts = [np.linspace(0, side, count + 1).astype(int) for side, count in counts]
    for row, column in product(*map(pairwise, cuts)):
        group = slice(*row), slice(*column)
        ends = [end[group].reshape(-1, 6) for end in (low, high)]
        has_ray = ~np.isnan(ends[0]).any(axis=1)
        if has_ray.any():
            least, greatest = ends[0][has_ray, 3:].min(axis=0), ends[1][has_ray, 3:].max(axis=0)
            reach = math.sqrt(((greatest - least) ** 2).sum()) / 2
            groups.append((least / 2 + greatest / 2 if reach < math.inf else np.zeros(3), reach, group))
    return groups
