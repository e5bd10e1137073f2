"""Blender's own lens nearest to a camera's: a perspective, the polynomial fisheye, or an orthographic.

Assumption: the rays leave one eye; the fisheye keeps the azimuth about the axis, through the pixel that looks ahead.
The axis of a ``Pitched`` lens, such as a dome master's, is that of the lens: the camera is turned with it.
Parallel rays look along the camera's axis; their pixels are linear in their places.
Formula: least squares over pixels. Perspective: x = fx X + cx and y = fy Y + cy for rays (X, Y, -1), which is linear.
Fisheye: theta = -(k1 r + ... + k4 r^4), linear in k; the ratio of the pixel's sides is that which keeps the azimuth.
The settings are rounded to float32, as Blender stores them, before errors are measured.
Reference: Blender manual, Cameras.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..cameras.fisheye_polynomial import COEFFICIENTS, FisheyePolynomial
from ..cameras.orthographic import Orthographic
from ..cameras.parts.parameters import with_values
from ..cameras.parts.pitched import Pitched
from ..cameras.parts.pose import pose_from
from ..cameras.parts.radial import FISHEYE_FOV, Radial
from ..cameras.perspective import Perspective
from ..maths.rotations import rotation, transform
from ..maths.vector import stacked
from ..records import BlenderCamera, InputError
from .build import camera_from
from .camera import Camera

SAMPLED = 201
"""Largest number of columns and of rows of pixels, with those at the edges, at which lenses are compared."""

GOOD = 0.05
"""Pixels: a perspective that errs by no more is taken, also if a fisheye errs less: more engines render it."""

WORST_FIT = 0.05
"""Fraction of the frame: a fit with larger errors is refused."""

PARALLEL = 1e-7
"""Largest slope of rays that count as parallel: matrices of float32 turn them by as much."""

ENGINES = {
    Perspective.key: "Cycles on any device, EEVEE and Workbench render it",
    Orthographic.key: "Cycles on any device, EEVEE and Workbench render it",
    FisheyePolynomial.key: "Cycles on any device renders it, EEVEE and Workbench do not",
}
"""What renders each lens."""


@dataclass(frozen=True)
class BlenderLens:
    """A lens of Blender's, and its distance from the camera's in pixels."""

    camera: Camera
    settings: dict[str, Any]
    """Blender's settings of camera and render that are to be set, by name."""
    worst: float
    mean: float
    elevation: float = 0.0
    """Angle in radians by which the lens looks up from the camera's viewing direction, about the camera's X axis."""
    beyond: float = 0.0
    """Part of the picture that the lens shows and the camera does not."""

    @property
    def message(self) -> str:
        """Return the lens, its errors and what renders it, in one line."""
        errors = f"at most {self.worst:.2g} and in the mean {self.mean:.2g} pixels from the model's rays"
        beyond = f"; {100 * self.beyond:.2g} % of the picture, black before, shows the scene" if self.beyond else ""
        return f"{self.camera.model.label}, {errors}{beyond}: {ENGINES[self.camera.model.key]}"


def blender_lens(camera: Camera) -> BlenderLens:
    """Return Blender's lens nearest to a camera's. Raises InputError for rays that neither leave one eye nor all look
    along the axis, for pixels with times of their own, and if no lens has the camera's rays.
    """
    remedy = "use Use in Cycles" if camera.record.model else "Cycles renders it as it is"
    camera, elevation = _level(camera)
    width, height = camera.raster.size
    x, y = (np.unique(np.linspace(0, side - 1, min(side, SAMPLED)).round()) + 0.5 for side in (width, height))
    x, y = (coordinate.ravel() for coordinate in np.meshgrid(x, y))
    with np.errstate(all="ignore"):  # NaN means no ray
        places, rays = (stacked(vector, x.shape) for vector in camera.model.rays(x, y))
    parallel = bool((np.abs(rays[:, :2]) <= PARALLEL * np.abs(rays[:, 2:])).all() and (rays[:, 2] < 0).all())
    if camera.pixel_time is not None or not (camera.model.central or parallel):
        reason = "whose pixels have their own times" if camera.pixel_time is not None else "whose rays have no eye"
        raise InputError(f"no Blender camera type matches the lens of camera {camera.name!r}, {reason}: {remedy}")
    if parallel and not camera.model.central:
        lens = _orthographic(camera, np.stack((x, y), axis=-1), places + rays)
        if lens is not None and lens.worst <= WORST_FIT * max(width, height):
            return lens
        raise InputError(f"no Blender camera type matches the lens of camera {camera.name!r}: {remedy}")
    there = np.isfinite(rays).all(axis=-1)
    if not there.any():
        raise InputError(f"camera {camera.name!r} has no ray in its frame: there is nothing to fit")
    pixels, rays = np.stack((x, y), axis=-1)[there], rays[there]
    candidates = (_judged(raw, settings, pixels, rays) for raw, settings in _nearest(camera, pixels, rays))
    lenses = [lens for lens in candidates if lens]
    nearest = min(lenses, key=lambda lens: lens.worst, default=None)
    if nearest is None or nearest.worst > WORST_FIT * max(width, height):
        error = "" if nearest is None else f"; the nearest errs by {nearest.worst:.2g} pixels"
        raise InputError(f"no Blender camera type matches the lens of camera {camera.name!r}{error}: {remedy}")
    straight = (lens for lens in lenses if lens.camera.model.key == Perspective.key and lens.worst <= GOOD)
    lens = next(straight, nearest)
    with np.errstate(all="ignore"):  # NaN means no ray
        seen = np.isfinite(lens.camera.model.rays(x, y)[1][0])
    return replace(lens, elevation=elevation, beyond=float((seen & ~there).mean()))


def _level(camera: Camera) -> tuple[Camera, float]:
    """Return a camera that looks along the axis of its lens, and the angle by which it was turned up for that."""
    if not isinstance(camera.model, Pitched):
        return camera, 0.0
    elevation = camera.model.elevation
    axes = camera.pose.basis @ rotation(np.array([(elevation, 0.0, 0.0)]))[0]
    record = replace(camera.record, matrix_world=transform(axes, camera.pose.eye))
    return replace(camera, model=replace(camera.model, elevation=0.0), pose=pose_from(record), record=record), elevation


def _orthographic(camera: Camera, pixels, points) -> BlenderLens | None:
    """Return the orthographic camera nearest to parallel rays through points in front of the camera."""
    nearest = _linear(camera, Orthographic.key, pixels, points)
    return None if nearest is None else _judged(*nearest, pixels, points)


def _linear(camera: Camera, kind: str, pixels, points) -> tuple[BlenderCamera, dict[str, Any]] | None:
    """Return the record of the orthographic or perspective camera whose pixels are nearest to a linear function of
    points, at any or at unit depth, and its settings; None if there is none.
    """
    (fx, cx), (fy, cy) = (np.polyfit(points[:, axis], pixels[:, axis], 1) for axis in (0, 1))
    if not min(fx, fy) > 0:
        return None
    raw, (width, height) = camera.record, camera.raster.size
    fitted = _fitted(raw, fx / fy, width, height)
    scale = {"ortho_scale": fitted / fx} if kind == Orthographic.key else {"lens": fx * _sensor(raw) / fitted}
    shift = {"shift_x": (width / 2 - cx) / fitted, "shift_y": (height / 2 - cy) * (fx / fy) / fitted}
    return _record(raw, kind, fx / fy, scale | shift)


def _nearest(camera: Camera, pixels, rays) -> Iterator[tuple[BlenderCamera, dict[str, Any]]]:
    """Yield the records of the nearest perspective and polynomial fisheye, and their settings."""
    raw = camera.record
    width, height = camera.raster.size
    if (rays[:, 2] < 0).all():
        perspective = _linear(camera, Perspective.key, pixels, rays / -rays[:, 2:])
        if perspective is not None:
            yield perspective
    ahead = camera.model.project(np.array([(0.0, 0.0, -1.0)]))[0]
    if not np.isfinite(ahead).all():
        return
    across, up = (pixels - ahead).T
    theta, azimuth = np.arctan2(np.hypot(rays[:, 0], rays[:, 1]), -rays[:, 2]), np.arctan2(rays[:, 1], rays[:, 0])
    weighed = up * np.cos(azimuth)
    aspect = float((across * np.sin(azimuth) * weighed).sum() / (weighed * weighed).sum()) if weighed.any() else 1.0
    if not 1e-3 < aspect < 1e3:
        return
    fitted = _fitted(raw, aspect, width, height)
    r = np.hypot(across, up * aspect) * _sensor(raw) / fitted
    scale = r.max()
    powers = np.stack([(r / scale) ** power for power in (1, 2, 3, 4)], axis=-1)
    k = np.linalg.lstsq(powers, theta, rcond=None)[0] / scale ** np.arange(1, 5)
    rim = max(float(theta.max()), camera.model.widest if isinstance(camera.model, Radial) else 0.0)
    yield _record(raw, FisheyePolynomial.key, aspect, {
        **{setting.name: -value for setting, value in zip(COEFFICIENTS, (0.0, *k), strict=True)},
        FISHEYE_FOV.name: min(2 * rim * (1 + 1e-6), 2 * np.pi),
        "shift_x": 0.5 - ahead[0] / width, "shift_y": 0.5 - ahead[1] / height,
    })  # fmt: skip


def _sensor(raw: BlenderCamera) -> float:
    return raw.sensor_height if raw.sensor_fit == "VERTICAL" else raw.sensor_width


def _fitted(raw: BlenderCamera, aspect: float, width: int, height: int) -> float:
    """Return the length of the fitted side of the frame, in widths of pixels."""
    horizontal = width >= aspect * height if raw.sensor_fit == "AUTO" else raw.sensor_fit == "HORIZONTAL"
    return width if horizontal else aspect * height


def _record(raw: BlenderCamera, kind: str, aspect: float, values: dict[str, float]):
    """Return the record of a camera of Blender's type with these settings, and the settings, rounded to float32."""
    if abs(aspect / (raw.pixel_aspect_y / raw.pixel_aspect_x) - 1) > 1e-6:
        values |= {"pixel_aspect_x": max(1.0, 1 / aspect), "pixel_aspect_y": max(1.0, aspect)}
    settings = {name: float(np.float32(value)) for name, value in values.items()}
    is_plain = kind in (Perspective.key, Orthographic.key)
    panorama = {} if is_plain else {"panorama_type": kind}
    return with_values(replace(raw, type=kind if is_plain else "PANO", model=""), panorama | settings), settings


def _judged(raw: BlenderCamera, settings: dict[str, Any], pixels, rays) -> BlenderLens | None:
    """Return the lens of a record with its errors; None if it is none, or does not see all rays."""
    try:
        camera = camera_from(raw)
    except InputError:
        return None
    apart = np.hypot(*(camera.model.project(rays) - pixels).T)
    if not np.isfinite(apart).all():
        return None
    return BlenderLens(camera, settings, float(apart.max()), float(apart.mean()))
