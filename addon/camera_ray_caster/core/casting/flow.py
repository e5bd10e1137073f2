"""Optical flow: the motion of the seen surface points in the picture, to the next or previous frame, for any camera.

The surface point that a pixel's chief ray hits moves with its shape, or with its triangle if a mesh deforms, and the
camera of the other frame sees the point at other pixel coordinates. The flow is the difference of the two coordinates,
other minus own, in pixels, x to the right and y up. It is NaN where nothing is hit (a background has no points), where
the shape is not in the other frame (see ``motion.matching``), and where the point is outside of the other full frame.
Across the seam of a panorama the flow leads from one edge of the picture to the other. For a camera that sees a point
more than once, such as from a path or with both eyes in one picture, the flow leads to the pixel that a search from the
own pixel finds.
Blender's Vector pass, which only Blender's own cameras have, is the backward flow in X and Y and the negative forward
flow in Z and W; its background is 0.
The other frames are ``next`` and ``previous`` of the scene: its neighbors from ``read_scene``, or any other scene that
``Scene.with_timeline`` sets, such as the other eye of a stereo pair.

The error of the flow is at most ``Flow.error``, that of the point in the world, times the derivative of the projection,
plus that of the model's inverse, at most 1e-9 pixels. With pixel times the point is that of the shapes at the pixel's
own time, and it is seen at the other pixel's own time: see ``camera.meeting``.
"""

from __future__ import annotations

import numpy as np

from ..conventions import gamma
from ..maths.speed import lazy, taken
from ..maths.vector import norm
from ..motion.matching import rows_in
from ..records import Shapes
from ..shapes.kind import HitPixels, Kind
from ..shapes.surface_points import Moved
from .hit_values import HitValues
from .seen_points import Picture

NEXT, PREVIOUS = "next", "previous"
"""The names of the neighboring frames: those of the attributes of ``Scene``."""


def flow_of(values: HitValues, name: str) -> Flow:
    """Return the flow of a block of hits to the NEXT or the PREVIOUS frame, computed once per block."""
    if name not in values.flows:
        values.flows[name] = Flow(values, values.target.request.others[name])
    return values.flows[name]


class Flow:
    """The surface points that a block of pixels sees, and their pixels in another frame's picture."""

    def __init__(self, values: HitValues, picture: Picture):
        self._values, self._picture = values, picture
        parts = values.by_kind(self._of_kind)
        self._follow = [follow for _, (_, follow, _) in parts]
        self._ends = np.cumsum([0, *(len(pixels.at) for _, (pixels, _, _) in parts)])
        self._at = np.concatenate([np.zeros(0, int), *(pixels.at for _, (pixels, _, _) in parts)])
        self._place = np.concatenate([np.zeros(0, int), *(pixels.places for _, (pixels, _, _) in parts)])
        self._points = np.concatenate([np.zeros((3, 0)), *(point for _, (_, _, point) in parts)], axis=1)
        self._points += values.target.pose.eye[:, None]
        self._last: tuple[Shapes, np.ndarray] | None = None
        self._known: tuple[np.ndarray, Moved] | None = None

    def at(self, shapes: Shapes, indices: np.ndarray) -> np.ndarray:
        return (taken(self._points, indices) + self._moved(shapes, indices).by).T

    def error(self, shapes: Shapes, indices: np.ndarray) -> np.ndarray:
        moved, points = self._moved(shapes, indices), taken(self._points, indices)
        return self._own_error(indices) * (1 + moved.spread) + moved.error + gamma(2) * (norm(points) + norm(moved.by))

    @lazy
    def pixels(self) -> np.ndarray:
        """The pixel coordinates (m, 2) at which the points are seen."""
        pixels = self._picture.pixels(self, len(self._at), self._own)
        camera, other = self._values.hits.rays.of_camera, self._picture.camera
        if camera.model.central or other.pixel_time is not None:
            return pixels
        back = camera.project(self._points.T)
        several = np.flatnonzero(~(np.abs(back - self._own).max(axis=1) <= 1.0))
        near = self._picture.pixels_from(self.at(self._picture.shapes, several), self._own[several])
        pixels[several] = np.where(np.isnan(near), pixels[several], near)
        return pixels

    @lazy
    def _every(self) -> np.ndarray:
        """The indices of all points."""
        return np.arange(len(self._at))

    @lazy
    def _own(self) -> np.ndarray:
        """The coordinates (m, 2) of the pixels themselves."""
        rays, shape = self._values.hits.rays, self._values.hits.t.shape
        coordinates = [np.broadcast_to(coordinate, shape).reshape(-1)[self._place] for coordinate in (rays.x, rays.y)]
        return np.stack(coordinates, axis=1)

    def write(self, out: np.ndarray) -> None:
        """Write the flow, (rows, columns, 2)."""
        flow = np.full((self._values.hits.t.size, 2), np.nan)
        flow[self._place] = self.pixels - self._own
        out[...] = flow.reshape(out.shape)

    def write_hidden(self, out: np.ndarray) -> None:
        """Write whether something hides the points, or they are outside of the clip range, (rows, columns)."""
        hidden = np.zeros(out.size, bool)
        seen = ~np.isnan(self.pixels[:, 0])
        places = np.divmod(self._place, out.shape[1])
        hidden[self._place[seen]] = self._picture.before(self, self.pixels, places)[seen] != 0
        out[...] = hidden.reshape(out.shape)

    def _of_kind(self, kind: Kind, pixels: HitPixels):
        point = pixels.of(self._values.point)
        return pixels, kind.follow(self._values.target.placed, pixels, point), np.array(point)

    def _own_error(self, indices: np.ndarray) -> np.ndarray:
        """Return the error bounds of some of the points where they are hit."""
        where, error = np.zeros(self._values.hits.t.shape, bool), np.zeros(self._values.hits.t.shape)
        where.reshape(-1)[self._place[indices]] = True
        for of_kind, errors in self._values.errors_at(where):
            error[of_kind] = errors.position
        return error.reshape(-1)[self._place[indices]]

    def _moved(self, shapes: Shapes, indices: np.ndarray) -> Moved:
        """Return how some of the points have moved; NaN if their shape is not in ``shapes``."""
        if self._last is None or self._last[0] is not shapes:
            self._last, self._known = (shapes, rows_in(self._values.target.shapes, shapes)), None
        if self._picture.camera.pixel_time is None and indices is not self._every:  # all are asked for first
            moved = self._moved(shapes, self._every)
            in_order = np.array_equal(indices, self._every)
            return moved if in_order else Moved(*(values.take(indices, -1) for values in moved))
        if self._known is None or self._known[0] is not indices:  # ``at`` and ``error`` are called in turn
            self._known = indices, self._move(shapes, self._last[1], indices)
        return self._known[1]

    def _move(self, shapes: Shapes, rows: np.ndarray, indices: np.ndarray) -> Moved:
        is_there = rows[self._at[indices]] >= 0
        if len(self._follow) == 1 and is_there.all():
            return self._follow[0](shapes, rows, indices)
        moved = Moved(np.full((3, len(indices)), np.nan), *np.full((2, len(indices)), np.nan))
        for follow, first, end in zip(self._follow, self._ends, self._ends[1:], strict=False):
            mine = np.flatnonzero(is_there & (indices >= first) & (indices < end))
            if mine.size:
                for values, new in zip(moved, follow(shapes, rows, indices[mine] - first), strict=True):
                    values[..., mine] = new
        return moved
