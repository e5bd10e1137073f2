"""A camera: a model of its lens, a pose, a raster and a clip range. Pixels become world rays here, and nowhere else."""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import nullcontext
from dataclasses import dataclass, replace
from typing import Any, Literal, overload

import numpy as np

from ..arguments import flag, numbers
from ..cameras import find_model
from ..cameras.model import Model
from ..cameras.parts.aperture import Aperture
from ..cameras.parts.settings import values_of
from ..conventions import gamma
from ..maths.panels import ROWS, is_raster, on_raster
from ..maths.speed import lazy, whole_rows
from ..maths.vector import components, dot, inverse, is_grid, matvec, norm
from ..memory import of_pixels, require
from ..records import BlenderCamera, InputError, Pose, Raster, Rays, RaysJacobian
from .jacobian import of_projection, of_rays
from .meeting import meeting
from .pixel_time import CameraMotion, PixelTime
from .pixels import by_time, given, in_blocks
from .sampling import in_opening, sub_pixel

FARTHEST = 1e15
"""Pixels, or Blender units, within which no length or polynomial overflows."""

BLOCK_PIXELS = 1 << 17
"""Pixels whose rays are made at once where a thread's share has as many: of fewer, threads wait at numpy's calls."""

BY_POLYNOMIALS = 8
"""As many times more where polynomials give most pixels, and the formula is asked for few. 4: 1.1 to 1.25 times the
time of rays that iterate.
"""


@dataclass(frozen=True)
class Camera:
    """What ``read_camera`` returns. Its public interface: rays, rays_at, project, K and world_to_opencv."""

    name: str
    model: Model
    pose: Pose
    raster: Raster
    clip_start: float
    clip_end: float
    record: BlenderCamera
    """What it was made of; the numbers of a calibration file are in it."""
    aperture: Aperture | None = None
    """What lets rays beside the chief ray in; None for a pinhole."""
    pixel_time: PixelTime | None = None
    """The frame of each pixel; None where the picture has one time."""
    motion: CameraMotion | None = None
    """With pixel times, what knows the camera at other frames; None for a camera that stands still."""
    next: Camera | None = None
    """At the next frame, and ``previous`` at the previous one: see ``casting.flow``. None where they are not read."""
    previous: Camera | None = None

    @property
    def settings(self) -> dict[str, Any]:
        """The values of the model's SETTINGS, by name, as plain numbers, words and lists."""
        return values_of(find_model(self.record).SETTINGS, self.record)

    @property
    def K(self) -> np.ndarray | None:
        """The camera matrix, (3, 3) float64, in OpenCV's convention: y down, the origin in the center of the top left
        pixel. Where a lens distorts, it applies to the distorted coordinates. None for models without one.
        """
        return self.model.K

    @property
    def world_to_opencv(self) -> np.ndarray:
        """(4, 4) float64: from the world to OpenCV's camera frame, x right, y down, z ahead.

        It is a rigid transform to the rounding of the matrix that Blender stores (float32, 1e-7), unless the camera is
        sheared. Each entry is right to gamma(8) of the sum of the magnitudes times the condition of the basis.
        """
        result = np.diag([1.0, -1.0, -1.0, 1.0])  # from the camera
        result[:3, :3] = result[:3, :3] @ inverse(self.pose.basis)
        result[:3, 3] = -result[:3, :3] @ self.pose.eye
        return result

    def at(self, frame: float) -> Camera:
        """Return the camera at a frame, without its pixel_time."""
        return replace(self, pixel_time=None, motion=None) if self.motion is None else self.motion.camera_at(frame)

    def from_eye(self, sampled: bool) -> bool:
        """Whether all rays leave the eye: the chief rays, or also those all over the aperture where it is sampled."""
        return self.model.central and not (sampled and self.aperture is not None)

    def pixel_rounding(self, x, y) -> tuple[Any, Any]:
        """Return what rounding before the model's own formula amounts to, in pixels; see ``Model``."""
        return self.model.pixel_rounding(x, y)

    @property
    def formula_reach(self) -> float:
        """How far from the eye the model's formula reaches; see ``Model``."""
        return self.model.formula_reach

    def camera_rays(self, x, y):
        """Return the camera-frame (origin, direction) components for pixel coordinates, scaled so that t is depth.

        x and y broadcast; so do the components, which is what lets a pinhole stay rows and columns.
        """
        origin, direction = self.model.rays(x, y)
        if not self.model.planar and not self.is_rigid:
            length = norm(matvec(self.pose.basis, direction))
            direction = tuple(component / length for component in direction)
        return origin, direction

    def sample_rays(self, x, y, sample: int):
        """Return what ``camera_rays`` does for a sample within the pixels with the centers x, y: the sample has its
        own place in the pixel, the same in all of them, and its own in the aperture.
        """
        off_x, off_y = sub_pixel(sample)
        place = x + off_x, y + off_y
        chief = self.camera_rays(*place)
        if self.aperture is None:
            return chief
        return self.model.through(self.aperture, chief, *place, self.aperture.points(*in_opening(sample, x, y)))

    @property
    def parallel(self):
        """The direction that all chief rays have, three numbers in the camera frame; None where they differ."""
        return self.model.rays(0.0, 0.0)[1] if self.model.parallel else None

    @lazy
    def stretch(self) -> float:
        """How many times as long vectors become at most, from the camera's frame to the world: 1 without shear."""
        return float(np.linalg.norm(self.pose.basis, 2))

    def length_of(self, direction):
        """Return the world's length of what ``camera_rays`` gives; of a row and a column it is one sum."""
        return norm(direction if self.is_rigid else matvec(self.pose.basis, direction))

    @property
    def is_rigid(self) -> bool:
        """Whether the basis is orthogonal to rounding, so that camera lengths are world lengths."""
        gram = self.pose.basis.T @ self.pose.basis
        return bool(np.abs(gram - np.eye(3)).max() <= gamma(8))

    def rays_at(self, x, y) -> Rays:
        """Return the world rays through pixel coordinates x, y (scalars or arrays that broadcast), as ``rays`` does.

        Pixel coordinates that are not finite have no ray. Raises InputError for what are no numbers, for shapes that do
        not go together, and for rays that take more memory than there is.
        """
        x, y, shape = given(x, y)
        timed = self.pixel_time is not None
        require((57 if timed else 25 if self.model.central else 49) * math.prod(shape), of_pixels("the rays", shape))
        if self.pixel_time is not None:
            time, (origins, directions) = self._timed(Camera.rays_at, x, y, (3,))
            return Rays(origins, directions, ~np.isnan(directions[..., 0]), time)
        directions = np.empty((*shape, 3))
        origins = np.broadcast_to(self.pose.eye, directions.shape) if self.model.central else np.empty((*shape, 3))
        valid = np.empty(shape, bool)
        near = _is_near(x) and _is_near(y)

        def put(part) -> None:
            with _quiet(near):
                self._write(x, y[part], origins[part], directions[part], valid[part])

        if is_grid(x, y) and y.ndim == 2:
            pixels = BLOCK_PIXELS * (BY_POLYNOMIALS if self.model.by_polynomials else 1)
            in_blocks(put, valid.shape, pixels, ROWS)  # whole panels
        else:
            put(...)
        if not near:
            is_unit = norm(components(directions)) > 0.5  # 0 or NaN where something overflowed
            lost = ~(np.isfinite(x) & np.isfinite(y) & is_unit)
            directions[lost], valid[...] = np.nan, ~lost
        return Rays(origins, directions, valid)

    def _write(self, x, y, origins, directions, valid) -> None:
        """Write the world rays through pixel coordinates; the origins only where there is more than the eye."""
        if self.model.by_polynomials and is_raster(x, y):
            parts = (directions,) if self.model.central else (directions, origins)
            out = [np.moveaxis(part, -1, 0) for part in parts]
            on_raster(replace(self, model=self.model.endless)._at_points, x, y, self.model.disc, 3 * len(out), out)
        else:
            with whole_rows(valid.shape[-1] if valid.ndim else 1):
                self._write_by_formula(x, y, origins, directions)
        np.equal(directions[..., 0], directions[..., 0], out=valid)  # NaN is not

    def _write_by_formula(self, x, y, origins, directions) -> None:
        origin, direction = self.camera_rays(x, y)
        scale = 1.0 / self.length_of(direction) if self.model.planar else 1.0
        for axis, row in enumerate(self.pose.basis):
            np.multiply(dot(row, direction), scale, out=directions[..., axis])
            if not self.model.central:
                np.add(dot(row, origin), self.pose.eye[axis], out=origins[..., axis])

    def _at_points(self, x, y):
        """Return the components of the directions, and unless all leave the eye of the origins, by the formula."""
        directions, origins = np.empty((2, *np.broadcast_shapes(x.shape, y.shape), 3))
        with np.errstate(all="ignore"):  # beyond the model's disc there may be no value
            self._write_by_formula(x, y, origins, directions)
        return (*components(directions), *components(origins)) if not self.model.central else components(directions)

    @property
    def _moves(self) -> bool:
        """Whether pixels have cameras of their own."""
        return self.pixel_time is not None and self.motion is not None

    def _timed(self, ask: Callable, x, y, axes: tuple[int, ...]) -> tuple[np.ndarray, Any]:
        """Return the times of pixels, and the origins and directions, (2, ..., *axes), that ``ask(camera, x, y)`` gives
        of the camera at each pixel's own time.
        """
        pixel_time: Any = self.pixel_time
        time = np.broadcast_to(pixel_time.frame_at(x, y), np.broadcast_shapes(x.shape, y.shape))
        found = np.full((2, *time.shape, *axes), np.nan)
        for frame, part_x, part_y, place, where in by_time(pixel_time, time, x, y):
            part, where = ask(self.at(frame), part_x, part_y), np.expand_dims(where, tuple(range(-len(axes), 0)))
            for own, value in zip(found, (part.origins, part.directions), strict=True):
                np.copyto(own[place], value, where=where)
        return time, found

    def rays(self) -> Rays:
        """Return the chief rays of the render window: through its pixel centers, world frame, unit directions.

        With pixel times each ray is the camera's at the pixel's own time. Undefined (NaN, valid False) where the model
        has no ray. Each component of a direction is right to a few EPS relative to the unit length, amplified by the
        frame's offset (shift) over the pixel's own. Where a model's formula takes polynomials for whole pictures
        (see ``maths.panels``), a ray that is asked for alone may differ by as much.
        """
        return self.rays_at(self.raster.columns(), self.raster.rows())

    def rays_jacobian_at(self, x, y) -> RaysJacobian:
        """Return how the world rays through pixel coordinates x, y change there; see ``rays_at`` and ``rays_jacobian``.

        The derivatives have the shape of x and y, and then 3 and 2.
        """
        x, y, shape = given(x, y)
        size = (96 if self._moves or not self.model.central else 48) * math.prod(shape)
        require(size, of_pixels("the derivatives of the rays", shape))
        if self._moves:
            return RaysJacobian(*self._timed(Camera.rays_jacobian_at, x, y, (3, 2))[1])
        return of_rays(self.model, self.pose, x, y, shape)

    def rays_jacobian(self) -> RaysJacobian:
        """Return how the rays of ``rays`` change from pixel to pixel: the derivatives of the origins and of the unit
        directions by the pixel's x and y, world frame.

        They come from the model's own formula, for every model alike: see ``camera.jacobian``, also for how exact they
        are. With pixel times they are those of the camera at the pixel's own time: a pixel has one time all over.
        """
        return self.rays_jacobian_at(self.raster.columns(), self.raster.rows())

    @overload
    def project(self, points, jacobian: Literal[False] = False) -> np.ndarray: ...
    @overload
    def project(self, points, jacobian: Literal[True]) -> tuple[np.ndarray, np.ndarray]: ...
    def project(self, points, jacobian=False):
        """Return the pixel coordinates (..., 2) in the full frame of world points (..., 3); NaN where none sees it, and
        for points that are not finite. With ``jacobian`` return also their derivatives by the points, (..., 2, 3):
        pixels per world unit, for every model alike; see ``camera.jacobian``.

        With pixel times and a moving camera the points, taken to stand still, are sought: see ``meeting``; their
        derivatives are refused. Raises InputError for them, and for an array of another shape.
        """
        points = numbers(points, "points")
        if points.shape[-1:] != (3,):
            raise InputError(f"points of shape {points.shape} cannot be projected: give x, y, z, shape (..., 3)")
        each = points.reshape(-1, 3)
        if flag(jacobian, "jacobian"):
            if self._moves:
                raise InputError(
                    f"camera {self.name!r} moves from pixel to pixel, and its speed is not known to rounding: ask the "
                    "camera of one frame, camera.at(frame).project(points, jacobian=True)"
                )
            require(64 * len(each), "the derivatives of the pixels", "project fewer points at once")
            pixels = self.project(points)
            found = of_projection(self.model, self.pose, each, pixels.reshape(-1, 2))
            return pixels, found.reshape(*points.shape[:-1], 2, 3)
        if self._moves:
            time: Any = self.pixel_time
            motion: Any = self.motion
            sought = meeting(time, lambda frame, some: self.at(frame).project(each[some]), len(each), motion.cuts)
            return sought.reshape(*points.shape[:-1], 2)
        near = _is_near(points)
        with _quiet(near):
            pixels = self.model.project((points - self.pose.eye) @ inverse(self.pose.basis).T)
        if not near:
            pixels[~(np.isfinite(points).all(axis=-1) & np.isfinite(pixels).all(axis=-1))] = np.nan
        return pixels


def _is_near(places) -> bool:
    """Whether all coordinates are finite, and none is farther out than what follows is sure to be a number."""
    return bool(-FARTHEST < places.min(initial=0.0) <= places.max(initial=0.0) < FARTHEST)


def _quiet(near: bool):
    """Let numbers overflow, and NaN come of them, only where that is meant: far out it is an answer."""
    return nullcontext() if near else np.errstate(all="ignore")
