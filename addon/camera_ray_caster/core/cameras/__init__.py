"""The camera models, one file each. A new model is its file and one word in MODELS."""

from __future__ import annotations

from ..aperture import Aperture, lens_from
from ..camera import Camera, pose_from
from ..clock import clock_from
from ..records import BlenderCamera, InputError, Pose
from .camera_obscura import CameraObscura
from .central_cylindrical import CentralCylindrical
from .cross_slit import CrossSlit
from .cubemap_face import CubemapFace
from .cylindrical import Cylindrical
from .dome_master import DomeMaster
from .equirectangular import Equirectangular
from .film import raster_from
from .fisheye_equidistant import FisheyeEquidistant
from .fisheye_equisolid import FisheyeEquisolid
from .fisheye_orthographic import FisheyeOrthographic
from .fisheye_polynomial import FisheyePolynomial
from .fisheye_stereographic import FisheyeStereographic
from .general_linear import GeneralLinear
from .mirrorball import Mirrorball
from .omnidirectional_stereo import OmnidirectionalStereo
from .omnimax import Omnimax
from .opencv_fisheye import OpencvFisheye
from .opencv_pinhole import OpencvPinhole
from .orthographic import Orthographic
from .pencil import Pencil
from .perspective import Perspective
from .pushbroom import Pushbroom
from .stereographic_panorama import StereographicPanorama
from .strip import Strip
from .twisted_orthographic import TwistedOrthographic

MODELS = (
    Perspective, Orthographic,
    Equirectangular, CubemapFace, Mirrorball, FisheyeEquidistant, FisheyeEquisolid, FisheyePolynomial,
    CentralCylindrical, CameraObscura,
    FisheyeOrthographic, FisheyeStereographic, OpencvPinhole, OpencvFisheye, Omnimax, DomeMaster, Cylindrical,
    StereographicPanorama,
    GeneralLinear, CrossSlit, Pushbroom, Pencil, TwistedOrthographic, Strip, OmnidirectionalStereo,
)  # fmt: skip
"""Every model. ``key`` is Blender's camera or panorama type, or the name of a model that Blender does not have."""

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
    return Camera(raw.name, model, pose, raster, *clip, _aperture(raw, model, pose), clock_from(raw, raster))


def _aperture(raw: BlenderCamera, model, pose: Pose) -> Aperture | None:
    """Return what lets in rays beside the chief rays. Where these have no common eye nor direction, nothing does."""
    if isinstance(model, CameraObscura):
        return model.hole
    parallel = isinstance(model, Orthographic)
    return lens_from(raw, pose, parallel) if model.central or parallel else None
