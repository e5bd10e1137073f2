"""A camera: a lens model, a pose, a raster and a clip range."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Literal, overload

import numpy as np

from ..arguments import numbers, shown, word
from ..cameras import find_model
from ..cameras.model import Model
from ..cameras.parts.aperture import Aperture
from ..cameras.parts.parameters import varied
from ..conventions import BOTTOM, TOP, gamma
from ..maths.speed import lazy
from ..maths.vector import matvec, norm
from ..memory import of_pixels, require
from ..records import BlenderCamera, InputError, Pose, Raster, Rays, RaysJacobian
from .changed import changed, posed
from .description import Description
from .evaluation import pixels_of, rays_through
from .jacobian import of_projection, of_rays, of_settings
from .meeting import meeting
from .pixel_coordinates import by_time, checked_pixels
from .sampling import sampled
from .spherical_stereo import with_eye
from .sweep import rays_in_sweep
from .times import MovingCamera, PixelTime, SweepTime


@dataclass(frozen=True, eq=False, repr=False)
class Camera(Description):
    """A camera: a model, a pose, a raster and a clip range. It is made by ``crc.camera``, ``crc.read_camera``,
    ``crc.load_calibration`` or ``crc.camera_from_json``.

    ``rays()``, ``rays_at(x, y)`` and ``project(points)`` are its main interface; ``K``, ``world_from_camera`` and
    ``opencv_from_world`` say how it maps and where it is. Cameras with equal fields are equal.
    """

    name: str
    model: Model
    pose: Pose
    raster: Raster
    clip_start: float
    clip_end: float
    record: BlenderCamera
    """The record that the camera was made from, including the numbers of a calibration file."""
    aperture: Aperture | None = None
    """The opening that admits rays other than the chief ray; None for a pinhole."""
    pixel_time: PixelTime | None = None
    """The frame of each pixel; None if the picture has one time."""
    motion: MovingCamera[Camera] | None = None
    """The camera over the times of its pixels; None if they have one time, or nothing moves."""
    next: Camera | None = None
    previous: Camera | None = None
    """The camera at the neighboring frames: see ``casting.flow``. None if they were not read."""

    from_record: ClassVar[Callable[[BlenderCamera], Camera]]
    """The function of ``build`` that makes cameras."""

    def __post_init__(self) -> None:
        if self.model.size != self.raster.size:
            raise InputError(
                f"camera {self.name!r} has a raster of {self.raster.size} and a model of {self.model.size} pixels: "
                "make a camera of another size anew, by crc.camera"
            )

    @lazy
    def _varied(self) -> Model:
        """The model made of varied numbers. Raises InputError if the record does not have the model."""
        kind = find_model(self.record)

        def made(raw: BlenderCamera) -> Model:
            return with_eye(kind.from_blender(raw, self.raster), raw, self.pose)

        with np.errstate(all="ignore"):  # NaN means no ray
            x, y = np.meshgrid(*(np.linspace(0, side, 5) for side in self.raster.size))
            numbers, others = (sum(model.rays(x, y), ()) for model in (self.model, made(self.record)))
            if not all(np.array_equal(*parts, equal_nan=True) for parts in zip(numbers, others, strict=True)):
                raise InputError(
                    f"the lens of camera {self.name!r} lies between two that were read, and no settings give it: ask a "
                    "camera that was read at its frame"
                )
            return made(varied(kind.SETTINGS, self.record, list(self.parameters)))

    def at(self, frame: float) -> Camera:
        """Return the camera at a frame, without its pixel_time."""
        return replace(self, pixel_time=None) if self.motion is None else self.motion.camera_at(frame)

    def with_pose(self, pose) -> Camera:
        """Return the camera at another pose, (4, 4) to the world, as in ``crc.camera``. Raises InputError for a matrix
        that is no pose, and for a camera that moves while it is exposed.
        """
        return posed(self, pose)

    def with_settings(self, **settings: Any) -> Camera:
        """Return the camera with other values of some settings, those of ``crc.camera``: all others stay. The numbers
        of a calibration file stay, too, and the camera no longer refers to the file. Raises InputError for what
        ``crc.camera`` refuses, and for a camera that moves while it is exposed.
        """
        return Camera.from_record(changed(self, settings))

    def from_eye(self, sampled: bool) -> bool:
        """Whether all rays leave the eye: the chief rays, or if ``sampled`` those through the whole aperture."""
        return self.model.central and not (sampled and self.aperture is not None)

    def pixel_rounding(self, x, y) -> tuple[Any, Any]:
        """Return the effect of rounding before the model's own formula, in pixels along x and y; see ``Model``."""
        return self.model.pixel_rounding(x, y)

    @property
    def formula_reach(self) -> float:
        """How far from the eye the model's formula reaches; see ``Model``."""
        return self.model.formula_reach

    def camera_rays(self, x, y):
        """Return the camera-frame (origin, direction) components for pixel coordinates, scaled so that t is depth.

        x and y broadcast, and so do the components, so that those of a pinhole stay a row and a column.
        """
        origin, direction = self.model.rays(x, y)
        if not self.model.planar and not self.is_rigid:
            length = norm(matvec(self.pose.basis, direction))
            direction = tuple(component / length for component in direction)
        return origin, direction

    def sample_rays(self, x, y, sample: int):
        """Return the rays of a sample in the pixels with the centers x, y, in the form of ``camera_rays``. The sample
        has the same place in every pixel, and in each pixel another point of the aperture.
        """
        pixel, point = sampled(self.aperture, x, y, sample)
        chief = self.camera_rays(*pixel)
        return chief if self.aperture is None else self.model.through(self.aperture, chief, *pixel, point)

    def sample_light(self, x, y, sample: int):
        """Return the light of the rays of ``sample_rays``; see ``Model.light``. None if all carry the same."""
        pixel, point = sampled(self.aperture, x, y, sample)
        return None if self.aperture is None else self.model.light(self.aperture, *pixel, point)

    @property
    def parallel(self):
        """The common direction of all chief rays, three numbers in the camera frame; None if the directions differ."""
        return self.model.rays(0.0, 0.0)[1] if self.model.parallel else None

    @lazy
    def stretch(self) -> float:
        """The largest factor by which vectors grow from the camera's frame to the world: 1 without shear."""
        return float(np.linalg.norm(self.pose.basis, 2))

    def length_of(self, direction):
        """Return the length in the world of a direction from ``camera_rays``; a row and a column take only one sum."""
        return norm(direction if self.is_rigid else matvec(self.pose.basis, direction))

    @property
    def is_rigid(self) -> bool:
        """Whether the basis is orthogonal to rounding, so that camera lengths are world lengths."""
        gram = self.pose.basis.T @ self.pose.basis
        return bool(np.abs(gram - np.eye(3)).max() <= gamma(8))

    def rays_at(self, x, y, *, rows: str = BOTTOM) -> Rays:
        """Return the world rays through pixel coordinates x, y (scalars or arrays that broadcast), as ``rays`` does;
        with ``rows="top"`` through OpenCV's: see ``project``.

        Pixel coordinates that are not finite have no ray. With pixel times, coordinates beyond the frame have the time
        of its nearest edge. Raises InputError for values that are not numbers, for shapes that do not broadcast, and
        for rays that need more memory than is available.
        """
        x, y, shape = checked_pixels(x, y)
        if word(rows, "rows", (BOTTOM, TOP)) == TOP:
            x, y = x + 0.5, self.height - 0.5 - y
        timed = self.pixel_time is not None
        require((57 if timed else 25 if self.model.central else 49) * math.prod(shape), of_pixels("the rays", shape))
        if isinstance(self.pixel_time, SweepTime):
            return rays_in_sweep(self, self.pixel_time, x, y, shape)
        if self.pixel_time is not None:
            time, (origins, directions) = self._timed(Camera.rays_at, x, y, (3,))
            return Rays(origins, directions, ~np.isnan(directions[..., 0]), time)
        return rays_through(self, x, y, shape)

    @property
    def _moves(self) -> bool:
        """Whether pixels have cameras of their own."""
        return self.pixel_time is not None and self.motion is not None

    def _timed(self, ask: Callable, x, y, axes: tuple[int, ...]) -> tuple[np.ndarray, Any]:
        """Return the times of pixels, and the origins and directions, (2, ..., *axes), that ``ask(camera, x, y)``
        returns for the camera at each pixel's own time.
        """
        pixel_time: Any = self.pixel_time
        first, last = pixel_time.span
        time = np.broadcast_to(pixel_time.frame_at(x, y), np.broadcast_shapes(x.shape, y.shape))
        vectors = np.full((2, *time.shape, *axes), np.nan)
        for frame, part_x, part_y, block, where in by_time(pixel_time, time, x, y):
            there = self.at(min(max(frame, first), last))
            answer, where = ask(there, part_x, part_y), np.expand_dims(where, tuple(range(-len(axes), 0)))
            for array, value in zip(vectors, (answer.origins, answer.directions), strict=True):
                np.copyto(array[block], value, where=where)
        return np.clip(time, first, last), vectors

    def rays(self) -> Rays:
        """Return the chief rays of the render window: through its pixel centers, world frame, unit directions.

        With pixel times each ray is that of the camera at the pixel's own time. Undefined (NaN, valid False) where the
        model has no ray. The error of each component of a direction is a few EPS of the unit length, amplified by the
        frame's offset (shift) over the pixel's own. Some models evaluate polynomials for whole pictures (see
        ``maths.panels``): a ray computed by itself may differ by the same amount.
        """
        return self.rays_at(self.raster.columns(), self.raster.rows())

    def rays_jacobian_at(self, x, y) -> RaysJacobian:
        """Return how the world rays through pixel coordinates x, y change there; see ``rays_at`` and ``rays_jacobian``.

        The derivatives have the shape of x and y, and then 3 and 2. Raises InputError for a scanner, whose pixels are
        single beams, and for what ``rays_at`` refuses.
        """
        self._check_differentiable()
        x, y, shape = checked_pixels(x, y)
        size = (96 if self._moves or not self.model.central else 48) * math.prod(shape)
        require(size, of_pixels("the derivatives of the rays", shape))
        if self._moves:
            return RaysJacobian(*self._timed(Camera.rays_jacobian_at, x, y, (3, 2))[1])
        return of_rays(self.model, self.pose, x, y, shape)

    def rays_jacobian(self) -> RaysJacobian:
        """Return how the rays of ``rays`` change from pixel to pixel: the derivatives of the origins and of the unit
        directions by the pixel's x and y, world frame.

        They follow from the formula of each model: see ``camera.jacobian``, also for their accuracy. With pixel times
        they belong to the camera at the pixel's own time, which is constant within a pixel. Raises InputError for a
        scanner.
        """
        return self.rays_jacobian_at(self.raster.columns(), self.raster.rows())

    @overload
    def project(self, points, jacobian: Literal[False] = False, *, rows: str = BOTTOM) -> np.ndarray: ...
    @overload
    def project(
        self, points, jacobian: Literal[True, "settings"], *, rows: str = BOTTOM
    ) -> tuple[np.ndarray, np.ndarray]: ...
    def project(self, points, jacobian=False, *, rows=BOTTOM):
        """Return the pixel coordinates (..., 2) in the full frame of world points (..., 3); NaN for points that are not
        seen or not finite. With ``jacobian`` return also the derivatives with respect to the points, (..., 2, 3), in
        pixels per world unit, for every model; see ``camera.jacobian``. With ``jacobian="settings"`` these are the
        derivatives by the n numbers of ``parameters`` instead, (..., 2, n), per unit of each (radians for angles); 0 by
        a number on which the picture does not depend. ``rows="top"``: pixels as OpenCV has them, those of ``K``, with y
        down from the center of the top left one.

        With pixel times and a moving camera the pixels are found by a search, with points that stand still: see
        ``meeting``. Raises InputError for derivatives then and of a scanner, and for an array of another shape.
        """
        if word(rows, "rows", (BOTTOM, TOP)) == TOP:
            result = self.project(points, jacobian)
            pixels = result[0] if isinstance(result, tuple) else result
            pixels = np.stack((pixels[..., 0] - 0.5, self.height - 0.5 - pixels[..., 1]), axis=-1)
            return (pixels, result[1] * [[1], [-1]]) if isinstance(result, tuple) else pixels
        points = numbers(points, "points")
        if points.shape[-1:] != (3,):
            raise InputError(f"points of shape {points.shape} cannot be projected: give x, y, z, shape (..., 3)")
        each, by_settings = points.reshape(-1, 3), isinstance(jacobian, str) and jacobian == "settings"
        if not by_settings and not isinstance(jacobian, bool | np.bool_):
            raise InputError(f"jacobian is {shown(jacobian)}: it must be True, False or 'settings'")
        if jacobian:
            self._check_differentiable()
            if self._moves:
                raise InputError(
                    f"camera {self.name!r} moves from pixel to pixel, and its speed is not known to rounding: ask the "
                    f"camera of one frame, camera.at(frame).project(points, jacobian={jacobian!r})"
                )
            count = len(self.parameters) if by_settings else 3
            require((16 + 16 * count) * len(each), "the derivatives of the pixels", "project fewer points at once")
            pixels = self.project(points)
            seen = self.pose, each, pixels.reshape(-1, 2)
            derivatives = of_settings(self._varied, count, *seen) if by_settings else of_projection(self.model, *seen)
            return pixels, derivatives.reshape(*points.shape[:-1], 2, count)
        if self.pixel_time is not None and self.motion is not None:
            sought = meeting(
                self.pixel_time, lambda frame, indices: self.at(frame).project(each[indices]), len(each),
                self.motion.cuts, is_still=self.motion.camera_is_still,
            )  # fmt: skip
            return sought.reshape(*points.shape[:-1], 2)
        return pixels_of(self, each).reshape(*points.shape[:-1], 2)

    def _check_differentiable(self) -> None:
        if not self.model.differentiable:
            raise InputError(
                f"{self.model.label} of camera {self.name!r} has no derivatives: its pixels are single beams, not "
                "parts of a picture"
            )
