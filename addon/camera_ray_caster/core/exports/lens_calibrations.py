"""A camera's lens as calibrations: the plain record that the files of programs store."""

from collections.abc import Mapping
from math import pi
from typing import Any

from ..camera.camera import Camera
from ..cameras.equirectangular import Equirectangular
from ..cameras.fisheye_equidistant import FisheyeEquidistant
from ..cameras.fisheye_stereographic import FisheyeStereographic
from ..cameras.model import WindowModel
from ..cameras.opencv_pinhole import OpencvPinhole
from ..cameras.parts.calibrated import Calibrated
from ..cameras.parts.calibration import CALIBRATION
from ..cameras.perspective import Perspective
from ..programs.parts.lens import ANGLES, FRAME_SIZE, Lens, matrix_of


def calibrations(camera: Camera) -> list[Lens]:
    """Return the calibrations that give a camera's rays, in pixels of its picture, closest to its model first.

    Each has the key of its model, the size, fx, fy, cx, cy, skew (as in settings: from the center of the top left
    pixel) and the model's other settings. An equirectangular panorama has the angles of its edges. Blender's fisheyes
    end at a rim; a calibration has rays beyond it.
    """
    x0, _, _, y1 = camera.raster.picture
    corner = {"cx": x0, "cy": camera.raster.height - y1}
    size = dict(zip(FRAME_SIZE, map(float, camera.raster.picture_size), strict=True))
    lenses = [
        lens._replace(settings=lens.settings | size | {name: lens.settings[name] - corner[name] for name in corner})
        for lens in _of_frame(camera)
    ]
    return [_sphere(lens) if lens.model == Equirectangular.key else lens for lens in lenses]


def _of_frame(camera: Camera) -> list[Lens]:
    """Return the calibrations in pixels of the full frame."""
    model: Any = camera.model
    kind = type(model)  # not isinstance: subclasses turn their rays further
    if kind is Perspective:
        return [_lens(model, "OPENCV_PINHOLE")]
    if kind is Equirectangular:
        return [_lens(model, model.key)]
    if kind is FisheyeEquidistant and model.half_fov <= pi:
        return [_lens(model, "OPENCV_FISHEYE", 1 / model.half_fov)]
    if kind is FisheyeStereographic:
        return _unified(model, {"unified_xi": 1.0})
    if isinstance(model, Calibrated | OpencvPinhole) and model.K is not None:
        names = [setting.name for setting in model.SETTINGS if setting not in CALIBRATION]
        settings = {name: camera.settings[name] for name in names}
        return _unified(model, settings) if model.key == "UCM" else [_lens(model, model.key, 1.0, settings)]
    return []


def _unified(model: WindowModel, settings: Mapping[str, float]) -> list[Lens]:
    """Return the unified camera with these settings, and the equivalent enhanced unified camera, if there is one."""
    lenses, xi = [_lens(model, "UCM", 1.0, settings)], settings["unified_xi"]
    if xi >= 0 and not any(value for name, value in settings.items() if name != "unified_xi"):
        alpha = xi / (1 + xi)
        lenses.append(_lens(model, "EUCM", 1 / (1 + xi), {"unified_alpha": alpha, "unified_beta": 1.0}))
    return lenses


def _lens(model: WindowModel, key: str, focal: float = 1.0, settings: Mapping[str, float] | None = None) -> Lens:
    """Return a lens whose focal lengths are ``focal`` units of the model's image plane."""
    (fx, skew, cx), (_, fy, cy), _ = model.window.matrix(model.size[1]).tolist()
    matrix = {"fx": fx * focal, "fy": fy * focal, "cx": cx, "cy": cy, "skew": skew * focal}
    return Lens("", key, matrix | dict(settings or {}))


def _sphere(lens: Lens) -> Lens:
    """Return a panorama by the angles of its edges, of one by pixels per radian and the place of the view direction."""
    fx, fy, cx, cy = matrix_of(lens.settings, 0.5)
    width, height = lens.size
    edges = -cx / fx, (width - cx) / fx, (cy - height) / fy, cy / fy
    size = {name: lens.settings[name] for name in FRAME_SIZE}
    return lens._replace(settings=size | dict(zip(ANGLES, edges, strict=True)))
