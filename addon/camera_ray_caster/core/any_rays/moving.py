"""Rays with times of their own: shapes that stand still are searched once for all rays, others for the rays near them.

A ray is near a shape if it meets the ball around the shape's center, at the ray's time, that holds the shape, and the
box around it in its own axes. Of shapes that only move, turn, stretch and bend each of these rays has one of its own,
see ``own_times``. For others, which change their looks, rays are grouped by their times, and each group meets the
shapes as they are then. The hits are those of a cast at the time of the ray.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..maths.exact import invert
from ..maths.speed import Scratch, memoized
from ..motion.apart import BY_SHAPE, bends, centers_at, light_changes, mesh_of, moving, of_rows, place_at, rows_of
from ..motion.evaluations import Motion
from ..motion.interpolation import PLACE
from ..records import MESH, PLANE, SPHERE, Shapes
from ..shapes.in_camera import in_camera
from .balls import may_meet, unit_directions
from .body_search import RAYS, BodySearch, search_of
from .forms import BOX_MARGIN, Form
from .own_times import OwnTimes, RowsPlaced
from .ray_bodies import WORLD, RayBodies, RayHits, Span

BALL_FACTOR = 1.25
"""Factor by which balls are enlarged around shapes that change in size or form: between evaluations they may be larger.
"""

FLAT_OR_ROUND = {SPHERE: ((-1.0, -1.0, -1.0), (1.0, 1.0, 1.0)), PLANE: ((-1.0, -1.0, 0.0), (1.0, 1.0, 0.0))}
"""Corners of the boxes of exact shapes in their own axes."""

CENTERS = 1 << 20
"""Number of centers of shapes that are computed at once: it bounds the memory. Not tuned."""


@dataclass(frozen=True, eq=False)
class Moving:
    """The shapes of a scene, divided into those that stand still and those that move."""

    still: Shapes
    still_rows: np.ndarray
    """Rows of ``still`` in all shapes; ``rows`` are those of the shapes that move."""
    rows: np.ndarray
    motion: Motion
    light: bool
    """Whether lights or the background change."""
    alike: np.ndarray
    """(m,) bool: which shapes look alike at all times; these are placed anew for each ray."""
    forms: dict[int, Form]
    """By row, the shapes of ``alike`` whose meshes bend."""
    changing: Motion
    """The motion of the shapes that are not ``alike``."""
    radius: np.ndarray
    """(m,): the radii of the balls around their centers."""
    boxes: dict[int, np.ndarray]
    """By row, the lowest and the highest corner of a shape's box in its own axes, (2, 3); not all shapes have one."""


@memoized
def moving_of(shapes: Shapes) -> Moving | None:
    """Return the shapes, divided; None if they have no motion that tells which of them move."""
    motion = shapes.motion
    if not isinstance(motion, Motion):
        return None
    moves, changes = moving(motion), moving(motion, but=PLACE)
    looks, meshes = moving(motion, but=(*PLACE, "meshes")), moving(motion, but={*BY_SHAPE} - {"mesh"})
    if moves is None or changes is None or looks is None or meshes is None:
        return None
    still, rows = np.flatnonzero(~moves), np.flatnonzero(moves)
    moved, unlike = of_rows(motion, rows), changes[rows]
    states = [shapes for _, shapes in moved.states.values()]
    bent = [row for row in np.flatnonzero(unlike & ~looks[rows]).tolist()
            if bends([mesh_of(shapes, row) for shapes in states])]  # fmt: skip
    unlike[bent] = False
    first, light = next(iter(motion.states.values()))[1], light_changes(motion)
    at_rest, changing = rows_of(first, still), of_rows(moved, np.flatnonzero(unlike))
    forms = {row: Form(moved, row) for row in bent}
    radius, boxes = _radius(moved), _boxes(moved, forms, meshes[rows])
    return Moving(at_rest, still, rows, moved, light, ~unlike, forms, changing, radius, boxes)


def _radius(motion: Motion) -> np.ndarray:
    every = []
    for _, shapes in motion.states.values():
        placed = in_camera(shapes, WORLD)
        every.append(np.linalg.norm(placed.center - shapes.center, axis=1) + placed.radius)
    radii = np.array(every)
    changes = radii.min(axis=0) < (1 - 1e-6) * radii.max(axis=0)
    return radii.max(axis=0) * np.where(changes, BALL_FACTOR, 1 + 1e-6)


def _boxes(motion: Motion, forms: dict[int, Form], changes: np.ndarray) -> dict[int, np.ndarray]:
    """Return the boxes of shapes; ``changes`` marks those whose mesh changes with time."""
    first, boxes = next(iter(motion.states.values()))[1], {}
    for row, kind in enumerate(first.kind.tolist()):
        if kind in FLAT_OR_ROUND:
            boxes[row] = np.array(FLAT_OR_ROUND[kind])
            continue
        if kind == MESH and not changes[row]:
            mesh = mesh_of(first, row)
            boxes[row] = np.array((mesh.vertices.min(axis=1), mesh.vertices.max(axis=1))) - mesh.middle
    boxes |= {row: form.box.copy() for row, form in forms.items()}
    for corners in boxes.values():
        corners += np.array((-1, 1))[:, None] * BOX_MARGIN * np.abs(corners).max()
    return boxes


@dataclass(frozen=True, eq=False)
class HitGroup:
    """Hits of rays on some bodies."""

    bodies: RayBodies
    hits: RayHits
    row: np.ndarray
    """(m,): the shapes that are hit."""
    number: np.ndarray
    """(m,): their triangles."""

    @classmethod
    def of(cls, bodies: RayBodies, hits: RayHits, rays: np.ndarray, rows: np.ndarray) -> HitGroup:
        """Return the hits of a part of the rays on bodies of a part of the shapes, by the numbers of these."""
        every = RayHits(rays[hits.ray], hits.t, hits.body)
        return cls(bodies, every, rows[bodies.at[hits.body]], bodies.number[hits.body])


def may_share(shapes: Shapes, times: np.ndarray | None, passes: tuple[str, ...]) -> bool:
    """Whether threads may share rays with these times, (n,): not those that meet other shapes at each time, which would
    be made by each thread.
    """
    return times is None or _apart(shapes, times, passes) is not None


def write_nearest(
    shapes: Shapes, origin: np.ndarray, direction: np.ndarray, times: np.ndarray | None, span: Span, images
) -> None:
    """Write the passes of the nearest hits of rays (3, n), with times (n,) if shapes move, into images of one row."""
    apart = _apart(shapes, times, tuple(images))
    if apart is not None and times is not None:
        _cast_apart(apart, origin, direction, times, span, images)
        return
    for then, of_time in _at_times(shapes, times):
        search = search_of(then)
        rays = origin[:, of_time], direction[:, of_time]
        search.write(*rays, *search.nearest(*rays, *span), images, np.arange(origin.shape[1])[of_time])


def hit_groups(
    shapes: Shapes, origin, direction, times: np.ndarray | None, span: Span, passes: tuple[str, ...] = ()
) -> Iterator[HitGroup]:
    """Yield all hits of rays (3, n) at their times (n,), in groups."""
    apart = _apart(shapes, times, passes)
    if apart is not None and times is not None:
        yield from _all_apart(apart, origin, direction, times, span)
        return
    rays = np.arange(origin.shape[1])
    for then, of_time in _at_times(shapes, times):
        search = search_of(then)
        hits = search.all(origin[:, of_time], direction[:, of_time], *span)
        yield HitGroup.of(search, hits, rays[of_time], np.arange(len(then)))


def _apart(shapes: Shapes, times: np.ndarray | None, passes: tuple[str, ...] = ()) -> Moving | None:
    """Return the shapes, divided, if that is how rays with these times are cast; else None."""
    apart = moving_of(shapes) if times is not None and len(times) else None
    return None if apart is not None and apart.light and "combined" in passes else apart


def _at_times(shapes: Shapes, times: np.ndarray | None) -> Iterator[tuple[Shapes, Any]]:
    """Yield the shapes at each time, and the indices of the rays of that time."""
    if times is None or not len(times):
        yield shapes, slice(None)
        return
    for time in np.unique(times).tolist():
        yield shapes.at(time), np.flatnonzero(times == time)


def _cast_apart(apart: Moving, origin, direction, times: np.ndarray, span: Span, images) -> None:
    for first in range(0, len(times), RAYS):
        chunk = slice(first, first + RAYS)
        in_chunk = {name: image[:, chunk] for name, image in images.items()}
        _cast_some(apart, origin[:, chunk], direction[:, chunk], times[chunk], span, in_chunk)


def _all_apart(apart: Moving, origin, direction, times: np.ndarray, span: Span) -> Iterator[HitGroup]:
    search = search_of(apart.still)
    for first in range(0, len(times), RAYS):
        chunk = slice(first, first + RAYS)
        rays, in_chunk = np.arange(len(times))[chunk], (origin[:, chunk], direction[:, chunk])
        yield HitGroup.of(search, search.all(*in_chunk, *span), rays, apart.still_rows)
        for group in _groups(apart, *in_chunk, times[chunk], span, every=True):
            hits = group.hits
            yield replace(group, hits=RayHits(rays[hits.ray], hits.t, hits.body))


def _cast_some(apart: Moving, origin, direction, times: np.ndarray, span: Span, images) -> None:
    search = search_of(apart.still)
    t, body = search.nearest(origin, direction, *span)
    search.write(origin, direction, t, body, images, np.arange(len(t)))
    row = np.append(apart.still_rows, -1)[np.append(search.at, -1)[body]]
    for group in _groups(apart, origin, direction, times, span, every=False):
        before = t[group.hits.ray]
        closer = (group.hits.t < before) | ((group.hits.t == before) & (group.row < row[group.hits.ray]))
        hits = group.hits.only(closer)
        t[hits.ray], row[hits.ray] = hits.t, group.row[closer]
        of_hits = origin[:, hits.ray], direction[:, hits.ray]
        group.bodies.write(*of_hits, hits.t, hits.body, images, hits.ray)
    if "shape_index" in images:
        images["shape_index"][0] = row


def _groups(apart: Moving, origin, direction, times: np.ndarray, span: Span, every: bool) -> Iterator[HitGroup]:
    """Yield the hits of rays on what moves: all, or of each ray the nearest of each group."""
    near = list(_near(apart, origin, direction, times))
    shapes, groups = next(iter(apart.motion.states.values()))[1], []
    for placed, near_rays in near:
        row = int(placed.row[0])
        if apart.alike[row]:
            rays = origin[:, near_rays], direction[:, near_rays]
            per_ray = OwnTimes(placed.shapes(shapes), apart.forms.get(row), *rays, times[near_rays])
            hits = per_ray.all(span) if every else per_ray.nearest(span)
            groups.append((placed.only(hits.ray), RayHits(near_rays[hits.ray], hits.t, hits.body)))
    if groups:
        placed, hits = RowsPlaced.joined([placed for placed, _ in groups]), RayHits.joined([hits for _, hits in groups])
        if not every:
            order = np.lexsort((placed.row, hits.t, hits.ray))
            best = order[np.flatnonzero(np.diff(hits.ray[order], prepend=-1))]
            placed, hits = placed.only(best), hits.only(best)
        parts = placed.parts(shapes, apart.forms, hits.body, times[hits.ray])
        body = np.arange(len(hits.ray))
        yield HitGroup(parts, RayHits(hits.ray, hits.t, body), apart.rows[placed.row], hits.body)
    for time, near_rays in _by_time([rays for placed, rays in near if not apart.alike[placed.row[0]]], times):
        search = BodySearch(apart.changing.shapes_at(time), len(near_rays))
        rays = origin[:, near_rays], direction[:, near_rays]
        hits = search.all(*rays, *span) if every else RayHits.of(*search.nearest(*rays, *span))
        yield HitGroup.of(search, hits, near_rays, apart.rows[~apart.alike])


def _near(apart: Moving, origin, direction, times: np.ndarray) -> Iterator[tuple[RowsPlaced, np.ndarray]]:
    """Yield each shape that moves, at the times of the rays that may meet it, and these rays, of which there are some.
    """
    scratch, step = Scratch(), max(1, CENTERS // len(times))
    with np.errstate(all="ignore"):  # NaN is no ray
        ahead = unit_directions(direction)
        for first in range(0, len(apart.rows), step):
            centers = centers_at(apart.motion, slice(first, first + step), times)
            for row, center in enumerate(centers, first):
                near = np.flatnonzero(may_meet(center.T, apart.radius[row], origin, ahead, scratch))
                near = near[~np.isnan(direction[0, near])]
                center, axes = place_at(apart.motion, row, times[near])
                if row in apart.boxes and near.size:
                    to = center.T - origin[:, near]
                    meets = _meets_box(axes, to, ahead[:, near], apart.boxes[row])
                    near, center, axes = near[meets], center[meets], axes[meets]
                if near.size:
                    yield RowsPlaced(np.full(len(near), row), center, axes), near


def _by_time(near: list[np.ndarray], times: np.ndarray) -> Iterator[tuple[float, np.ndarray]]:
    """Yield times, and the rays of that time that occur in ``near``."""
    rays = np.unique(np.concatenate([*near, np.zeros(0, np.intp)]))
    rays = rays[np.argsort(times[rays], kind="stable")]
    starts = np.flatnonzero(np.diff(times[rays], prepend=-np.inf))
    for of_time in np.split(rays, starts[1:]):
        if len(of_time):
            yield float(times[of_time[0]]), of_time


def _meets_box(axes: np.ndarray, to: np.ndarray, ahead: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Return whether rays, given the ways to the middles of boxes and directions, (3, n), meet the boxes ahead."""
    inwards, _, skewness = invert(axes)
    if not (skewness < 1 / BOX_MARGIN).all():
        return np.ones(len(axes), bool)  # a flat mesh
    start, way = (np.einsum("nij,jn->in", inwards, vector) for vector in (-to, ahead))
    ends = (corners[:, :, None] - start) / way
    enter, leave = np.fmin(*ends).max(axis=0), np.fmax(*ends).min(axis=0)
    return ~((enter > leave) | (leave < 0))
