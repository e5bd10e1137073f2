"""The values of the names in a model's formula, as recorded numbers: what a page puts into the steps of the formula.

They are those that ``core.lesson`` puts in, except for the facts of reports that take no part in the rays.
"""

import re
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from ..cameras.model import Model, WindowModel
from ..cameras.parts.calibrated import Calibrated
from ..cameras.parts.calibration import PRINCIPAL_POINT, Calibration
from ..cameras.parts.film import Film
from ..maths.recording import NotRecordable
from ..records import BlenderCamera, InputError, Raster

NORMALIZED = "view_x", "view_y"
"""Names of x and y where a step takes them over [-1, 1]², moved by the shift."""


def values_of(model: Model, raw: BlenderCamera, raster: Raster, x, y) -> dict[str, tuple[Any, ...]]:
    """Return one number or three by name, at a pixel: those that the steps name, and that can be recorded."""
    values: dict[str, tuple[Any, ...]] = {}
    for source in (_film, _window, _matrix, _calibration, _own):
        try:
            computed = dict(source(model, raw, raster, x, y))
        except (NotRecordable, InputError, ValueError):  # what cannot be recorded is shown without its number
            continue
        values |= {name: tuple(value) if np.ndim(value) else (value,) for name, value in computed.items()}
    named = {name for step in model.steps for name in NAME.findall(step.symbols)}
    named |= set(NORMALIZED) if any(OVER in step.words for step in model.steps) else set()
    return {name: parts for name, parts in values.items() if name in named}


OVER = "[-1, 1]²"
"""What the words of a step say whose x and y are NORMALIZED."""
NAME = re.compile(r"[A-Za-z_][A-Za-z_0-9]*'?")

Values = Iterator[tuple[str, Any]] | Mapping[str, Any]


def _film(model: Model, raw: BlenderCamera, raster: Raster, x, y) -> Values:
    film = Film.from_blender(raw, raster)
    return {"sensor": film.size, "V": film.fitted_pixels}


def _window(model: Model, raw: BlenderCamera, raster: Raster, x, y) -> Values:
    if not isinstance(model, WindowModel):
        return {}
    window, (width, height) = model.window, model.size
    pitches = window.pitch_x, window.pitch_y
    plane = window.plane_from_pixels(x, y)
    moved = {name: 2 * X / (q * side) for name, X, q, side in zip(NORMALIZED, plane, pitches, model.size, strict=True)}
    half = width * window.pitch_x / 2
    fov = {"fov": 2 * np.arctan(half)} if model.planar else {}  # others have a setting of this name
    return moved | fov | {"aspect": height * window.pitch_y / (2 * half)}


def _matrix(model: Model, raw: BlenderCamera, raster: Raster, x, y) -> Values:
    """Of the frame's pixels, as the formula's x and y; the settings are of the calibrated picture's."""
    if model.K is None:
        return {}
    (fx, skew, cx), (_, fy, cy), _ = model.K
    return {"fx": fx, "skew": skew, "cx": cx, "fy": fy, "cy": cy}


def _calibration(model: Model, raw: BlenderCamera, raster: Raster, x, y) -> Values:
    if not isinstance(model, Calibrated):
        return {}
    calibration = Calibration.from_blender(raw, raster, settings=PRINCIPAL_POINT)
    return dict(zip(("x_0", "y_0", "s_x", "s_y"), calibration.center + calibration.scale, strict=True))


def _own(model: Model, raw: BlenderCamera, raster: Raster, x, y) -> Values:
    return model.formula_values(x, y)
