"""The hits of rays: t and the shape that is hit."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from .. import tuning
from ..maths.speed import lazy
from ..maths.vector import ALL, cut
from .plan import Plan
from .rays import TileRays

NOTHING = -1
"""Shape index of a pixel that sees none."""


@dataclass(frozen=True, eq=False)
class Hits:
    """The hits of the rays of a tile, or of some of its rows: (rows, columns) arrays."""

    plan: Plan
    rays: TileRays
    t: np.ndarray
    """inf where nothing is hit."""
    index: np.ndarray
    """Index into ``Shapes`` of the nearest shape, NOTHING where there is none."""
    first_row: int = 0
    """Of these, in the tile."""

    def blocks(self) -> Iterator[tuple[slice, Hits]]:
        """Yield (rows, hits) of some rows at a time: working arrays stay in a core's cache."""
        height, width = self.t.shape
        step = max(1, tuning.BLOCK_PIXELS // width)
        for first in range(0, height, step):
            rows = slice(first, first + step)
            window = rows, ALL
            origin, direction = (
                tuple(cut(component, window) for component in vector)
                for vector in (self.rays.origin, self.rays.direction)
            )
            rays = replace(self.rays, y=self.rays.y[rows], origin=origin, direction=direction)
            yield rows, Hits(self.plan, rays, self.t[rows], self.index[rows], first)

    @lazy
    def seen(self) -> np.ndarray:
        """Where a shape is hit, bool."""
        return self.index != NOTHING

    @lazy
    def missed(self) -> np.ndarray | None:
        """Where none is, bool; None where that is nowhere."""
        return ~self.seen if self.index.min(initial=0) == NOTHING else None

    @lazy
    def has_ray(self) -> np.ndarray:
        """Where the pixel has a ray, bool."""
        ray = np.ones(self.t.shape, bool)
        for component in self.rays.direction:
            ray &= ~np.isnan(component)
        return ray

    @lazy
    def lost(self) -> np.ndarray | None:
        """Where the pixel has no ray, bool; None where that is nowhere."""
        return ~self.has_ray if any(np.isnan(component).any() for component in self.rays.direction) else None
