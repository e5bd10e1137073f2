"""Rays with times of their own: shapes that stand still are searched once for all rays, others for the rays near them.

A ray is near a shape if it meets the ball around the shape's center, at the ray's time, that holds the shape, and the
box around it in its own axes. Only these rays are grouped by their times, and each group meets the shapes where they
are then: the hits are those of a cast at that time.
"""

from __future__ import annotations

from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np

from ..motion.apart import axes_at, centers_at, moving, of_rows, rows_of
from ..motion.evaluations import Motion
from ..records import MESH, PLANE, SPHERE, Shapes
from ..shapes.in_camera import in_camera
from .search import WORLD, BodySearch
from .written import Span, write

MARGIN = 1.25
"""Factor by which balls are enlarged around shapes that change in size or form: between evaluations they may be larger.
"""
SLACK = 1e-6
"""Fraction by which boxes are enlarged: far more than rounding."""

FLAT_OR_ROUND = {SPHERE: ((-1.0, -1.0, -1.0), (1.0, 1.0, 1.0)), PLANE: ((-1.0, -1.0, 0.0), (1.0, 1.0, 0.0))}
"""Corners of the boxes of exact shapes in their own axes."""


@dataclass(frozen=True, eq=False)
class Moving:
    """Shapes that move apart from those that do not."""

    still: Shapes
    still_rows: np.ndarray
    """Their rows in all shapes; in ``rows`` those of the others."""
    rows: np.ndarray
    motion: Motion
    radius: np.ndarray
    """(m,): the radii of the balls around their centers."""
    boxes: dict[int, np.ndarray]
    """(2, 3): the lowest and the highest corner in its own axes, of each that has one and does not deform."""


_known: WeakKeyDictionary[Shapes, Moving | None] = WeakKeyDictionary()


def moving_of(shapes: Shapes) -> Moving | None:
    """Return the shapes that move apart; None if their motion does not tell."""
    if shapes not in _known:
        motion = shapes.motion
        moves = moving(motion) if isinstance(motion, Motion) else None
        if moves is None or not isinstance(motion, Motion):
            _known[shapes] = None
        else:
            first = next(iter(motion.states.values()))[1]
            still, rows = np.flatnonzero(~moves), np.flatnonzero(moves)
            own = of_rows(motion, rows)
            _known[shapes] = Moving(rows_of(first, still), still, rows, own, _radius(own), _boxes(own))
    return _known[shapes]


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
        elif kind == MESH and all(other.meshes[first.mesh[row]] is first.meshes[first.mesh[row]] for other in every):
            mesh = first.meshes[first.mesh[row]]
            found[row] = np.array((mesh.vertices.min(axis=1), mesh.vertices.max(axis=1))) - mesh.middle
    for corners in found.values():
        corners += np.array((-1, 1))[:, None] * SLACK * np.abs(corners).max()
    return found


def _meets_box(axes: np.ndarray, to: np.ndarray, ahead: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Return whether rays, given the ways to the middles of boxes and directions, (3, n), meet the boxes ahead."""
    size = np.linalg.norm(axes, axis=(1, 2))
    if not (np.abs(np.linalg.det(axes)) > SLACK * size**3).all():
        return np.ones(len(axes), bool)  # a flat mesh
    inwards = np.linalg.inv(axes)
    start, way = (np.einsum("nij,jn->in", inwards, vector) for vector in (-to, ahead))
    ends = (corners[:, :, None] - start) / way
    enter, leave = np.fmin(*ends).max(axis=0), np.fmax(*ends).min(axis=0)
    return ~((enter > leave) | (leave < 0))


def cast_apart(apart: Moving, search: BodySearch, origin, direction, times: np.ndarray, span: Span, images) -> None:
    """Write the passes of rays (3, n) with times (n,) into images with one row; ``search``: of what stands still."""
    count = np.arange(origin.shape[1])
    t, body = search.nearest(origin, direction, *span)
    write(search, origin, direction, t, body, images, count, span)
    row = np.append(apart.still_rows, -1)[np.append(search.at, -1)[body]]
    for time, some in _near(apart, origin, direction, times):
        own = BodySearch(apart.motion.shapes_at(time), len(some))
        rays = origin[:, some], direction[:, some]
        met, which = own.nearest(*rays, *span)
        rows = np.append(apart.rows, -1)[np.append(own.at, -1)[which]]
        closer = (met < t[some]) | ((met == t[some]) & (rows < row[some]))
        part = some[closer]
        t[part], row[part] = met[closer], rows[closer]
        write(own, rays[0][:, closer], rays[1][:, closer], met[closer], which[closer], images, part, span)
    if "shape_index" in images:
        images["shape_index"][0] = row


def _near(apart: Moving, origin, direction, times: np.ndarray):
    """Yield times, and the indices of the rays of that time that may meet what moves."""
    near = np.zeros(len(times), bool)
    with np.errstate(all="ignore"):  # NaN is no ray
        ahead = direction / np.sqrt((direction * direction).sum(axis=0))
        for row, (center, radius) in enumerate(zip(centers_at(apart.motion, times), apart.radius, strict=True)):
            to = center.T - origin
            along = np.maximum((to * ahead).sum(axis=0), 0.0)
            some = np.flatnonzero(~(((to - along * ahead) ** 2).sum(axis=0) > radius * radius))
            if row in apart.boxes and some.size:
                axes = axes_at(apart.motion, row, times[some])
                some = some[_meets_box(axes, to[:, some], ahead[:, some], apart.boxes[row])]
            near[some] = True
        near &= ~np.isnan(direction[0])
    some = np.flatnonzero(near)
    some = some[np.argsort(times[some], kind="stable")]
    starts = np.flatnonzero(np.diff(times[some], prepend=-np.inf))
    for part in np.split(some, starts[1:]):
        if len(part):
            yield float(times[part[0]]), part
