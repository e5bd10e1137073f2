"""The hits of rays: t and the index of the shape that is hit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from .. import tuning
from ..maths.speed import lazy
from ..maths.vector import ALL, cut
from .plan import Plan
from .rays import TileRays

NOTHING = -1
"""Shape index of a pixel that sees no shape."""


@dataclass(frozen=True, eq=False)
class Hits:
    """The hits of the rays of a tile, or of some of its rows: (rows, columns) arrays."""

    plan: Plan
    rays: TileRays
    t: np.ndarray
    """t of the hits; inf where nothing is hit."""
    index: np.ndarray
    """Index into ``Shapes`` of the nearest shape, NOTHING where nothing is hit."""
    known: Mapping[int, Any] = field(default_factory=dict)
    """What kinds know of the hits of the tile: see ``SearchRays.known``."""
    first_row: int = 0
    """Row of the tile at which these hits begin."""

    def blocks(self) -> Iterator[tuple[slice, Hits]]:
        """Yield (rows, hits) for blocks of rows of about BLOCK_PIXELS pixels."""
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
            yield rows, Hits(self.plan, rays, self.t[rows], self.index[rows], self.known, first)

    @lazy
    def seen(self) -> np.ndarray:
        """Whether a shape is hit, bool."""
        return self.index != NOTHING

    @lazy
    def missed(self) -> np.ndarray | None:
        """Whether no shape is hit, bool; None if every ray hits."""
        return ~self.seen if self.index.min(initial=0) == NOTHING else None

    @lazy
    def has_ray(self) -> np.ndarray:
        """Whether the pixel has a ray, bool."""
        ray = np.ones(self.t.shape, bool)
        for component in self.rays.direction:
            ray &= ~np.isnan(component)
        return ray

    @lazy
    def lost(self) -> np.ndarray | None:
        """Whether the pixel has no ray, bool; None if every pixel has a ray."""
        return ~self.has_ray if any(np.isnan(component).any() for component in self.rays.direction) else None
