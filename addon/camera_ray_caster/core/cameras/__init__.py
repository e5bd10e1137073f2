"""The camera models, one file each. A new model needs its own file and one word in MODELS."""

from ..records import BlenderCamera, InputError
from .behind_port import behind
from .camera_obscura import CameraObscura
from .central_cylindrical import CentralCylindrical
from .cross_slit import CrossSlit
from .cubemap_face import CubemapFace
from .cylindrical import Cylindrical
from .division import Division
from .dome_master import DomeMaster
from .double_sphere import DoubleSphere
from .equirectangular import Equirectangular
from .eucm import EnhancedUnifiedCamera
from .fisheye624 import Fisheye624
from .fisheye_equidistant import FisheyeEquidistant
from .fisheye_equisolid import FisheyeEquisolid
from .fisheye_orthographic import FisheyeOrthographic
from .fisheye_polynomial import FisheyePolynomial
from .fisheye_stereographic import FisheyeStereographic
from .fov import FieldOfView
from .ftheta import FTheta
from .general_linear import GeneralLinear
from .mirrorball import Mirrorball
from .model import Model
from .ocam import OCam
from .omnidirectional_stereo import OmnidirectionalStereo
from .omnimax import Omnimax
from .opencv_fisheye import OpencvFisheye
from .opencv_pinhole import OpencvPinhole
from .orthographic import Orthographic
from .parts.port_settings import PORT
from .pencil import Pencil
from .perspective import Perspective
from .pushbroom import Pushbroom
from .radial_polynomial import RadialPolynomial
from .ray_table import RayTable
from .real_lens import RealLens
from .scanner import Scanner
from .stereographic_panorama import StereographicPanorama
from .strip import Strip
from .thin_prism_fisheye import ThinPrismFisheye
from .twisted_orthographic import TwistedOrthographic
from .ucm import UnifiedCamera

MODELS: list[type[Model]] = [
    Perspective, Orthographic,
    Equirectangular, CubemapFace, Mirrorball, FisheyeEquidistant, FisheyeEquisolid, FisheyePolynomial,
    CentralCylindrical, CameraObscura,
    FisheyeOrthographic, FisheyeStereographic, OpencvPinhole, OpencvFisheye,
    UnifiedCamera, EnhancedUnifiedCamera, DoubleSphere, Fisheye624, ThinPrismFisheye, FieldOfView, Division,
    RadialPolynomial, FTheta, OCam, RayTable, RealLens, Omnimax, DomeMaster, Cylindrical,
    StereographicPanorama,
    GeneralLinear, CrossSlit, Pushbroom, Pencil, TwistedOrthographic, Strip, OmnidirectionalStereo,
    Scanner,
]  # fmt: skip
"""All models. ``key`` is Blender's camera or panorama type, or the name of a model that Blender does not have."""

REFUSED = {"CUSTOM": "it is an OSL shader, which only Cycles can run and which cannot be inverted"}
"""Blender's types that no model can represent, and why."""


def find_model(raw: BlenderCamera) -> type[Model]:
    """Return the model of a record: the chosen model of the add-on, or the model of Blender's type.

    With a port it is the model of the lens behind it. Raises InputError for a type without a model, listing the known
    types, and for a port before a model that has no eye.
    """
    key = raw.model or str(raw.settings["panorama_type"] if raw.type == "PANO" else raw.type)
    models = {model.key: model for model in MODELS}
    if key not in models:
        reason = REFUSED.get(key, "the add-on has no model for it")
        raise InputError(f"camera {raw.name!r} is of type {key}: {reason}: choose one of {', '.join(models)}")
    return models[key] if PORT.name not in raw.settings else behind(models[key], PORT.read(raw))
