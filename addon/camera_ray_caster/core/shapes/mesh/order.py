"""The order in which triangles are tested: the nearest first, in parts, so that these hide many of the others."""

import math
from collections.abc import Iterator

import numpy as np

from ... import tuning
from ..windows import pixels_in
from .mesh_in_camera import Triangles


def nearest_first(near: np.ndarray, count: np.ndarray, size: int) -> Iterator[np.ndarray]:
    """Yield blocks in parts of about ``size`` triangles, those with the least t first."""
    order = np.argsort(near, kind="stable")
    batch = (np.cumsum(count[order]) - 1) // size
    yield from np.split(order, np.flatnonzero(np.diff(batch)) + 1)


def slabs(triangles: Triangles, pixels: int) -> Iterator[np.ndarray]:
    """Yield triangles in parts of about the same work, those with the least t first. The number of parts grows with
    their work compared with the pixels of their tile, since the tile's farthest t are computed before each part.
    """
    near, work = triangles.near, tuning.TRIANGLE_PIXELS + pixels_in(triangles.bounds)
    if not near.size:
        return
    count = max(1, round(math.sqrt(work.sum() / (pixels + tuning.SLAB_PIXELS))))
    sample = np.arange(0, len(near), max(1, len(near) >> 12))
    sample = sample[np.argsort(near[sample])]
    done = np.cumsum(work[sample])
    cuts = near[sample[np.searchsorted(done, done[-1] * np.arange(1, count) / count)]]
    slab = np.searchsorted(cuts, near)
    for k in range(count):
        yield np.flatnonzero(slab == k)


def pieces(bounds: np.ndarray, limit: int) -> Iterator[slice]:
    """Yield slices of at most SPANNED triangles, which end once their bounds have more than ``limit`` pixels."""
    pixels = np.cumsum(pixels_in(bounds))
    first = 0
    while first < len(bounds):
        end = min(first + tuning.SPANNED, int(np.searchsorted(pixels, pixels[first] + limit)) + 1)
        yield slice(first, end)
        first = end
