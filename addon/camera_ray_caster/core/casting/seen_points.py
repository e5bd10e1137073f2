"""The pixels at which points that may move are seen in a picture, and whether something hides the points there."""

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any, Protocol

import numpy as np

from ..camera.camera import Camera
from ..camera.meeting import meeting
from ..cameras.parts.inverse import pixels_of
from ..maths.vector import inverse
from ..records import Shapes
from .aimed import aiming_plan, is_before
from .plan import Plan

SHAPES = 1 << 21
"""Number of shapes, over all moments, whose states are cached: some 200 MB."""

PLANS = 16
"""Number of cached plans of moments: the pixels of a tile are seen in few rows of the other frame."""


class MovingPoints(Protocol):
    """Points that may move with shapes."""

    def at(self, shapes: Shapes, indices: np.ndarray) -> np.ndarray:
        """Return the points of ``indices``, (k,), at the moment of the shapes, (k, 3) world; NaN if missing."""

    def error(self, shapes: Shapes, indices: np.ndarray) -> np.ndarray:
        """Return the error bounds of these points, (k,)."""


class Picture:
    """A camera and shapes in whose picture points are looked for; its plan is made once."""

    def __init__(self, camera: Camera, shapes: Shapes):
        self.camera, self.shapes = camera, shapes
        self._states: dict[float, tuple[Camera, Shapes]] = {}
        self._plans: dict[float | None, Plan] = {}

    def prepare(self) -> None:
        """Make the plan of a picture with one time, for ``before``, before threads share the picture."""
        if self.camera.pixel_time is None:
            self._plan(None)

    def pixels(self, points: MovingPoints, count: int, beside: np.ndarray | None = None) -> np.ndarray:
        """Return the pixel coordinates (count, 2) at which points are seen, each at the pixel's own time; NaN for
        points not seen in the full frame. ``beside``: pixels (count, 2); with pixel times the search begins near their
        mean time, so that of several pixels that see a point one near that time is found.
        """
        clock, motion = self.camera.pixel_time, self.camera.motion
        if clock is None:
            seen_at = self._project(points, None, np.arange(count))
        else:
            around = float(np.mean(clock.frame_at(*beside.T))) if beside is not None and count else None
            cuts = () if motion is None else motion.cuts
            seen_at = meeting(clock, partial(self._project, points), count, cuts, around)
        return np.where(self._is_inside(seen_at)[:, None], seen_at, np.nan)

    def pixels_from(self, points: np.ndarray, start: np.ndarray) -> np.ndarray:
        """Return the pixel coordinates (n, 2) of world points (n, 3) that a search from the pixels ``start`` (n, 2)
        finds; NaN if it finds none in the full frame. For cameras that see a point more than once.
        """
        pose, model = self.camera.pose, self.camera.model
        seen_at = pixels_of(model.rays, model.size, (points - pose.eye) @ inverse(pose.basis).T, start)
        return np.where(self._is_inside(seen_at)[:, None], seen_at, np.nan)

    def before(
        self, points: MovingPoints, pixels: np.ndarray, places: tuple[np.ndarray, np.ndarray] | None = None
    ) -> np.ndarray:
        """Return whether something is in front of points seen at pixels (n, 2), as numbers of ``aimed.is_before``, also
        for ``places``; -1 if the pixel is NaN. With pixel times the time is that of the pixel's center.
        """
        answer = np.full(len(pixels), -1, np.int8)
        seen = np.flatnonzero(~np.isnan(pixels[:, 0]))
        for frame, indices in self._moments(pixels, seen):
            _, shapes = self._moment(frame)
            then = pixels[indices]
            if frame is not None:
                then = self._project(points, frame, indices)
                inside = self._is_inside(then)
                indices, then = indices[inside], then[inside]
            answer[indices] = is_before(
                self._plan(frame), then, points.at(shapes, indices),
                partial(lambda shapes, indices, at: points.error(shapes, indices[at]), shapes, indices),
                None if places is None else (places[0][indices], places[1][indices]),
            )  # fmt: skip
        return answer

    def _moments(self, pixels: np.ndarray, seen: np.ndarray) -> Iterator[tuple[float | None, np.ndarray]]:
        """Yield each time of the pixels' centers, None if the picture has one time, and the indices of its pixels."""
        clock = self.camera.pixel_time
        if clock is None:
            yield None, seen
            return
        times = clock.frame_at(*(np.floor(pixels[seen].T) + 0.5))
        for frame in np.unique(times).tolist():
            yield frame, seen[times == frame]

    def _project(self, points: MovingPoints, frame: float | None, indices: np.ndarray) -> np.ndarray:
        camera, shapes = self._moment(frame)
        return camera.project(points.at(shapes, indices))

    def _is_inside(self, pixels: np.ndarray) -> np.ndarray:
        with np.errstate(invalid="ignore"):  # False for NaN
            return ((pixels >= 0) & (pixels <= self.camera.raster.size)).all(axis=1)

    def _moment(self, frame: float | None) -> tuple[Camera, Shapes]:
        """Return camera and shapes at a frame; ``frame`` is None for a picture with one time."""
        if frame is None:
            return self.camera, self.shapes
        limit = max(16, SHAPES // max(len(self.shapes), 1))
        return _kept(self._states, frame, limit, lambda: (self.camera.at(frame), self.shapes.at(frame)))

    def _plan(self, frame: float | None) -> Plan:
        return _kept(self._plans, frame, PLANS, lambda: aiming_plan(*self._moment(frame)))


def _kept(known: dict, key: Any, limit: int, make: Callable[[], Any]) -> Any:
    """Return the cached value of a key, made if it is missing; only the newest ``limit`` values are kept."""
    value = known.get(key)
    if value is None:
        value = known[key] = make()
        for old in list(known)[:-limit]:
            known.pop(old, None)
    return value
