"""From a record to a camera: its model, pose, raster, aperture and pixel times."""

from __future__ import annotations

from ..cameras import find_model
from ..cameras.parts.film import raster_from
from ..cameras.parts.pose import pose_from
from ..cameras.parts.settings import values_of
from ..records import BlenderCamera, InputError
from .camera import Camera
from .pixel_time import pixel_time_from


def camera_from(raw: BlenderCamera) -> Camera:
    """Return the camera that a record describes.

    Raises InputError, in one line, for a type without a model (it names those that have one) and for settings without
    meaning.
    """
    kind, raster = find_model(raw), raster_from(raw)
    if not 0 <= raw.clip_start < raw.clip_end:
        raise InputError(f"clip start {raw.clip_start}, clip end {raw.clip_end} of camera {raw.name!r} leave no depth")
    model, pose = kind.from_blender(raw, raster), pose_from(raw)
    return Camera(
        name=raw.name,
        model=model,
        pose=pose,
        raster=raster,
        clip_start=raw.clip_start,
        clip_end=raw.clip_end,
        aperture=model.aperture(raw, pose),
        pixel_time=pixel_time_from(raw, raster),
        settings=values_of(kind.SETTINGS, raw),
    )
