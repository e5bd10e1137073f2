"""The nearest triangle of every ray of a tile: many triangles are tested at once, in spans of rows or ray by ray."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from ... import tuning
from ...conventions import EPS
from ...maths.speed import merged, taken
from ...maths.vector import difference, dot, norm
from ...records import MESH
from ..cutouts import Cutouts, crossings
from ..kind import Candidates, PixelBounds, ShapeSet
from ..ray_cells import Pixels
from ..search_rays import SearchRays
from ..shape_frames import BOUNDS_FACTOR
from ..windows import banded, in_tile, pixels_in, union
from .mesh_in_camera import MeshesInView, Triangles
from .mesh_surface import TRIANGLES, HitTriangles
from .nearest import NONE, Nearest, SeenTriangles
from .order import nearest_first, pieces, slabs
from .spans import RayLattice, spans
from .triangles import VOLUME_ROUNDING, Planes, crossing, edge_vectors, from_origin, plane, signs, volumes

CELLS_ROUNDING = 40
"""Doubt of the volumes of a cell's linear functions over that of the volumes of single rays: their terms have up to
three times the magnitude, and two more roundings; rays over their depth are up to four times as long (see LEAST_DEPTH),
and rounded twice more.
"""

SIDE_ROUNDING = 32 * EPS
"""Error bound of the distance of a point from a triangle's plane, over the sum of the point's distance from the eye and
the corner's.
"""

Reach = tuple[float, float]
"""Upper bounds of the lengths of the directions and of the origins of a tile's rays."""


class Open(NamedTuple):
    """Triangles and pixels in which they still have to be tested."""

    number: np.ndarray
    """(m,) numbers of triangles."""
    vertices: np.ndarray
    """(3, m) indices of their vertices."""
    pixel: np.ndarray
    """(m,) pixels of the tile."""

    @classmethod
    def of(cls, triangles: Triangles, k: np.ndarray, pixel: np.ndarray) -> Open:
        """Return the triangles with some indices, one for each pixel."""
        return cls(taken(triangles.index, k), taken(triangles.corners, k), pixel)


@dataclass(frozen=True, eq=False)
class MeshSet(ShapeSet):
    """The meshes that a camera may see. ``rest`` tells the triangle of each pixel: see ``SeenTriangles``."""

    meshes: MeshesInView
    clip_start: float
    cutouts: Cutouts | None = None
    """The transparent points of the meshes; None if there are none."""
    pixels: PixelBounds | None = None
    """The columns and rows of the picture that are searched; None for all."""
    faces_eye = True

    def at(self, pixels: PixelBounds) -> MeshSet:
        """Return the same set for some columns and rows of the picture."""
        return replace(self, pixels=pixels)

    def rest(self, rays: SearchRays, nearest: np.ndarray) -> Iterator[Candidates | None]:
        for _ in self.meshes.prepare():
            yield None
        blocks = self.meshes.blocks
        here, bounds = in_tile(self._in_plan(blocks.bounds), rays.corner, rays.shape)
        if not here.size:
            return
        window = union(bounds)
        whole, rays = rays, rays.within(window)
        first_row, first_column = (side.start for side in window)
        bounds -= np.array([first_column, first_column, first_row, first_row], bounds.dtype)
        hits = Nearest.of(nearest[window], rays)
        hits.met = None if whole.met is None else []
        lattice = RayLattice.of(rays)
        reach = _longest(rays.direction), _longest(rays.origin or (0.0,))
        near = self._least_t(rays, reach, blocks.near.take(here))
        cast = partial(self._in_spans, lattice) if lattice else self._in_cells
        for batch in nearest_first(near, blocks.count[here], self.meshes.chunk):
            batch = batch.take(hits.may_show(bounds.take(batch, axis=0), near.take(batch)))
            chosen = np.sort(here.take(batch))
            for _ in self.meshes.place(chosen):
                yield None
            triangles = self.meshes.triangles(chosen)
            inside, parts = in_tile(self._in_plan(triangles.bounds), rays.corner, rays.shape)
            triangles = triangles.only(inside, parts.astype(np.intp))  # their products may exceed the type of bounds
            triangles = replace(triangles, near=self._least_t(rays, reach, triangles.near))
            for slab in slabs(triangles, hits.t.size):
                slab = slab.take(hits.may_show(triangles.bounds.take(slab, axis=0), triangles.near.take(slab)))
                tested = triangles.only(slab)
                for _ in cast(rays, reach, replace(tested, index=hits.enter(tested.index)), hits):
                    yield None
            yield None
        if whole.met is not None:
            for pixel, t, number in hits.met or ():
                row, column = np.divmod(pixel, rays.shape[1])
                pixels = (row + first_row) * whole.shape[1] + column + first_column
                whole.met.append((pixels, t, *blocks.numbers(hits.entry(number))))
        seen, of_pixel = hits.seen()
        if not seen.size:
            return
        of_tile = whole.scratch("triangles seen", whole.shape, np.int32)
        of_tile[window] = of_pixel
        whole.known[MESH] = known = SeenTriangles(*blocks.numbers(seen), of_tile)
        corner = np.array([first_row]), np.array([first_column])
        met = hits.number != NONE
        at = merged(known.at)
        at = at[None, None] if len(at) == 1 else at.take(of_pixel)[None]
        yield Candidates(at, corner, hits.t[None], met[None])

    def _least_t(self, rays: SearchRays, reach: Reach, near: np.ndarray) -> np.ndarray:
        """Return lower bounds of t, given those of ``PixelBounds.least_t``."""
        if self.meshes.is_planar or rays.origin is None:
            return near
        gap = near - BOUNDS_FACTOR * reach[1]
        return np.where(gap > 0, gap / (BOUNDS_FACTOR * reach[0]), -np.inf)

    def _in_plan(self, bounds: np.ndarray) -> np.ndarray:
        return bounds if self.pixels is None else self.pixels.within(bounds)

    def _in_spans(
        self, lattice: RayLattice, rays: SearchRays, reach: Reach, triangles: Triangles, hits: Nearest
    ) -> Iterator[None]:
        """Keep the hits of a lattice of rays on triangles, in small steps."""
        at, bands = banded(triangles.bounds, tuning.SPANNED_PIXELS)
        triangles = triangles.only(at, bands)
        untested: list[Open] = []
        for piece in pieces(bands, tuning.SPANNED_PIXELS):
            untested.append(self._span(rays, lattice, reach, triangles.only(piece), hits))
            yield
        self._test(rays, untested, hits)

    def _in_cells(self, rays: SearchRays, reach: Reach, triangles: Triangles, hits: Nearest) -> Iterator[None]:
        """Keep the hits of any rays on triangles, in small steps."""
        triangles = self._in_windows(rays, reach, triangles)
        triangles = triangles.only(*banded(triangles.bounds, tuning.BOXED_PIXELS))
        untested: list[Open] = []
        for piece in pieces(triangles.bounds, tuning.BOXED_PIXELS):
            untested.append(self._in_some_cells(rays, reach, triangles.only(piece), hits))
            yield
        self._test(rays, untested, hits)

    def _in_windows(self, rays: SearchRays, reach: Reach, triangles: Triangles) -> Triangles:
        """Return the triangles; if many have wide bounds, these once for each wide cell in which a ray may hit them."""
        pixels = pixels_in(triangles.bounds.astype(np.intp))
        is_wide = pixels > (2 * tuning.WIDE_CELL) ** 2
        if pixels[is_wide].sum() < tuning.WIDE_TILES * math.prod(rays.shape):
            return triangles
        parts = [(np.flatnonzero(~is_wide), triangles.bounds[~is_wide])]
        wide_index = np.flatnonzero(is_wide)
        wide = triangles.only(wide_index)
        banded_index, bounds = banded(wide.bounds, tuning.WIDE_PIXELS)
        for piece in pieces(bounds, tuning.WIDE_PIXELS):
            meets, corners, turns = self._facing(rays, taken(wide.corners, banded_index[piece]))
            edges, doubt = edge_vectors(corners, rays.origin is None), _doubt(corners, reach)
            at, windows = rays.wide_cells.windows(edges, CELLS_ROUNDING * doubt, bounds[piece][meets], turns)
            parts.append((wide_index[banded_index[piece][meets][at]], windows))
        at, windows = map(np.concatenate, zip(*parts, strict=True))
        order = np.argsort(at, kind="stable")
        return triangles.only(at[order], windows[order])

    def _facing(self, rays: SearchRays, corners: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return ``MeshesInView.facing`` of triangles, with corners ordered for most rays with many origins, too, and
        the indices, among the triangles returned, of those that rays may hit on either side.
        """
        meets, corners = self.meshes.facing(corners)
        if rays.origin is None:
            return meets, corners, meets[:0]
        middle, radius = rays.origin_ball
        normal, away = plane(corners)[0], difference(corners[0], middle)
        side, lengths = dot(normal, away), norm(corners[0]) + norm(middle)
        turns = ~(np.abs(side) > (BOUNDS_FACTOR * radius + SIDE_ROUNDING * lengths) * norm(normal))
        corners[1:] = np.where(turns | (side > 0), corners[1:], corners[:0:-1])
        return meets, corners, np.flatnonzero(turns)

    def _in_some_cells(self, rays: SearchRays, reach: Reach, triangles: Triangles, nearest: Nearest) -> Open:
        """Keep the hits on triangles that are certain, and return those pixels in which rounding could decide."""
        meets, corners, turns = self._facing(rays, triangles.corners)
        if len(meets) < len(triangles):
            triangles = triangles.only(meets)
        edges, doubt = edge_vectors(corners, rays.origin is None), _doubt(corners, reach)
        planes, farthest = Planes(corners, rays.origin is None, reach[0]), nearest.farthest
        met, open_ = rays.cells.spans(edges, CELLS_ROUNDING * doubt, triangles.bounds, turns, planes, farthest)

        def keep(hits: Pixels) -> None:
            t = planes.crossings(hits.at, *rays.at(hits.pixel))
            self._keep(rays, nearest, hits.pixel, t, taken(triangles.index, hits.at))

        for hits in met.pieces(tuning.TRACED_PIXELS):
            keep(hits)
        left = [Pixels(*np.zeros((2, 0), np.intp))]
        for piece in open_.pieces(tuning.TRACED_PIXELS):
            vectors = rays.factors(piece.pixel)
            volumes = tuple(np.einsum("ij,ij->j", taken(edge, piece.at), vectors) for edge in edges)
            inner, limit = _inside(volumes, is_turned=rays.origin is None), taken(doubt, piece.at)
            keep(piece.only(inner > limit))
            left.append(piece.only(np.abs(inner) <= limit))
        at, pixel = map(np.concatenate, zip(*left, strict=True))
        return Open.of(triangles, at, pixel)

    def _span(self, rays: SearchRays, lattice: RayLattice, reach: Reach, triangles: Triangles, hits: Nearest) -> Open:
        """Keep the hits on triangles in spans, and ray by ray on triangles without spans. Return the pixels in which
        triangles still have to be tested.
        """
        meets, corners = self.meshes.facing(triangles.corners)
        if len(meets) < len(triangles):
            triangles = triangles.only(meets)
        seen = spans(lattice, corners, triangles.bounds, rays.shape[1])
        at, pixel = seen.met
        self._keep(rays, hits, pixel, seen.t, taken(triangles.index, at))
        if not seen.clear.all():
            for _ in self._in_cells(rays, reach, triangles.only(np.flatnonzero(~seen.clear)), hits):
                pass
        return Open.of(triangles, *seen.open)

    def _test(self, rays: SearchRays, untested: list[Open], hits: Nearest) -> None:
        """Keep the hits among triangles that have to be tested, by exact signs where rounding could decide. All are
        tested at once, since one computation of exact signs takes a millisecond.
        """
        if not any(len(triangles.number) for triangles in untested):
            return
        tested = Open(*(np.concatenate(values, axis=-1) for values in zip(*untested, strict=True)))
        origin, direction = rays.at(tested.pixel)
        corners = np.array([from_origin(corner, origin) for corner in self.meshes.places(tested.vertices)])
        doubt = VOLUME_ROUNDING * np.maximum.reduce([norm(corner) for corner in corners]) ** 2 * norm(direction)
        inner = _inside(volumes(corners, direction), is_turned=False)
        met = inner > doubt
        open_ = np.flatnonzero(np.abs(inner) <= doubt)
        if open_.size:
            exact = signs(corners[:, :, open_], direction[:, open_])
            met[open_] = ((exact >= 0).all(axis=0) | (exact <= 0).all(axis=0)) & exact.any(axis=0)
        self._meet(rays, Open(tested.number[met], tested.vertices[:, met], tested.pixel[met]), hits)

    def _meet(self, rays: SearchRays, met: Open, hits: Nearest) -> None:
        """Keep the hits on triangles that are known to be hit, one per pixel."""
        t = crossing(self.meshes.places(met.vertices), *rays.at(met.pixel))
        self._keep(rays, hits, met.pixel, t, met.number)

    def _keep(self, rays: SearchRays, hits: Nearest, pixel: np.ndarray, t: np.ndarray, numbers: np.ndarray) -> None:
        """Keep hits at or beyond the clip start, on points that are not transparent."""
        met = (t >= self.clip_start) & (t < np.inf)
        if self.cutouts is not None:
            met &= t <= taken(hits.t.reshape(-1), pixel)
            met[met] = self._is_hit(self.cutouts, rays, hits, pixel[met], t[met], numbers[met])
        if not met.all():
            pixel, t, numbers = pixel[met], t[met], numbers[met]
        hits.keep(pixel, t, numbers)

    def _is_hit(self, cutouts: Cutouts, rays: SearchRays, hits: Nearest, pixel, t, numbers) -> np.ndarray:
        """Return which crossings with triangles, (m,), are hits: all but those with transparent points."""
        distinct, triangle = np.unique(numbers, return_inverse=True)
        at, number = self.meshes.blocks.numbers(hits.entry(distinct))
        is_hit = np.ones(len(pixel), bool)
        may_be_cut = np.flatnonzero(cutouts.may[at][triangle])
        if may_be_cut.size:
            origin, direction = rays.at(pixel[may_be_cut])
            point = direction * t[may_be_cut] if origin is None else origin + direction * t[may_be_cut]
            hit = HitTriangles(cutouts.shapes, triangle[may_be_cut], at, number, origin is None).only(slice(None))
            pixels = crossings(at[triangle[may_be_cut]], t[may_be_cut], origin is None, **{TRIANGLES: hit})
            is_hit[may_be_cut] = cutouts.hit(pixels, point)
        return is_hit


def _inside(volumes: tuple[Any, Any, Any], is_turned: bool) -> np.ndarray:
    """Return the volume that is nearest to making a ray miss its triangle: positive on a hit.

    ``is_turned``: all volumes of a hit are known to be positive; otherwise they may all be negative, too.
    """
    first, second, third = volumes
    inner = np.minimum(np.minimum(first, second), third)
    if not is_turned:
        np.maximum(inner, -np.maximum(np.maximum(first, second), third), out=inner)
    return inner


def _doubt(corners: Any, reach: Reach) -> np.ndarray:
    """Return an error bound of the volumes of triangles with corners in the camera's frame, for all rays of a tile."""
    longest = np.maximum.reduce([norm(corner) for corner in corners])
    return VOLUME_ROUNDING * reach[0] * (longest + reach[1]) ** 2


def _longest(vectors: Any) -> float:
    """Return an upper bound of the lengths of vectors, from components that broadcast; NaN is ignored."""
    return math.sqrt(sum(float(np.fmax.reduce(np.square(component), axis=None, initial=0.0)) for component in vectors))
