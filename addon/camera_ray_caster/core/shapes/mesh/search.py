"""The nearest triangle of every ray of a tile: many triangles are tested at once, in spans of rows or ray by ray."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from ... import tuning
from ...maths.speed import merged, taken
from ...maths.vector import dot, norm
from ...records import MESH
from ..cutouts import Cutouts, crossings
from ..kind import Candidates, PixelBounds, ShapeSet
from ..search_rays import SearchRays
from ..windows import Windows, banded, batches, in_tile, pixels_in, union
from .in_camera import MeshesInView, Triangles
from .nearest import NONE, Nearest, SeenTriangles
from .order import nearest_first, pieces, slabs
from .spans import RayLattice, spans
from .surface import TRIANGLES, HitTriangles
from .triangles import VOLUME_ROUNDING, crossing, edge_vectors, from_origin, signs, volumes

Reach = tuple[float, float]
"""Upper bounds of the lengths of the directions and of the origins of a tile's rays."""


class Open(NamedTuple):
    """Triangles and pixels in which they still have to be tested."""

    which: np.ndarray
    """(m,) numbers of triangles."""
    vertices: np.ndarray
    """(3, m) indices of their vertices."""
    pixel: np.ndarray
    """(m,) pixels of the tile."""

    @classmethod
    def of(cls, triangles: Triangles, k: np.ndarray, pixel: np.ndarray) -> Open:
        """Return the triangles with some indices, one for each pixel."""
        return cls(taken(triangles.which, k), taken(triangles.corners, k), pixel)

    @classmethod
    def none(cls) -> Open:
        """Return no triangle."""
        return cls(np.zeros(0, np.intp), np.zeros((3, 0), np.intp), np.zeros(0, np.intp))


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
        """See ``ShapeSet``."""
        for _ in self.meshes.prepare():
            yield None
        blocks = self.meshes.blocks
        here, bounds = in_tile(self._in_plan(blocks.bounds), rays.corner, rays.shape)
        if not here.size:
            return
        window = union(bounds)
        whole, rays = rays, rays.within(window)
        first_row, first_column = (own.start for own in window)
        bounds -= np.array([first_column, first_column, first_row, first_row], bounds.dtype)
        found = Nearest.of(nearest[window], rays)
        lattice = RayLattice.of(rays)
        reach = _longest(rays.direction), _longest(rays.origin or (0.0,))
        near = blocks.near.take(here)
        cast = partial(self._in_spans, lattice) if lattice else self._in_cells
        for batch in nearest_first(near, blocks.count[here], self.meshes.chunk):
            batch = batch.take(found.may_show(bounds.take(batch, axis=0), near.take(batch)))
            some = np.sort(here.take(batch))
            for _ in self.meshes.place(some):
                yield None
            triangles = self.meshes.triangles(some)
            inside, parts = in_tile(self._in_plan(triangles.bounds), rays.corner, rays.shape)
            triangles = triangles.only(inside, parts.astype(np.intp))  # their products may exceed the type of bounds
            for slab in slabs(triangles, found.t.size):
                slab = slab.take(found.may_show(triangles.bounds.take(slab, axis=0), triangles.near.take(slab)))
                tested = triangles.only(slab)
                for _ in cast(rays, reach, replace(tested, which=found.enter(tested.which)), found):
                    yield None
            yield None
        seen, of_pixel = found.seen()
        if not seen.size:
            return
        of_tile = whole.scratch("triangles seen", whole.shape, np.int32)
        of_tile[window] = of_pixel
        whole.known[MESH] = known = SeenTriangles(*blocks.numbers(seen), of_tile)
        corner = np.array([first_row]), np.array([first_column])
        met = found.number != NONE
        at = merged(known.at)
        at = at[None, None] if len(at) == 1 else at.take(of_pixel)[None]
        yield Candidates(at, corner, found.t[None], met[None])

    def _in_plan(self, bounds: np.ndarray) -> np.ndarray:
        return bounds if self.pixels is None else self.pixels.within(bounds)

    def _in_spans(
        self, lattice: RayLattice, rays: SearchRays, reach: Reach, triangles: Triangles, found: Nearest
    ) -> Iterator[None]:
        """Keep the hits of a lattice of rays on triangles, in small steps."""
        at, bands = banded(triangles.bounds, tuning.SPANNED_PIXELS)
        triangles = triangles.only(at, bands)
        rest: list[Open] = []
        for some in pieces(bands, tuning.SPANNED_PIXELS):
            rest.append(self._span(rays, lattice, reach, triangles.only(some), found))
            yield
        self._test(rays, rest, found)

    def _in_cells(self, rays: SearchRays, reach: Reach, triangles: Triangles, found: Nearest) -> Iterator[None]:
        """Keep the hits on triangles, in small steps; wide triangles are tested only in cells where they may be hit."""
        is_wide = pixels_in(triangles.bounds) >= tuning.WIDE_PIXELS
        yield from self._in_pixels(rays, reach, triangles.only(np.flatnonzero(~is_wide)), found)
        wide = triangles.only(np.flatnonzero(is_wide))
        wide = wide.only(*banded(wide.bounds, tuning.BOXED_PIXELS))
        for some in pieces(wide.bounds, tuning.BOXED_PIXELS):
            own = wide.only(some)
            meets, corners = self.meshes.facing(own.corners)
            own = own.only(meets)
            edges = edge_vectors(corners, rays.origin is None)
            own = own.only(*rays.cells.parts(edges, 4 * _doubt(corners, reach), own.bounds))
            own = own.only(found.may_show(own.bounds, own.near))
            yield from self._in_pixels(rays, reach, own, found)

    def _span(self, rays: SearchRays, lattice: RayLattice, reach: Reach, triangles: Triangles, found: Nearest) -> Open:
        """Keep the hits on triangles in spans, and ray by ray on triangles without spans. Return the pixels in which
        triangles still have to be tested.
        """
        meets, corners = self.meshes.facing(triangles.corners)
        if len(meets) < len(triangles):
            triangles = triangles.only(meets)
        seen = spans(lattice, corners, triangles.bounds, rays.shape[1])
        at, pixel = seen.met
        self._keep(rays, found, pixel, seen.t, taken(triangles.which, at))
        if not seen.clear.all():
            for _ in self._in_cells(rays, reach, triangles.only(np.flatnonzero(~seen.clear)), found):
                pass
        return Open.of(triangles, *seen.open)

    def _in_pixels(self, rays: SearchRays, reach: Reach, triangles: Triangles, found: Nearest) -> Iterator[None]:
        """Keep the hits on triangles that are tested pixel by pixel, in small steps."""
        if rays.origin is None:
            triangles = triangles.only(*banded(triangles.bounds, tuning.TRACED_PIXELS))
        bounds = triangles.bounds
        for some in pieces(bounds, tuning.TRACED_PIXELS) if rays.origin is None else batches(bounds):
            own = triangles.only(some)
            meets, corners = self.meshes.facing(own.corners)
            if meets.size:
                cast = self._from_eye if rays.origin is None else self._from_anywhere
                cast(rays, corners, _doubt(corners, reach), own.only(meets), found)
            yield

    def _from_eye(self, rays: SearchRays, corners, doubt, triangles: Triangles, found: Nearest) -> None:
        """Keep the hits of rays from the eye in triangles' bounds: all rays share the planes through eye and edges."""
        pixel, k = rays.present.within(triangles.bounds)
        _, direction = rays.at(pixel)
        normals = edge_vectors(corners, from_eye=True)
        inner = _inside(tuple(dot(taken(normal, k), direction) for normal in normals), is_turned=True)
        self._decide(rays, inner, taken(doubt, k), triangles, k, pixel, found)

    def _from_anywhere(self, rays: SearchRays, corners, doubt, triangles: Triangles, found: Nearest) -> None:
        """Keep the hits of rays with many origins, in windows: by moments, without corners relative to each origin."""
        windows = Windows.around(triangles.bounds, rays.shape)
        direction, moment = (tuple(map(windows.flat, parts)) for parts in (rays.direction, rays.moment))
        inner = _inside(volumes(corners, direction, moment), is_turned=False)
        near = np.flatnonzero(inner >= -doubt)
        k = near % len(triangles)
        pixel = windows.pixel.reshape(-1)[near]
        self._decide(rays, inner.reshape(-1)[near], doubt[k], triangles, k, pixel, found)

    def _decide(self, rays: SearchRays, inner, doubt, triangles: Triangles, k, pixel, found: Nearest) -> None:
        """Keep the hits on triangles, one per pixel, given how far inside the rays are and the error bound of that."""
        is_open, is_met = np.abs(inner) <= doubt, inner > doubt
        self._test(rays, [Open.of(triangles, k[is_open], pixel[is_open])], found)
        self._meet(rays, Open.of(triangles, k[is_met], pixel[is_met]), found)

    def _test(self, rays: SearchRays, rest: list[Open], found: Nearest) -> None:
        """Keep the hits among triangles that have to be tested, by exact signs where rounding could decide. All are
        tested at once, since one computation of exact signs takes a millisecond.
        """
        if not any(len(one.which) for one in rest):
            return
        some = Open(*(np.concatenate(part, axis=-1) for part in zip(*rest, strict=True)))
        origin, direction = rays.at(some.pixel)
        corners = np.array([from_origin(corner, origin) for corner in self.meshes.places(some.vertices)])
        doubt = VOLUME_ROUNDING * np.maximum.reduce([norm(corner) for corner in corners]) ** 2 * norm(direction)
        inner = _inside(volumes(corners, direction), is_turned=False)
        met = inner > doubt
        open_ = np.flatnonzero(np.abs(inner) <= doubt)
        if open_.size:
            exact = signs(corners[:, :, open_], direction[:, open_])
            met[open_] = ((exact >= 0).all(axis=0) | (exact <= 0).all(axis=0)) & exact.any(axis=0)
        self._meet(rays, Open(some.which[met], some.vertices[:, met], some.pixel[met]), found)

    def _meet(self, rays: SearchRays, met: Open, found: Nearest) -> None:
        """Keep the hits on triangles that are known to be hit, one per pixel."""
        t = crossing(self.meshes.places(met.vertices), *rays.at(met.pixel))
        self._keep(rays, found, met.pixel, t, met.which)

    def _keep(self, rays: SearchRays, found: Nearest, pixel: np.ndarray, t: np.ndarray, which: np.ndarray) -> None:
        """Keep hits at or beyond the clip start, on points that are not transparent."""
        met = (t >= self.clip_start) & (t < np.inf)
        if self.cutouts is not None:
            met &= t <= taken(found.t.reshape(-1), pixel)
            met[met] = self._is_hit(self.cutouts, rays, found, pixel[met], t[met], which[met])
        if not met.all():
            pixel, t, which = pixel[met], t[met], which[met]
        found.keep(pixel, t, which)

    def _is_hit(self, cutouts: Cutouts, rays: SearchRays, found: Nearest, pixel, t, which) -> np.ndarray:
        """Return which crossings with triangles, (m,), are hits: all but those with transparent points."""
        own, triangle = np.unique(which, return_inverse=True)
        at, number = self.meshes.blocks.numbers(found.entry(own))
        is_hit = np.ones(len(pixel), bool)
        some = np.flatnonzero(cutouts.may[at][triangle])
        if some.size:
            origin, direction = rays.at(pixel[some])
            point = direction * t[some] if origin is None else origin + direction * t[some]
            hit = HitTriangles(cutouts.shapes, triangle[some], at, number, origin is None).only(slice(None))
            pixels = crossings(at[triangle[some]], t[some], origin is None, **{TRIANGLES: hit})
            is_hit[some] = cutouts.hit(pixels, point)
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
