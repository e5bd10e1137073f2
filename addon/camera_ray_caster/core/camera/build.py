"""Construction of a camera from a record: its model, pose, raster, aperture and pixel times."""

import numpy as np

from ..cameras import find_model
from ..cameras.model import Model
from ..cameras.parts.calibration import FILE
from ..cameras.parts.film import farthest_from_one, raster_from
from ..cameras.parts.pose import pose_from
from ..cameras.parts.settings import Number, Whole
from ..maths.vector import inverse, stacked
from ..records import BlenderCamera, InputError, Pose
from .calibration_file import with_file
from .camera import Camera
from .guard import checked
from .pixel_time import pixel_time_from
from .spherical_stereo import with_eye

APART = 2.0**-40
"""Fraction of a coordinate: closer points differ in only the last few digits of float64, and not at all in float32, the
type that Blender uses.
"""

PLACES = np.linspace(0, 1, 5)
"""Places along each side of the frame, as fractions, of the pixels whose rays a new camera must find again."""

POINT_DISTANCE = 2.0**-13
"""Distance of the points that it must find, over the distance of the rays' origins from the world's origin."""

SAME_PIXEL = 1e-3
"""Pixels by which a projection may miss its own pixel. Near a pole of a rational lens, rays are right to rounding, and
pixels, which move there by 1,000 times the ray, to 1e-7.
"""

UNIT = 1e-6
"""Largest error of the lengths of a model's directions: far more than rounding."""

FARTHEST_PLANE = 1e50
"""Largest coordinate on the image plane: powers of larger ones overflow. Rays that are parallel need none."""


def camera_from(raw: BlenderCamera) -> Camera:
    """Return the camera that a record describes.

    Raises InputError, in one line, for a type without a model (the message names the types that have one) and for
    invalid settings, such as numbers so large or small together that neighboring pixels have the same ray.
    """
    kind, raster = find_model(raw), raster_from(raw)
    if not 0 <= raw.clip_start < raw.clip_end:
        raise InputError(
            f"clip start {raw.clip_start}, clip end {raw.clip_end} of camera {raw.name!r} leave no range of depths"
        )
    original, raw = raw, with_file(raw, kind, raster)
    try:
        lens, pose = kind.from_blender(raw, raster), pose_from(raw)
    except InputError as error:
        if raw is original:
            raise
        raise InputError(f"{error}; calibration file {FILE.read(raw)!r}") from error
    _check_apart(raw, lens, pose)
    _check_inverse(raw, lens, pose)
    model = with_eye(lens, raw, pose)
    nearest, farthest = lens.limits
    start, end = max(raw.clip_start, nearest), min(raw.clip_end, farthest)
    if not start < end:
        raise InputError(
            f"clip start {raw.clip_start}, clip end {raw.clip_end} of camera {raw.name!r} leave nothing of the range "
            f"from {nearest} to {farthest} that it measures"
        )
    return Camera(
        name=raw.name,
        model=model,
        pose=pose,
        raster=raster,
        clip_start=start,
        clip_end=end,
        record=raw,
        aperture=model.aperture(raw, pose),
        pixel_time=pixel_time_from(raw, raster, lens.firing),
    )


Camera.from_record = staticmethod(camera_from)


def _check_apart(raw: BlenderCamera, model: Model, pose: Pose) -> None:
    """Raise InputError if the pixels around the middle of the frame have the same direction in the world and the same
    point at the clip start. The message names the number that is farthest from 1. A middle without rays is accepted.
    """
    if not model.differentiable:  # a pixel may be a single ray
        return
    half = np.array((-0.25, 0.25))
    x, y = model.size[0] / 2 + half[None, :], model.size[1] / 2 + half[:, None]
    with np.errstate(all="ignore"):
        origin, direction = (
            pose.basis @ np.stack(np.broadcast_arrays(*vector, x + y)[:3]).reshape(3, -1) for vector in model.rays(x, y)
        )
        places = pose.eye[:, None] + origin + raw.clip_start * direction
        same = [2 * np.ptp(vector, axis=1) <= APART * np.abs(vector).max(axis=1) for vector in (direction, places)]
    if not np.all(same):
        return
    raise InputError(
        f"rays of neighboring pixels of camera {raw.name!r} cannot be distinguished: {_cause(raw, model, pose)}"
    )


def _check_inverse(raw: BlenderCamera, model: Model, pose: Pose) -> None:
    """Raise InputError if a point on the ray of one of a few pixels projects to no pixel, or the frame is beyond all
    arithmetic. The message names the number that is farthest from 1. Models that are not smooth may miss a pixel.
    """
    window = getattr(model, "window", None)
    if window is not None and not model.parallel and not np.abs(window.extent(model.size)).max() <= FARTHEST_PLANE:
        raise InputError(
            f"the frame of camera {raw.name!r} reaches too far on its image plane: {_cause(raw, model, pose)}"
        )
    if not model.smooth:
        return
    x, y = (coordinate.ravel() for coordinate in np.meshgrid(*(0.5 + PLACES * (side - 1) for side in model.size)))
    with np.errstate(all="ignore"):
        local_rays = [stacked(vector, x.shape) for vector in model.rays(x, y)]
        _check_lengths(model, local_rays[1])
        origin, direction = (vectors @ pose.basis.T for vectors in local_rays)
        origin = origin + pose.eye
        far = 1 + POINT_DISTANCE * np.linalg.norm(origin, axis=1)
        far = far * np.linspace(1, 2, len(x))  # each has a rounding of its own
        points = origin + far[:, None] * direction
        local = (points - pose.eye) @ inverse(pose.basis).T
        back = model.project(local)
        is_back = np.abs(back - np.stack((x, y), axis=-1)).max(axis=1) <= SAME_PIXEL
        pixels = checked(model, local, back, always=True)
    lost = np.flatnonzero(np.isfinite(local).all(axis=1) & np.isnan(pixels).any(axis=1) & ~is_back)
    if lost.size:
        raise InputError(
            f"a point on the ray of pixel ({x[lost[0]]:g}, {y[lost[0]]:g}) of camera {raw.name!r} does not project "
            f"back to it: {_cause(raw, model, pose)}"
        )


def _check_lengths(model: Model, direction: np.ndarray) -> None:
    """Raise InputError for directions, (n, 3), which are not as long as a model's have to be."""
    off = np.abs((-direction[:, 2] if model.planar else np.linalg.norm(direction, axis=1)) - 1)
    if (off > UNIT).any():
        needed = "have z = -1, as planar says" if model.planar else "be of length 1, or have z = -1 and planar = True"
        first = ", ".join(f"{number:.3g}" for number in direction[np.argmax(off > UNIT)])
        raise InputError(f"model {model.key} has the direction ({first}): it must {needed}")


def _cause(raw: BlenderCamera, model: Model, pose: Pose) -> str:
    """Return the words for the number of a camera that is farthest from 1; if it has none, for its rays."""
    sizes = [setting for setting in model.SETTINGS if isinstance(setting, Number)
             if setting.unit or not isinstance(setting, Whole)]  # fmt: skip
    numbers = {setting.name: setting.given(raw) for setting in sizes}
    if not numbers:
        return "its rays are the same or cross each other, or it is too far from the world's origin"
    numbers["its distance from the world's origin"] = float(np.abs(pose.eye).max())
    cause = farthest_from_one({name: number for name, number in numbers.items() if np.isfinite(number)})
    return f"{cause}, too large or too small for the rest"
