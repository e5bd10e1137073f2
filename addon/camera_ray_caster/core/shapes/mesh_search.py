"""The nearest triangle of every ray of a tile: many triangles are tested at once, in spans of rows or ray by ray."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from .. import tuning
from ..maths.speed import lazy, taken
from ..maths.vector import cross, cut, difference, dot, norm
from .kind import Candidates, PixelBounds, ShapeSet
from .mesh_found import SEEN, Found, SeenTriangles
from .mesh_in_camera import MeshesInView, Triangles
from .mesh_spans import Lattice, spans
from .search_rays import SearchRays
from .triangles import EDGES, ROUNDING, STEEP, crossing, plane, signs, volumes
from .windows import Windows, banded, batches, in_tile, pixels_in, union

Reach = tuple[float, float]
"""Upper bounds of the lengths of the directions and of the origins of a tile's rays."""


@dataclass(frozen=True, eq=False)
class MeshSet(ShapeSet):
    """The meshes that a camera may see. ``rest`` stores the triangle of each pixel in the scratch."""

    meshes: MeshesInView
    clip_start: float
    pixels: PixelBounds | None = None
    """The columns and rows of the picture that are searched; None for all."""
    faces_eye = True

    def at(self, pixels: PixelBounds) -> MeshSet:
        """Return the same set for some columns and rows of the picture."""
        return replace(self, pixels=pixels)

    @lazy
    def triangles(self) -> Triangles:
        """The triangles that some pixel may see."""
        whole = self.meshes.triangles
        return whole if self.pixels is None else replace(whole, bounds=self.pixels.within(whole.bounds))

    def rest(self, rays: SearchRays, nearest: np.ndarray) -> Iterator[Candidates | None]:
        """See ``ShapeSet``."""
        for _ in self.meshes.prepare():
            yield None
        triangles = self.triangles
        here, bounds = in_tile(triangles.bounds, rays.corner, rays.shape)
        if not here.size:
            return
        window = union(bounds)
        whole, rays = rays, rays.within(window)
        first_row, first_column = (own.start for own in window)
        bounds -= np.array([first_column, first_column, first_row, first_row], bounds.dtype)
        found = Found.of(nearest[window], rays, len(triangles.shape))
        lattice = Lattice.of(rays)
        reach = _longest(rays.direction), _longest(rays.origin or (0.0,))
        near = triangles.near.take(here)
        for slab in _slabs(near, bounds, found.t.size):
            slab = slab.take(found.may_show(bounds.take(slab, axis=0), near.take(slab)))
            own = here.take(slab), bounds.take(slab, axis=0).astype(np.intp)
            if lattice is not None:
                steps = self._in_spans(rays, lattice, reach, *own, found)
            else:
                steps = self._in_windows(rays, reach, *own, found)
            for _ in steps:
                yield None
        seen, of_pixel = found.seen()
        if not seen.size:
            return
        whole.scratch(SEEN, whole.shape, np.int32)[window] = of_pixel
        noted = SeenTriangles(triangles.shape[seen], triangles.number[seen])
        whole.scratch.noted[SEEN] = noted
        corner = np.array([first_row]), np.array([first_column])
        met = found.which != found.count
        yield Candidates(noted.at.take(of_pixel)[None], corner, found.t[None], met[None])

    def _in_spans(self, rays, lattice: Lattice, reach: Reach, here, bounds, found: Found) -> Iterator[None]:
        """Keep the hits of a lattice of rays on triangles, in small steps."""
        at, bands = banded(bounds, tuning.SPANNED_PIXELS)
        rest = []
        for some in _pieces(bands, tuning.SPANNED_PIXELS):
            rest.append(self._span(rays, lattice, reach, here[at[some]], bands[some], found))
            yield
        self._test(rays, rest, found)

    def _in_windows(self, rays, reach: Reach, here, bounds, found: Found) -> Iterator[None]:
        """Keep the hits of any rays on triangles, in small steps: large triangles one by one."""
        is_large = pixels_in(bounds) >= tuning.SMALL_PIXELS
        at, bands = banded(bounds[is_large], tuning.BLOCK_PIXELS)
        rest = []
        for one, band in zip(here[is_large][at].tolist(), bands.tolist(), strict=True):
            rest.append(self._fill(rays, reach, one, band, found))
            yield
        self._test(rays, rest, found)
        yield from self._in_pixels(rays, reach, here[~is_large], bounds[~is_large], found)

    def _fill(self, rays: SearchRays, reach: Reach, which: int, bounds: list[int], found: Found):
        """Keep the hits on one triangle in a window of the tile. Return the pixels in which it still has to be tested,
        preceded by its index once for each of them.
        """
        x0, x1, y0, y1 = bounds
        window = slice(y0, y1), slice(x0, x1)
        corners: Any
        meets, corners = self.meshes.facing(np.array([which]))
        if not meets.size:
            return meets, meets
        corners = corners[..., None]
        direction = tuple(cut(component, window) for component in rays.direction)
        doubt = _doubt(corners, reach).item()
        if rays.origin is not None:
            corners = [difference(corner, tuple(cut(part, window) for part in rays.origin)) for corner in corners]
        inner = _inside(volumes(corners, direction), rays.origin is None)
        normal, product = plane(corners)
        slope = dot(normal, direction)
        t = dot(normal, corners[0]) / slope
        poor = np.abs(slope) <= STEEP * product * reach[0]
        met = (inner > doubt) & (t >= self.clip_start) & (t < np.inf)
        open_ = (np.abs(inner) <= doubt) | (poor & (inner > doubt)) if poor.any() else np.abs(inner) <= doubt
        met &= ~open_
        found.fill(window, met, t, which)
        row, column = np.nonzero(np.broadcast_to(open_, inner.shape))
        return np.full(len(row), which), (y0 + row) * rays.shape[1] + x0 + column

    def _span(
        self, rays: SearchRays, lattice: Lattice, reach: Reach, here: np.ndarray, bounds: np.ndarray, found: Found
    ) -> tuple[np.ndarray, np.ndarray]:
        """Keep the hits on triangles in spans, and ray by ray on triangles without spans. Return triangles that still
        have to be tested, and the pixels in which to test them.
        """
        meets, corners = self.meshes.facing(here)
        here, bounds = here[meets], bounds[meets]
        seen = spans(lattice, corners, bounds, rays.shape[1])
        at, pixel = seen.met
        self._keep(found, pixel, seen.t, taken(here, at))
        if not seen.clear.all():
            others = np.flatnonzero(~seen.clear)
            for _ in self._in_pixels(rays, reach, here[others], bounds[others], found):
                pass
        at, pixel = seen.open
        return here[at], pixel

    def _in_pixels(self, rays: SearchRays, reach: Reach, here, bounds, found: Found) -> Iterator[None]:
        """Keep the hits on triangles that are tested pixel by pixel, in small steps."""
        for some in _pieces(bounds, tuning.TRACED_PIXELS) if rays.origin is None else batches(bounds):
            meets, corners = self.meshes.facing(here[some])
            if meets.size:
                cast = self._from_eye if rays.origin is None else self._from_anywhere
                cast(rays, corners, _doubt(corners, reach), here[some][meets], bounds[some][meets], found)
            yield

    def _from_eye(self, rays: SearchRays, corners, doubt, here, bounds, found: Found) -> None:
        """Keep the hits of rays from the eye in triangles' bounds: all rays share the planes through eye and edges."""
        pixel, k = rays.present.within(bounds)
        _, direction = rays.at(pixel)
        normals = (np.array(cross(corners[i], corners[j])) for i, j in EDGES)
        inner = _inside(tuple(dot(taken(normal, k), direction) for normal in normals), is_turned=True)
        self._decide(rays, inner, taken(doubt, k), here[k], pixel, found)

    def _from_anywhere(self, rays: SearchRays, corners, doubt, here, bounds, found: Found) -> None:
        """Keep the hits of rays with many origins, in windows: by moments, without corners relative to each origin."""
        windows = Windows.around(bounds, rays.shape)
        direction, moment = (tuple(map(windows.flat, parts)) for parts in (rays.direction, rays.moment))
        inner = _inside(volumes(corners, direction, moment), is_turned=False)
        near = np.flatnonzero(inner >= -doubt)
        k = near % len(here)
        self._decide(rays, inner.reshape(-1)[near], doubt[k], here[k], windows.pixel.reshape(-1)[near], found)

    def _decide(self, rays: SearchRays, inner, doubt, which, pixel, found: Found) -> None:
        """Keep the hits on triangles, one per pixel, given how far inside the rays are and the error bound of that."""
        is_open, is_met = np.abs(inner) <= doubt, inner > doubt
        self._test(rays, [(which[is_open], pixel[is_open])], found)
        which, pixel = which[is_met], pixel[is_met]
        self._keep(found, pixel, crossing(*self._meeting(rays, which, pixel)), which)

    def _test(self, rays: SearchRays, rest: list[tuple[np.ndarray, np.ndarray]], found: Found) -> None:
        """Keep the hits among lists of triangles and the pixels in which to test them, by exact signs where rounding
        could decide. All lists are tested at once, since one computation of exact signs takes a millisecond.
        """
        if not any(len(which) for which, _ in rest):
            return
        which, pixel = (np.concatenate(part) for part in zip(*rest, strict=True))
        corners, direction = self._meeting(rays, which, pixel)
        doubt = ROUNDING * np.maximum.reduce([norm(corner) for corner in corners]) ** 2 * norm(direction)
        inner = _inside(volumes(corners, direction), is_turned=False)
        met = inner > doubt
        open_ = np.flatnonzero(np.abs(inner) <= doubt)
        if open_.size:
            exact = signs(corners[:, :, open_], direction[:, open_])
            met[open_] = ((exact >= 0).all(axis=0) | (exact <= 0).all(axis=0)) & exact.any(axis=0)
        self._keep(found, pixel[met], crossing(corners[:, :, met], direction[:, met]), which[met])

    def _keep(self, found: Found, pixel: np.ndarray, t: np.ndarray, which: np.ndarray) -> None:
        """Keep hits at or beyond the clip start."""
        met = (t >= self.clip_start) & (t < np.inf)
        if not met.all():
            pixel, t, which = pixel[met], t[met], which[met]
        found.keep(pixel, t, which)

    def _meeting(self, rays: SearchRays, which: np.ndarray, pixel: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return corners relative to the rays' origins (3, 3, m) and directions (3, m), one triangle per pixel."""
        corners, (origin, direction) = self.meshes.corners(which), rays.at(pixel)
        return corners if origin is None else corners - origin, direction


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
    return ROUNDING * reach[0] * (longest + reach[1]) ** 2


def _longest(vectors: Any) -> float:
    """Return an upper bound of the lengths of vectors, from components that broadcast; NaN is ignored."""
    return math.sqrt(sum(float(np.fmax.reduce(np.square(component), axis=None, initial=0.0)) for component in vectors))


def _slabs(near: np.ndarray, bounds: np.ndarray, pixels: int) -> Iterator[np.ndarray]:
    """Yield triangles in parts of about the same number, those with the least t first. The number of parts grows with
    their work compared with the pixels of their tile, since the tile's farthest t are computed before each part.
    """
    x0, x1, y0, y1 = bounds.T
    work = tuning.TRIANGLE_PIXELS * len(near) + np.multiply(x1 - x0, y1 - y0, dtype=float).sum()
    count = max(1, round(tuning.SLABS * math.sqrt(work / (pixels + tuning.SLAB_PIXELS))))
    cuts = np.quantile(near[:: max(1, len(near) >> 12)], np.arange(1, count) / count)
    slab = np.searchsorted(cuts, near)
    for k in range(count):
        yield np.flatnonzero(slab == k)


def _pieces(bounds: np.ndarray, most: int) -> Iterator[slice]:
    """Yield slices of at most SPANNED triangles, which end once their bounds have more than ``most`` pixels."""
    pixels = np.cumsum(pixels_in(bounds))
    first = 0
    while first < len(bounds):
        end = min(first + tuning.SPANNED, int(np.searchsorted(pixels, pixels[first] + most)) + 1)
        yield slice(first, end)
        first = end
