"""The search among shapes that are rows of constants: large shapes one by one, small shapes in batches."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property, partial
from heapq import merge
from operator import attrgetter
from typing import Any

import numpy as np

from .. import tuning
from ..maths.vector import cut, is_lattice
from .cutouts import Cutouts
from .kind import Candidates, Large, ShapeSet, Visible
from .search_rays import SearchRays
from .windows import Windows, batches, in_tile, pixels_in


@dataclass(frozen=True, eq=False)
class SearchGroup:
    """Shapes of one kind that are tested in the same way."""

    intersect: Callable
    """``AffineKind.intersect`` of the kind; ``lattice`` and ``in_front`` likewise."""
    lattice: Callable
    in_front: Callable
    visible: Visible
    is_simple: bool
    """Whether the eye is outside and nothing lies before the clip start, so that the near root alone decides."""
    is_small: bool
    """Whether the shapes are tested many at once; if so, they are sorted by the lowest row that may see them."""
    constants: Any
    """A dataclass of arrays whose last axis counts the shapes."""
    cutouts: Cutouts | None = None
    """The transparent points of the shapes, if they may have any."""

    @cached_property
    def tallest(self) -> int:
        """Largest number of rows in which one of the shapes may be seen."""
        return int((self.visible.bounds[:, 3] - self.visible.bounds[:, 2]).max())

    def within(self, corner: tuple[int, int], shape: tuple[int, int]) -> tuple[np.ndarray, np.ndarray]:
        """Return which of the shapes may be seen in a tile, (k,), and their bounds in the tile, (k, 4)."""
        rows = slice(None)
        if self.is_small:
            ends = corner[1] - self.tallest, corner[1] + shape[0]
            rows = slice(*np.searchsorted(self.visible.bounds[:, 2], ends))
        here, edges = in_tile(self.visible.bounds[rows], corner, shape)
        return here + (rows.start or 0), edges

    def large(self, rays: SearchRays) -> Iterator[Large]:
        here, bounds = self.within(rays.corner, rays.shape)
        is_narrowed = rays.origin is None and pixels_in(bounds).sum() > tuning.NARROWED_TILES * math.prod(rays.shape)
        count = max(1, tuning.PREPARED_PIXELS // sum(rays.shape))
        for end in range(len(here), 0, -count):
            chunk = slice(max(0, end - count), end)
            chosen, edges = here[chunk], bounds[chunk]
            functions = self.in_front(self._constants(chosen)) if is_narrowed else None
            if functions is not None:
                shown, edges = rays.cells.in_front(functions, edges)
                chosen = chosen[shown]
            meet = self._meet(rays, chosen)
            for k in reversed(range(len(chosen))):
                yield Large(int(self.visible.at[chosen[k]]), edges[k].tolist(), partial(meet, k))

    def _meet(self, rays: SearchRays, here: np.ndarray) -> Callable:
        """Return a function that gives t and hits, as ``Large.solve``, of the k-th shape at ``here`` in a window."""
        if rays.origin is None and self.is_simple and is_lattice(rays.direction):
            lattice = self.lattice(self._constants(here, axes=2), rays.direction)
            if lattice is not None:
                return lattice.meet

        def meet(k, window, scratch):
            at = self.visible.at[here[k]]
            return self._intersect(rays, at, self._constants(here[k]), lambda component: cut(component, window))

        return meet

    def batches(self, rays: SearchRays) -> Iterator[Candidates]:
        """Yield the crossings with small shapes, in windows as large as the largest bounds of a batch."""
        here, bounds = self.within(rays.corner, rays.shape)
        for batch in batches(bounds):
            yield self._cast_batch(rays, here[batch], bounds[batch])

    def _cast_batch(self, rays: SearchRays, here: np.ndarray, bounds: np.ndarray) -> Candidates:
        """Test many shapes at once, in windows that are shifted to lie in the tile."""
        order = np.lexsort((-self.visible.at[here], -self.visible.near[here]))  # the nearest shapes are written last
        here = here[order]
        windows = Windows.around(bounds[order], rays.shape)
        at = self.visible.at[here][:, None, None]
        t, where = self._intersect(rays, at, self._constants(here, axes=2), windows.of)
        t = np.broadcast_to(t, (len(here), *windows.size))
        return Candidates(at, (windows.row, windows.column), t, where)

    def _constants(self, here, axes: int = 0):
        """Return the constants of the shapes at ``here``, an index or indices; ``axes`` more axes are appended."""
        values = (getattr(self.constants, name)[..., here] for name in self.constants.__dataclass_fields__)
        extra = (1,) * axes
        return type(self.constants)(*(value.reshape(*value.shape, *extra) if axes else value for value in values))

    def _intersect(self, rays: SearchRays, at: Any, constants: Any, in_window: Callable) -> tuple[Any, Any]:
        origin = None if rays.origin is None else tuple(map(in_window, rays.origin))
        direction = tuple(map(in_window, rays.direction))
        first = None if self.is_simple else self.visible.clip_start

        def cross(start):
            return self.intersect(constants, origin, direction, first if start is None else start, rays.scratch)

        if self.cutouts is None:
            return cross(None)
        nearest = None if rays.nearest is None else in_window(rays.nearest)
        return self.cutouts.first_hit(at, origin, direction, nearest, cross)


@dataclass(frozen=True, eq=False)
class AffineSet(ShapeSet):
    """The shapes of one affine kind that a camera may see."""

    groups: tuple[SearchGroup, ...]
    faces_eye: bool
    has_cutouts: bool = False

    def large(self, rays: SearchRays) -> Iterator[Large]:
        large = (group.large(rays) for group in self.groups if not group.is_small)
        return merge(*large, key=attrgetter("at"), reverse=True)

    def rest(self, rays: SearchRays, nearest: np.ndarray) -> Iterator[Candidates]:
        for group in self.groups:
            if group.is_small:
                yield from group.batches(rays)


def divide(visible: Visible, may_be_cut: np.ndarray | None) -> Iterator[tuple[Visible, bool, bool, bool]]:
    """Yield groups of shapes that are tested in the same way, whether they are simple and small (``SearchGroup``), and
    may have transparent points, which ``may_be_cut`` says for all ``Shapes``, (n,); None if no shape has any.
    """
    is_cut = np.zeros(len(visible.at), bool) if may_be_cut is None else may_be_cut[visible.at]
    is_simple = (visible.near >= visible.clip_start) & ~is_cut
    is_small = pixels_in(visible.bounds) < tuning.SMALL_PIXELS
    alike = 4 * is_cut + 2 * is_simple + is_small
    for code in np.unique(alike).tolist():
        indices = np.flatnonzero(alike == code)
        if code & 1:
            indices = indices[np.argsort(visible.bounds[indices, 2], kind="stable")]
        bounds = np.asfortranarray(visible.bounds[indices])
        yield (
            replace(visible, at=visible.at[indices], bounds=bounds, near=visible.near[indices]),
            bool(code & 2),
            bool(code & 1),
            bool(code & 4),
        )
