"""Rays aimed at points, anywhere between the pixel centers: whether something is in front of the points."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np

from ..camera.camera import Camera
from ..conventions import gamma
from ..errors.hit_errors import HitErrors
from ..errors.ray_errors import world_rays
from ..maths.speed import Scratch
from ..maths.vector import components, difference, inverse, matvec, norm
from ..records import Shapes
from ..shapes.shape_frames import WorldRays
from .hit_values import HitValues
from .plan import Plan, make_plan
from .rays import TileRays
from .request import Request
from .search import nearest_hits

POINTS = 1 << 16
"""Number of points processed at once. 2**15: 1.1 to 1.3 times the time of ``flow_hidden``."""

CELLS = 1 << 19
"""Approximate number of places in a lattice of rays; most places have no ray if the points are sparse."""

LAYERS = 1
"""Maximum number of rays per pixel in the first lattice; the other rays of fuller pixels go to lattices of twice as
many. With 2 or 4, which repeat most rows for a few pixels, ``flow_hidden`` takes 1.1 to 1.5 times as long.
"""


def aiming_plan(camera: Camera, shapes: Shapes) -> Plan:
    """Return the plan for chief rays anywhere in the full frame of a camera, at one moment."""
    raster = replace(camera.raster, x0=0, y0=0, x1=camera.raster.width, y1=camera.raster.height)
    camera = replace(camera, raster=raster, aperture=None, pixel_time=None)
    return make_plan(camera, shapes, Request((), (), sampled=True))


def is_before(plan: Plan, pixels: np.ndarray, points: np.ndarray, error: np.ndarray) -> np.ndarray:
    """Return whether something is in front of world points (n, 3) that the camera of an aiming plan sees at pixels
    (n, 2) of its frame, (n,): 1 if so, 0 if not, -1 if the point is nearer or farther than the clip range.

    The ray of each pixel is turned to its point. A hit is in front of the point if it is nearer by more than the error
    bounds of both. The bound of the point is ``error`` (n,), world units. The bound of the hit allows for a ray that
    misses the exact point by ``error`` and rounding. The surface on which a point lies is thus never in front of it,
    even if the ray grazes the surface.
    """
    before = np.empty(len(points), np.int8)
    with np.errstate(all="ignore"):  # NaN and inf mean no ray and no hit
        for first in range(0, len(points), POINTS):
            chunk = slice(first, first + POINTS)
            aim = _Aim(plan, pixels[chunk], points[chunk], error[chunk])
            before[chunk] = aim.answer()
    return before


class _Aim:
    """Points and the rays to them, in the camera's frame; (3, n) and (n,) arrays."""

    def __init__(self, plan: Plan, pixels: np.ndarray, points: np.ndarray, error: np.ndarray):
        camera, self.plan = plan.camera, plan
        basis = camera.pose.basis
        self.pixels = pixels
        x, y = pixels.T
        rays = world_rays(camera, x, y)
        camera_from_world = inverse(basis)
        local = matvec(camera_from_world, components(points - camera.pose.eye))
        origin, direction = camera.camera_rays(x, y)
        self.origin, towards = _whole(origin, len(x)), np.array(difference(local, origin))
        distance = norm(matvec(basis, towards))
        self.t = -towards[2] if camera.model.planar else distance
        self.direction = towards / self.t
        if camera.model.parallel:  # parallel rays keep their direction
            self.direction = _whole(direction, len(x))
            self.origin = np.array(local) - self.t * self.direction
        self.length = norm(matvec(basis, self.direction))
        size = norm(matvec(basis, self.origin)) + norm(components(points - camera.pose.eye))
        self.origin_error = rays.origin_error + gamma(8) * size * bool(camera.model.parallel)
        beside = error + self.origin_error + gamma(16) * camera.stretch * size
        self.direction_error = beside / self.t + gamma(16) * camera.stretch * self.length
        self.t_error = beside * np.sqrt((camera_from_world * camera_from_world).sum())

    def answer(self) -> np.ndarray:
        """Return the result of ``is_before`` for the points."""
        camera = self.plan.camera
        answer = np.zeros(len(self.t), np.int8)
        for indices, columns, rows, cells in _lattices(self.pixels, camera.raster.size):
            answer[indices] = self._front(indices, columns, rows, cells) < self.t[indices] - self.t_error[indices]
        answer[~((self.t >= camera.clip_start) & (self.t <= camera.clip_end))] = -1
        return answer

    def _front(self, indices: np.ndarray, columns: np.ndarray, rows: np.ndarray, cells: tuple) -> np.ndarray:
        """Return upper bounds of the t of the hits in front of points, (k,); inf where nothing is in front."""
        shape = len(rows), len(columns)

        def laid(values, empty=np.nan):
            values = np.broadcast_to(values, (*np.shape(values)[:-1], len(self.t)))
            lattice = np.full((*values.shape[:-1], *shape), empty)
            lattice[(..., *cells)] = values[..., indices]
            return lattice

        camera, plan = self.plan.camera, self.plan.at_pixels(columns, rows)
        from_eye = camera.from_eye(sampled=False)
        origin, direction = laid(self.origin, 0.0), laid(self.direction)
        rays = TileRays(
            columns[None] + 0.5, rows[:, None] + 0.5, (0, 0), from_eye, (0.0,) * 3 if from_eye else tuple(origin),
            tuple(direction), Scratch(), camera,
        )  # fmt: skip
        in_world = WorldRays(
            matvec(camera.pose.basis, rays.origin), matvec(camera.pose.basis, direction), laid(self.length),
            laid(self.origin_error) if np.ndim(self.origin_error) else self.origin_error, laid(self.direction_error),
        )  # fmt: skip
        hits = nearest_hits(plan, rays, before=laid(self.t - self.t_error, -np.inf))
        front = np.full(shape, np.inf)
        values = HitValues(hits)
        for where, errors in values.by_kind(
            lambda kind, pixels: HitErrors(plan.target.placed, kind, pixels, in_world.only(pixels.of), True)
        ):
            front[where] = errors.t + errors.t_error
        return front[cells]


def _whole(vector, count: int) -> np.ndarray:
    """Return components that broadcast as (3, n)."""
    return np.array([np.broadcast_to(component, (count,)) for component in vector])


def _lattices(pixels: np.ndarray, size: tuple[int, int]) -> Iterator[tuple]:
    """Yield (points, columns, rows, places) for lattices of rays: the indices (k,) of points, the columns (c,) and rows
    (r,) of pixels, and the places of the points in the lattice, (k,) rows and columns. Each point has a place of its
    own: rows are repeated for points that share a pixel.
    """
    column, row = (np.minimum(np.floor(x).astype(int), side - 1) for x, side in zip(pixels.T, size, strict=True))
    order = np.lexsort((column, row))
    is_new = np.append(True, (np.diff(column[order]) != 0) | (np.diff(row[order]) != 0))
    first = np.flatnonzero(is_new)
    layer = np.empty(len(order), int)
    layer[order] = np.arange(len(order)) - np.repeat(first, np.diff(np.append(first, len(order))))
    start, end = 0, LAYERS
    while (indices := np.flatnonzero((layer >= start) & (layer < end))).size:
        columns, at_column = np.unique(column[indices], return_inverse=True)
        rows, at_row = np.unique(row[indices], return_inverse=True)
        repeats = np.zeros(len(rows), int)
        np.maximum.at(repeats, at_row, layer[indices] - start + 1)
        begin = np.cumsum(repeats) - repeats
        band = begin // max(1, CELLS // len(columns))
        for low, high in pairwise([*np.unique(band, return_index=True)[1].tolist(), len(rows)]):
            in_band = np.flatnonzero((at_row >= low) & (at_row < high))
            cells = begin[at_row[in_band]] - begin[low] + layer[indices[in_band]] - start, at_column[in_band]
            yield indices[in_band], columns, np.repeat(rows[low:high], repeats[low:high]), cells
        start, end = end, 2 * end + LAYERS
