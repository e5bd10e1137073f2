"""Rays aimed at points, anywhere between the pixel centers: whether something is in front of the points."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from ..camera.camera import Camera
from ..conventions import gamma
from ..errors.hit_errors import HitErrors
from ..errors.ray_errors import world_rays
from ..maths.speed import Scratch, taken
from ..maths.vector import components, difference, inverse, matvec, norm
from ..records import Shapes
from ..shapes.kind import HitPixels, Kind
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

TOGETHER = 1 << 12
"""Maximum number of points in a lattice of those that share their pixels with others. With 2**10 and 2**14
``flow_hidden`` takes as long.
"""

NARROW = 64
"""Largest mean width, in pixels, of the places where points of a row or a column are seen, for which the points keep
their rows and columns. Up to a mean of 40 the cast with ``flow_hidden`` takes 0.5 to 0.75 times as long as by pixels;
of 50 to 90 in a camera that rolls 0.95 to 1.05 times.
"""

Error = Callable[[np.ndarray], np.ndarray]
"""Given the indices of some points, (m,), returns their error bounds, (m,)."""


def aiming_plan(camera: Camera, shapes: Shapes) -> Plan:
    """Return the plan for chief rays anywhere in the full frame of a camera, at one moment."""
    raster = replace(camera.raster, x0=0, y0=0, x1=camera.raster.width, y1=camera.raster.height)
    camera = replace(camera, raster=raster, aperture=None, pixel_time=None)
    return make_plan(camera, shapes, Request((), sampled=True))


def is_before(
    plan: Plan, pixels: np.ndarray, points: np.ndarray, error: Error, places: tuple[np.ndarray, np.ndarray] | None
) -> np.ndarray:
    """Return whether something is in front of world points (n, 3) that the camera of an aiming plan sees at pixels
    (n, 2) of its frame, (n,): 1 if so, 0 if not, -1 if the point is nearer or farther than the clip range.

    The ray of each pixel is turned to its point. A hit is in front of the point if it is nearer by more than the error
    bounds of both. The bounds of points are those of ``error``, world units. The bound of the hit allows for a ray that
    misses the exact point by that and rounding. The surface on which a point lies is thus never in front of it, even
    if the ray grazes the surface. ``places``: rows and columns of the points in a picture in which neighbors are mostly
    neighbors here, (n,) each; None if there is no such picture.
    """
    before = np.empty(len(points), np.int8)
    with np.errstate(all="ignore"):  # NaN and inf mean no ray and no hit
        for first in range(0, len(points), POINTS):
            chunk = slice(first, first + POINTS)
            there = None if places is None else (places[0][chunk], places[1][chunk])
            aim = _Aim(plan, pixels[chunk], points[chunk], partial(lambda first, at: error(first + at), first), there)
            before[chunk] = aim.answer()
    return before


class _Aim:
    """Points and the rays to them, in the camera's frame; (3, n) and (n,) arrays."""

    def __init__(self, plan: Plan, pixels: np.ndarray, points: np.ndarray, error: Error, places):
        camera, self.plan = plan.camera, plan
        basis = camera.pose.basis
        self.pixels, self.places, self._error = pixels, places, error
        self.from_eye = camera.from_eye(sampled=False)
        self.origin: Any = (0.0,) * 3
        if not self.from_eye:
            x, y = pixels.T
            origin, direction = camera.camera_rays(x, y)
            self.origin = _whole(origin, len(x))
        camera_from_world = inverse(basis)
        local = matvec(camera_from_world, components(points - camera.pose.eye))
        towards = np.array(difference(local, self.origin))
        distance = norm(matvec(basis, towards))
        self.t = -towards[2] if camera.model.planar else distance
        self.direction = towards / self.t
        if camera.model.parallel:  # parallel rays keep their direction
            self.direction = _whole(direction, len(x))
            self.origin = np.array(local) - self.t * self.direction
        self.size = norm(matvec(basis, self.origin)) + norm(components(points - camera.pose.eye))
        self.enlarged = float(np.sqrt((camera_from_world * camera_from_world).sum()))
        self.limit = self.t - self.enlarged * gamma(16) * camera.stretch * self.size

    def answer(self) -> np.ndarray:
        """Return the result of ``is_before`` for the points."""
        camera = self.plan.camera
        answer = np.zeros(len(self.t), np.int8)
        for lattice in _lattices(self.pixels, camera.raster.size, self.places):
            for at, errors, t_error in self._hits(*lattice):
                answer[at] = errors.t + errors.t_error < self.t[at] - t_error
        answer[~((self.t >= camera.clip_start) & (self.t <= camera.clip_end))] = -1
        return answer

    def _hits(
        self, indices: np.ndarray, columns: np.ndarray, rows: np.ndarray, cells: tuple
    ) -> list[tuple[np.ndarray, HitErrors, np.ndarray]]:
        """Return, kind by kind, those of some points whose rays hit something before the least bound of their error,
        (m,), the bounds of these hits, and those of t of the points, (m,). The bounds are computed for these only.
        """
        shape = rows.shape[-1], columns.shape[-1]

        def laid(values, empty=np.nan):
            lattice = np.full((*values.shape[:-1], *shape), empty)
            lattice[(..., *cells)] = values[..., indices]
            return lattice

        camera, plan = self.plan.camera, self.plan.at_pixels(columns, rows)
        x, y = (np.atleast_2d(places)[0] + 0.5 for places in (columns, rows))
        rays = TileRays(
            x[None], y[:, None], (0, 0), self.from_eye, self.origin if self.from_eye else tuple(laid(self.origin, 0.0)),
            tuple(laid(self.direction)), Scratch(), camera,
        )  # fmt: skip
        hits = nearest_hits(plan, rays, before=laid(self.limit, -np.inf))
        of_cell = np.zeros(shape, np.intp)
        of_cell[cells] = indices

        def bounded(kind: Kind, pixels: HitPixels) -> tuple[np.ndarray, HitErrors, np.ndarray]:
            at = of_cell[pixels.where]
            in_world, t_error = self._bounded(at)
            return at, HitErrors(plan.target.placed, kind, pixels, in_world, True), t_error

        return [bound for _, bound in HitValues(hits).by_kind(bounded)]

    def _bounded(self, at: np.ndarray) -> tuple[WorldRays, np.ndarray]:
        """Return the rays to some of the points, (m,) indices, and the error bounds of the points' t."""
        camera, size = self.plan.camera, self.size[at]
        origin, origin_error = self.origin, np.zeros(len(at))
        if not self.from_eye:
            origin, origin_error = self.origin[:, at], world_rays(camera, *self.pixels[at].T).origin_error
        origin_error = origin_error + gamma(8) * size * bool(camera.model.parallel)
        beside = self._error(at) + origin_error + gamma(16) * camera.stretch * size
        ahead = matvec(camera.pose.basis, self.direction[:, at])
        length = norm(ahead)
        direction_error = beside / self.t[at] + gamma(16) * camera.stretch * length
        rays = WorldRays(matvec(camera.pose.basis, origin), ahead, length, origin_error, direction_error)
        return rays, beside * self.enlarged


def _whole(vector, count: int) -> np.ndarray:
    """Return components that broadcast as (3, n)."""
    return np.array([np.broadcast_to(component, (count,)) for component in vector])


def _lattices(pixels: np.ndarray, size: tuple[int, int], places: Any) -> Iterator[tuple]:
    """Yield (points, columns, rows, places) for lattices of rays: the indices (k,) of points, the columns and rows of
    ``Plan.at_pixels``, and the places of the points in the lattice, (k,) rows and columns. Each point has a place of
    its own: that of ``places``, see ``is_before``, if rows and columns there are narrow here; or the first of each
    pixel in lattices of pixels, the others as in ``_crowded``.
    """
    column, row = (np.minimum(np.floor(x).astype(int), side - 1) for x, side in zip(pixels.T, size, strict=True))
    if places is not None and len(pixels):
        (own_rows, at_row), (own_columns, at_column) = map(_ranked, places)
        columns, rows = _ends(column, at_column, len(own_columns)), _ends(row, at_row, len(own_rows))
        if max(np.ptp(ends, axis=0).mean() for ends in (columns, rows)) <= NARROW:
            yield np.arange(len(pixels)), columns, rows, (at_row, at_column)
            return
    pixel = row * size[0] + column
    order = np.argsort(pixel, kind="stable")
    is_first = np.append(True, np.diff(pixel[order]) != 0)
    first, others = order[is_first], order[~is_first]
    (columns, at_column), (rows, at_row) = (_ranked(taken(places, first)) for places in (column, row))
    step = max(1, CELLS // len(columns))
    for low in range(0, len(rows), step):
        band = slice(*np.searchsorted(at_row, (low, low + step)))
        yield first[band], columns, rows[low : low + step], (at_row[band] - low, at_column[band])
    for low in range(0, len(others), TOGETHER):
        yield _crowded(others[low : low + TOGETHER], column, row)


def _ranked(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the distinct numbers >= 0 among some, ascending, and the rank of each."""
    is_there = np.bincount(values) > 0
    return np.flatnonzero(is_there), taken(np.cumsum(is_there) - 1, values)


def _crowded(points: np.ndarray, column: np.ndarray, row: np.ndarray) -> tuple:
    """Return a full lattice of points in any pixels: equally many in each of its columns, which follow each other in
    the picture; in each column the points follow each other by rows.
    """
    count, wide, high = len(points), np.ptp(column[points]) + 1, np.ptp(row[points]) + 1
    across = int(np.clip(np.sqrt(count * wide / high), 1, count))
    points = points[np.argsort(column[points], kind="stable")]
    group = np.arange(count) * across // count
    begin = np.searchsorted(group, np.arange(across))
    end = np.append(begin[1:], count)
    columns = column[points[[begin, end - 1]]]
    points = points[np.lexsort((row[points], group))]
    rank = np.arange(count) - begin[group]
    return points, columns, _ends(row[points], rank, int(rank.max()) + 1), (rank, group)


def _ends(pixels: np.ndarray, places: np.ndarray, count: int) -> np.ndarray:
    """Return the first and the last pixel on an axis at each of some places, (2, count), ascending."""
    ends = np.array([np.full(count, pixels.max()), np.zeros(count, int)])
    np.minimum.at(ends[0], places, pixels)
    np.maximum.at(ends[1], places, pixels)
    return np.array([np.minimum.accumulate(ends[0, ::-1])[::-1], np.maximum.accumulate(ends[1])])
