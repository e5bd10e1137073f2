"""Where the fit of a model begins: a lens with the same scale about the viewing direction."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from ..cameras.model import Model
from ..cameras.parts.calibration import CENTER, FOCAL, SIZE, UNIT
from ..cameras.parts.film import OFF_AXIS, Film
from ..cameras.parts.parameters import defaults_of, with_values
from ..cameras.parts.port_settings import PORT
from ..records import BlenderCamera, InputError
from .camera import Camera
from .fit_search import STILL
from .jacobian import of_projection

AHEAD = np.array([(0.0, 0.0, -1.0)])


def guesses(camera: Camera, kind: type[Model], explicit: Mapping[str, Any]) -> list[BlenderCamera]:
    """Return records of cameras of a model at the same place, with the given settings, and with the scale and the
    center of a camera. Raises InputError for a camera without rays about its viewing direction.
    """
    raw = camera.record
    settings = defaults_of(kind.SETTINGS)
    settings |= {name: value for name, value in raw.settings.items() if name not in (*settings, OFF_AXIS, PORT.name)}
    fx, fy, cx, cy = _matrix(camera)
    if UNIT in kind.SETTINGS:
        width, height = camera.raster.size
        numbers = (width, height, cx - 0.5, height - cy - 0.5, fx, fy)
        settings |= dict(zip((setting.name for setting in (*SIZE, *CENTER, *FOCAL)), numbers, strict=True))
    start = replace(raw, type="PERSP", model=kind.key, settings=settings, shift_x=0.0, shift_y=0.0)
    film = Film.from_blender(start, camera.raster)
    start = replace(start, lens=fx * film.size / film.fitted_pixels)
    shapes = _shapes(kind.key, fx, fy) if UNIT in kind.SETTINGS else [{}]
    return [with_values(start, {**shape, **explicit}) for shape in shapes]


def _shapes(key: str, fx: float, fy: float) -> list[dict[str, Any]]:
    """Return further settings of a calibrated lens, one or more, since sums of squares may have several minima. With
    the first ones it sees more than half of all directions.
    """
    if key == "UCM":
        return [{"unified_xi": xi, "fx": (1 + xi) * fx, "fy": (1 + xi) * fy} for xi in (1.0, 0.0, 2.0)]
    if key == "DOUBLE_SPHERE":
        scales = ((xi, 1 + xi / 2) for xi in (-0.2, 0.3))
        return [{"unified_xi": xi, "fx": scale * fx, "fy": scale * fy} for xi, scale in scales]
    if key == "FTHETA":
        return [{"ftheta_angle_to_radius": f"0 {fy!r} 0 0 0 0", "ftheta_c": fx / fy}]
    if key == "OCAM":  # z = -r / tan(r / fx), of angles that are even in the radius
        return [{"ocam_polynomial": f"{-fx!r} 0 {1 / (3 * fx)!r} 0 0", "ocam_c": fy / fx}]
    return [{}]


def _matrix(camera: Camera) -> tuple[float, float, float, float]:
    """Return the pixels per unit of slope in x and in y, and the pixel, of the viewing direction."""
    with np.errstate(all="ignore"):  # NaN means not seen
        pixel = camera.model.project(AHEAD)
        slopes = of_projection(camera.model, STILL, AHEAD, pixel)[0]
    numbers = abs(slopes[0, 0]), abs(slopes[1, 1]), *pixel[0]
    if not np.isfinite(numbers).all() or not min(numbers[:2]) > 0:
        raise InputError(
            f"camera {camera.name!r} does not see its own viewing direction, about which fits begin: turn the camera"
        )
    return tuple(map(float, numbers))  # type: ignore[return-value]
