"""Rays with times of their own: shapes that stand still are searched once for all rays, others for the rays near them.

A ray is near a shape if it meets the ball around the shape's center, at the ray's time, that holds the shape, and the
box around it in its own axes. Of shapes that only move, turn and stretch each of these rays has one of its own, see
``own_times``. For others, which deform or change their looks, rays are grouped by their times, and each group meets the
shapes as they are then. The hits are those of a cast at the time of the ray.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np

from ..maths.speed import Scratch
from ..motion.apart import centers_at, light_changes, moving, of_rows, place_at, rows_of
from ..motion.evaluations import Motion
from ..motion.interpolation import PLACE
from ..motion.means import same
from ..records import MESH, PLANE, SPHERE, Shapes
from ..shapes.in_camera import in_camera, invert
from .balls import may_meet, unit_directions
from .own_times import SLACK, FoundParts, RowsPlaced, nearest
from .search import RAYS, WORLD, BodySearch
from .written import Span, write

MARGIN = 1.25
"""Factor by which balls are enlarged around shapes that change in size or form: between evaluations they may be larger.
"""

CENTERS = 1 << 20
"""Number of centers of shapes that are computed at once: it bounds the memory. Not tuned."""

FLAT_OR_ROUND = {SPHERE: ((-1.0, -1.0, -1.0), (1.0, 1.0, 1.0)), PLANE: ((-1.0, -1.0, 0.0), (1.0, 1.0, 0.0))}
"""Corners of the boxes of exact shapes in their own axes."""


@dataclass(frozen=True, eq=False)
class Moving:
    """The shapes of a scene, divided into those that stand still and those that move."""

    still: Shapes
    still_rows: np.ndarray
    """Their rows in all shapes; in ``rows`` those of the others."""
    rows: np.ndarray
    motion: Motion
    light: bool
    """Whether lights or the background change."""
    rigid: np.ndarray
    """(m,) bool: which only move, turn and stretch: one of their own for each ray."""
    changing: Motion
    """The motion of those that are not ``rigid``."""
    radius: np.ndarray
    """(m,): the radii of the balls around their centers."""
    boxes: dict[int, np.ndarray]
    """(2, 3): the lowest and the highest corner in its own axes, of each that has one and does not deform."""


_known: WeakKeyDictionary[Shapes, Moving | None] = WeakKeyDictionary()


def moving_of(shapes: Shapes) -> Moving | None:
    """Return the shapes, divided; None if they have no motion that tells which of them move."""
    if shapes not in _known:
        motion = shapes.timeline.motion
        _known[shapes] = _divided(motion) if isinstance(motion, Motion) else None
    return _known[shapes]


def _divided(motion: Motion) -> Moving | None:
    moves, changes = moving(motion), moving(motion, but=PLACE)
    if moves is None or changes is None:
        return None
    still, rows = np.flatnonzero(~moves), np.flatnonzero(moves)
    own, rigid = of_rows(motion, rows), ~changes[rows]
    first = next(iter(motion.states.values()))[1]
    return Moving(
        rows_of(first, still), still, rows, own, light_changes(motion), rigid, of_rows(own, np.flatnonzero(~rigid)),
        _radius(own), _boxes(own),
    )  # fmt: skip


def _radius(motion: Motion) -> np.ndarray:
    every = []
    for _, shapes in motion.states.values():
        placed = in_camera(shapes, WORLD)
        every.append(np.linalg.norm(placed.center - shapes.center, axis=1) + placed.radius)
    radii = np.array(every)
    changes = radii.min(axis=0) < (1 - 1e-6) * radii.max(axis=0)
    return radii.max(axis=0) * np.where(changes, MARGIN, 1 + 1e-6)


def _boxes(motion: Motion) -> dict[int, np.ndarray]:
    every = [shapes for _, shapes in motion.states.values()]
    first, found = every[0], {}
    for row, kind in enumerate(first.kind.tolist()):
        if kind in FLAT_OR_ROUND:
            found[row] = np.array(FLAT_OR_ROUND[kind])
            continue
        mesh = first.meshes[first.mesh[row]] if kind == MESH else None
        if mesh is not None and all(same(mesh, other.meshes[first.mesh[row]]) for other in every):
            found[row] = np.array((mesh.vertices.min(axis=1), mesh.vertices.max(axis=1))) - mesh.middle
    for corners in found.values():
        corners += np.array((-1, 1))[:, None] * SLACK * np.abs(corners).max()
    return found


def _meets_box(axes: np.ndarray, to: np.ndarray, ahead: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Return whether rays, given the ways to the middles of boxes and directions, (3, n), meet the boxes ahead."""
    inwards, _, skewness = invert(axes)
    if not (skewness < 1 / SLACK).all():
        return np.ones(len(axes), bool)  # a flat mesh
    start, way = (np.einsum("nij,jn->in", inwards, vector) for vector in (-to, ahead))
    ends = (corners[:, :, None] - start) / way
    enter, leave = np.fmin(*ends).max(axis=0), np.fmax(*ends).min(axis=0)
    return ~((enter > leave) | (leave < 0))


def cast_apart(apart: Moving, search: BodySearch, origin, direction, times: np.ndarray, span: Span, images) -> None:
    """Write the passes of rays (3, n) with times (n,) into images with one row; ``search``: of what stands still."""
    for first in range(0, len(times), RAYS):
        some = slice(first, first + RAYS)
        part = {name: image[:, some] for name, image in images.items()}
        _cast_some(apart, search, origin[:, some], direction[:, some], times[some], span, part)


def _cast_some(apart: Moving, search: BodySearch, origin, direction, times: np.ndarray, span: Span, images) -> None:
    t, body = search.nearest(origin, direction, *span)
    write(search, origin, direction, t, body, images, np.arange(len(t)), span)
    row = np.append(apart.still_rows, -1)[np.append(search.at, -1)[body]]
    near = list(_near(apart, origin, direction, times))
    _meet_rigid(apart, near, origin, direction, span, t, row, images)
    for time, some in _by_time([rays for place, rays in near if not apart.rigid[place.row[0]]], times):
        own = BodySearch(apart.changing.shapes_at(time), len(some))
        rays = origin[:, some], direction[:, some]
        own_t, which = own.nearest(*rays, *span)
        rows = np.append(apart.rows[~apart.rigid], -1)[np.append(own.at, -1)[which]]
        closer = (own_t < t[some]) | ((own_t == t[some]) & (rows < row[some]))
        part = some[closer]
        t[part], row[part] = own_t[closer], rows[closer]
        write(own, rays[0][:, closer], rays[1][:, closer], own_t[closer], which[closer], images, part, span)
    if "shape_index" in images:
        images["shape_index"][0] = row


def _near(apart: Moving, origin, direction, times: np.ndarray) -> Iterator[tuple[RowsPlaced, np.ndarray]]:
    """Yield each shape that moves, at the times of the rays that may meet it, and these rays, of which there are some.
    """
    scratch, step = Scratch(), max(1, CENTERS // len(times))
    with np.errstate(all="ignore"):  # NaN is no ray
        ahead = unit_directions(direction)
        for first in range(0, len(apart.rows), step):
            centers = centers_at(apart.motion, slice(first, first + step), times)
            for row, center in enumerate(centers, first):
                some = np.flatnonzero(may_meet(center.T, apart.radius[row], origin, ahead, scratch))
                some = some[~np.isnan(direction[0, some])]
                center, axes = place_at(apart.motion, row, times[some])
                if row in apart.boxes and some.size:
                    to = center.T - origin[:, some]
                    meets = _meets_box(axes, to, ahead[:, some], apart.boxes[row])
                    some, center, axes = some[meets], center[meets], axes[meets]
                if some.size:
                    yield RowsPlaced(np.full(len(some), row), center, axes), some


def _meet_rigid(apart: Moving, near, origin, direction, span: Span, t, row, images) -> None:
    """Write the hits on rigid shapes, and their t and rows, where they are the nearest."""
    shapes = next(iter(apart.motion.states.values()))[1]
    number = np.full(len(t), -1)
    best = RowsPlaced(np.zeros(len(t), np.intp), np.empty((len(t), 3)), np.empty((len(t), 3, 3)))
    for place, some in near:
        own = int(place.row[0])
        if not apart.rigid[own]:
            continue
        own_t, part = nearest(place.shapes(shapes), origin[:, some], direction[:, some], span)
        closer = (own_t < t[some]) | ((own_t == t[some]) & (apart.rows[own] < row[some]))
        rays = some[closer]
        t[rays], row[rays], number[rays] = own_t[closer], apart.rows[own], part[closer]
        best.row[rays], best.center[rays], best.axes[rays] = own, place.center[closer], place.axes[closer]
    hit = np.flatnonzero(number >= 0)
    if hit.size:
        found = FoundParts(RowsPlaced(best.row[hit], best.center[hit], best.axes[hit]).shapes(shapes), number[hit])
        write(found, origin[:, hit], direction[:, hit], t[hit], np.arange(len(hit)), images, hit, span)


def _by_time(near: list[np.ndarray], times: np.ndarray) -> Iterator[tuple[float, np.ndarray]]:
    """Yield times, and the rays of that time that occur in ``near``."""
    some = np.unique(np.concatenate([*near, np.zeros(0, np.intp)]))
    some = some[np.argsort(times[some], kind="stable")]
    starts = np.flatnonzero(np.diff(times[some], prepend=-np.inf))
    for part in np.split(some, starts[1:]):
        if len(part):
            yield float(times[part[0]]), part
