"""Rays with times of their own: shapes that stand still are searched once for all rays, others for the rays near them.

A ray is near a shape if it meets the ball around the shape's center, at the ray's time, that holds the shape. Only
these rays are grouped by their times, and each group meets the shapes where they are then: the hits are those of a cast
at that time.
"""

from __future__ import annotations

from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np

from ..motion.apart import centers_at, moving, of_rows, rows_of
from ..motion.evaluations import Motion
from ..records import Shapes
from ..shapes.in_camera import in_camera
from .search import WORLD, BodySearch
from .written import Span, write

MARGIN = 1.25
"""Factor by which balls are enlarged around shapes that change in size or form: between evaluations they may be larger.
"""


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
            _known[shapes] = Moving(rows_of(first, still), still, rows, own, _radius(own))
    return _known[shapes]


def _radius(motion: Motion) -> np.ndarray:
    every = []
    for _, shapes in motion.states.values():
        placed = in_camera(shapes, WORLD)
        every.append(np.linalg.norm(placed.center - shapes.center, axis=1) + placed.radius)
    radii = np.array(every)
    changes = np.ptp(radii, axis=0) > 1e-6 * radii.max(axis=0)
    return radii.max(axis=0) * np.where(changes, MARGIN, 1 + 1e-6)


def cast_apart(apart: Moving, search: BodySearch, origin, direction, times: np.ndarray, span: Span, images) -> None:
    """Write the passes of rays (3, n) with times (n,) into images with one row; ``search``: of what stands still."""
    count = np.arange(origin.shape[1])
    t, body = search.nearest(origin, direction, *span)
    write(search, origin, direction, t, body, images, count, span)
    row = np.append(apart.still_rows, -1)[np.append(search.at, -1)[body]]
    for time, some in _near(apart, origin, direction, times):
        own = BodySearch(apart.motion.shapes_at(time))
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
        for center, radius in zip(centers_at(apart.motion, times), apart.radius, strict=True):
            to = center.T - origin
            along = np.maximum((to * ahead).sum(axis=0), 0.0)
            near |= ~(((to - along * ahead) ** 2).sum(axis=0) > radius * radius)
        near &= ~np.isnan(direction[0])
    some = np.flatnonzero(near)
    some = some[np.argsort(times[some], kind="stable")]
    starts = np.flatnonzero(np.diff(times[some], prepend=-np.inf))
    for part in np.split(some, starts[1:]):
        if len(part):
            yield float(times[part[0]]), part
