"""The hits of rays: t and the index of the shape that is hit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from .. import tuning
from ..maths.speed import lazy, widened
from ..maths.vector import ALL
from ..shapes.windows import banded, in_tile
from .rays import TileRays
from .target import RayTarget

Window = tuple[slice, slice]
"""Rows and columns."""

NOTHING = -1
"""Shape index of a pixel that sees no shape."""


@dataclass(frozen=True, eq=False)
class Hits:
    """The hits of the rays of a tile, or of a window of it: (rows, columns) arrays."""

    target: RayTarget
    rays: TileRays
    t: np.ndarray
    """t of the hits; inf where nothing is hit."""
    index: np.ndarray
    """Index into ``Shapes`` of the nearest shape, NOTHING where nothing is hit."""
    faces_eye: bool = False
    """Whether all normals face the rays' origins without being turned."""
    windows: tuple[np.ndarray, np.ndarray] | None = None
    """The shapes that may be hit, (m,), and their bounds in the picture, (m, 4), if these are few and large: passes are
    then written shape by shape.
    """
    known: Mapping[int, Any] = field(default_factory=dict)
    """What kinds know of the hits of the tile: see ``SearchRays.known``."""
    window: Window = (ALL, ALL)
    """Rows and columns of the tile in which these hits are."""
    shape: int | None = None
    """The shape whose hits are meant; None for all shapes."""

    def blocks(self) -> Iterator[tuple[Window, Hits]]:
        """Yield (window, hits) for blocks of rows of about BLOCK_PIXELS pixels."""
        height, width = self.t.shape
        step = max(1, tuning.BLOCK_PIXELS // width)
        for first in range(0, height, step):
            window = slice(first, min(first + step, height)), ALL
            yield window, self._part(window)

    def layers(self) -> Iterator[tuple[Window, Hits]]:
        """Yield (window, hits) for each shape that is seen, in the pixels of its bounds, BLOCK_PIXELS at a time."""
        if self.windows is None:
            return
        shapes, bounds = self.windows
        here, bounds = in_tile(bounds, self.rays.corner, self.rays.shape)
        band, bounds = banded(bounds, tuning.BLOCK_PIXELS)
        for at, of_shape in zip(shapes[here[band]].tolist(), bounds.tolist(), strict=True):
            window = widened(of_shape, self.rays.shape[1])
            layer = self._part(window, at)
            if layer.seen.any():
                yield window, layer

    def _part(self, window: Window, shape: int | None = None) -> Hits:
        """Return the hits in a window, or there those of one shape."""
        first = self.window[0].start or 0
        whole = slice(first + window[0].start, first + window[0].stop), window[1]
        return replace(
            self, rays=self.rays.within(window), t=self.t[window], index=self.index[window], window=whole, shape=shape
        )

    @lazy
    def seen(self) -> np.ndarray:
        """Whether a shape that is meant is hit, bool."""
        return self.index != NOTHING if self.shape is None else self.index == self.shape

    @lazy
    def where(self) -> Any:
        """The pixels that passes of the surface write: ``seen``, or True for all; misses are then written later."""
        return True if self.shape is None or self.seen.all() else self.seen

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
