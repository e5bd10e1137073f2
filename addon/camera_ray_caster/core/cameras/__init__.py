"""The camera models, one file each. A new model is its file and one word in MODELS."""

from __future__ import annotations

from ..camera import Camera, pose_from
from ..records import BlenderCamera, InputError
from .film import raster_from
from .orthographic import Orthographic
from .perspective import Perspective

MODELS = (Perspective, Orthographic)
"""Every model; ``key`` is Blender's camera type, or what Blender's type does not tell, the model's own name."""


def camera_from(raw: BlenderCamera) -> Camera:
    """Return the camera that a raw record describes.

    Raises InputError, in one line, for a type without a model (it names those that have one) and for parameters
    without meaning.
    """
    models = {model.key: model for model in MODELS}
    if raw.type not in models:
        raise InputError(
            f"camera {raw.name!r} is of type {raw.type}, which has no model here: choose one of {', '.join(models)}"
        )
    raster = raster_from(raw)
    if not 0 <= raw.clip_start < raw.clip_end:
        raise InputError(f"the clip range of camera {raw.name!r} is {raw.clip_start} to {raw.clip_end}: no depth is left")
    model = models[raw.type].from_blender(raw, raster)
    return Camera(raw.name, model, pose_from(raw), raster, raw.clip_start, raw.clip_end)
