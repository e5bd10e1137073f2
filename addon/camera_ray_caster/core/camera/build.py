"""From a record to a camera: its model, pose, raster, aperture and pixel times."""

from __future__ import annotations

from ..cameras import MODELS
from ..cameras.camera_obscura import CameraObscura
from ..cameras.orthographic import Orthographic
from ..cameras.parts.aperture import Aperture, lens_from
from ..cameras.parts.film import raster_from
from ..cameras.parts.pose import pose_from
from ..records import BlenderCamera, InputError, Pose
from .camera import Camera
from .pixel_time import pixel_time_from

REFUSED = {"CUSTOM": "it is an OSL shader, which only Cycles can run and nobody can invert"}
"""Blender's types that no model can stand for, and why."""


def camera_from(raw: BlenderCamera) -> Camera:
    """Return the camera that a raw record describes.

    Raises InputError, in one line, for a type without a model (it names those that have one) and for parameters
    without meaning.
    """
    models = {model.key: model for model in MODELS}
    key = raw.model or str(raw.settings["panorama_type"] if raw.type == "PANO" else raw.type)
    if key not in models:
        reason = REFUSED.get(key, "there is no model for it")
        raise InputError(f"camera {raw.name!r} is of type {key}: {reason}: choose one of {', '.join(models)}")
    raster = raster_from(raw)
    if not 0 <= raw.clip_start < raw.clip_end:
        raise InputError(f"clip start {raw.clip_start}, clip end {raw.clip_end} of camera {raw.name!r} leave no depth")
    model, pose = models[key].from_blender(raw, raster), pose_from(raw)
    clip = raw.clip_start, raw.clip_end
    return Camera(raw.name, model, pose, raster, *clip, _aperture(raw, model, pose), pixel_time_from(raw, raster))


def _aperture(raw: BlenderCamera, model, pose: Pose) -> Aperture | None:
    """Return what lets in rays beside the chief rays. Where these have no common eye nor direction, nothing does."""
    if isinstance(model, CameraObscura):
        return model.hole
    parallel = isinstance(model, Orthographic)
    return lens_from(raw, pose, parallel) if model.central or parallel else None
