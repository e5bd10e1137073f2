"""Optical flow: where what pixels see is seen at the next or the previous frame, of any camera.

The surface point that a pixel's chief ray hits moves with its shape, or with its triangle where a mesh changes its
form, and the camera of the other frame sees it at other pixel coordinates. The flow is these less the pixel's own, in
pixels, x to the right and y up. It is NaN where nothing is hit (a background has no points), where the shape is not in
the other frame (see ``motion.matching``), and where the point is not in its full frame. Across the seam of a panorama
it leads from one edge of the picture to the other.
Blender's Vector pass, which only Blender's own cameras have, is the backward flow in X and Y and the forward flow, its
sign turned, in Z and W; its background is 0.
``camera.next``, ``shapes.next`` and ``previous`` are the other frames: the scene's neighbors as ``read_scene`` reads
them, or whatever else is put there, such as the other eye of a stereo pair.

The flow is right to ``Flow.error``, that of the point in the world, times the derivative of the projection, and to the
model's inverse, 1e-9 pixel at most. With pixel times the point is where the shapes are at the pixel's own time, and it
is seen at the other pixel's own time: see ``camera.meeting``.
"""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from ..camera.camera import Camera
from ..conventions import gamma
from ..maths.speed import lazy
from ..maths.vector import norm
from ..motion.matching import rows_in
from ..records import InputError, Shapes
from ..shapes.follow import Moved
from ..shapes.kind import HitPixels, Kind
from .hit_values import HitValues
from .pictures import Picture

NEXT, PREVIOUS = "next", "previous"

FRAMES = {"flow_forward": (NEXT,), "flow_backward": (PREVIOUS,), "flow_hidden": (NEXT, PREVIOUS)}
"""The other frames that passes look into, by the passes' names."""


def frames_of(passes: Collection[str]) -> set[str]:
    """Return the other frames that passes look into, NEXT and PREVIOUS."""
    return {name for key, names in FRAMES.items() if key in passes for name in names}


def pictures(camera: Camera, shapes: Shapes, passes: Collection[str]) -> dict[str, Picture]:
    """Return the pictures that passes look into, by name. Raises InputError for those that were not read."""
    found = {}
    for name in sorted(frames_of(passes)):
        there = getattr(camera, name), getattr(shapes, name)
        if None in there:
            raise InputError(
                f"passes {', '.join(key for key in passes if name in FRAMES.get(key, ()))} look into the {name} frame, "
                "which was not read: read camera and shapes with read_scene(scene, passes=...)"
            )
        found[name] = Picture(*there)
        if "flow_hidden" in passes:
            found[name].prepare()
    return found


def flow_of(values: HitValues, name: str) -> Flow:
    """Return the flow of a block of hits to the NEXT or the PREVIOUS frame, made once."""
    if name not in values.flows:
        values.flows[name] = Flow(values, values.plan.request.others[name])
    return values.flows[name]


class Flow:
    """The surface points that a block of pixels sees, and where they are seen in another frame's picture."""

    def __init__(self, values: HitValues, picture: Picture):
        self._values, self._picture = values, picture
        parts = values.by_kind(self._of_kind)
        self._follow = [follow for _, (_, follow, _) in parts]
        self._ends = np.cumsum([0, *(len(pixels.at) for _, (pixels, _, _) in parts)])
        self._at = np.concatenate([np.zeros(0, int), *(pixels.at for _, (pixels, _, _) in parts)])
        self._place = np.concatenate([np.zeros(0, int), *(pixels.places for _, (pixels, _, _) in parts)])
        self._points = np.concatenate([np.zeros((3, 0)), *(point for _, (_, _, point) in parts)], axis=1)
        self._points += values.plan.camera.pose.eye[:, None]
        self._last: tuple[Shapes, np.ndarray] | None = None

    def at(self, shapes: Shapes, some: np.ndarray) -> np.ndarray:
        """See ``pictures.Points``."""
        return self._points[:, some].T + self._moved(shapes, some).by.T

    def error(self, shapes: Shapes, some: np.ndarray) -> np.ndarray:
        """See ``pictures.Points``."""
        moved, points = self._moved(shapes, some), self._points[:, some]
        return self._own_error[some] * (1 + moved.spread) + moved.error + gamma(2) * (norm(points) + norm(moved.by))

    @lazy
    def pixels(self) -> np.ndarray:
        """The pixel coordinates (m, 2) at which the points are seen."""
        return self._picture.pixels(self, len(self._at))

    def write(self, out: np.ndarray) -> None:
        """Write the flow, (rows, columns, 2)."""
        rays, shape = self._values.hits.rays, out.shape[:2]
        here = [np.broadcast_to(part, shape).reshape(-1)[self._place] for part in (rays.x, rays.y)]
        flow = np.full((shape[0] * shape[1], 2), np.nan)
        flow[self._place] = self.pixels - np.stack(here, axis=1)
        out[...] = flow.reshape(*shape, 2)

    def write_hidden(self, out: np.ndarray) -> None:
        """Write where something is before the points, or they are beyond the clip range, (rows, columns)."""
        hidden = np.zeros(out.size, bool)
        seen = ~np.isnan(self.pixels[:, 0])
        hidden[self._place[seen]] = self._picture.before(self, self.pixels)[seen] != 0
        out[...] = hidden.reshape(out.shape)

    def _of_kind(self, kind: Kind, pixels: HitPixels):
        point = pixels.of(self._values.point)
        return pixels, kind.follow(self._values.plan.in_camera, pixels, point), np.array(point)

    @lazy
    def _own_error(self) -> np.ndarray:
        """How wrong the points are at most as they are hit, (m,)."""
        return np.concatenate([np.zeros(0), *(errors.position for _, errors in self._values.errors)])

    def _moved(self, shapes: Shapes, some: np.ndarray) -> Moved:
        """Return how some of the points have moved; NaN where their shape is not there."""
        if self._last is None or self._last[0] is not shapes:
            self._last = shapes, rows_in(self._values.plan.shapes, shapes)
        rows = self._last[1]
        moved = Moved(np.full((3, len(some)), np.nan), *np.full((2, len(some)), np.nan))
        is_there = rows[self._at[some]] >= 0
        for follow, first, end in zip(self._follow, self._ends, self._ends[1:], strict=False):
            mine = np.flatnonzero(is_there & (some >= first) & (some < end))
            if mine.size:
                for values, new in zip(moved, follow(shapes, rows, some[mine] - first), strict=True):
                    values[..., mine] = new
        return moved
