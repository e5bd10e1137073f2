"""Values of settings from Python and numpy, turned into those of a record."""

import os
import warnings
from collections.abc import Callable, Mapping
from sys import float_info
from typing import Any

import numpy as np

from ..arguments import flag, number, numbers, shape_of, shown, unknown, word
from ..cameras.model import Model
from ..cameras.parts.aperture import DEPTH_OF_FIELD
from ..cameras.parts.port_settings import PORT
from ..cameras.parts.port_settings import SETTINGS as PORTS
from ..cameras.parts.scanners import Angles
from ..cameras.parts.settings import Coefficients, Line, Setting, Whole
from ..memory import require
from ..records import InputError
from . import pixel_time

ANY_MODEL: dict[str, Callable[[Any, str], Any]] = {
    "clip_start": lambda value, name: number(value, name, np.inf),
    "clip_end": lambda value, name: number(value, name, np.inf),
    "lens": lambda value, name: a_number(value, name),
    "pixel_aspect_x": lambda value, name: a_number(value, name),
    "pixel_aspect_y": lambda value, name: a_number(value, name),
    "use_border": flag,
    "use_crop_to_border": flag,
    **dict.fromkeys(
        ("border_min_x", "border_max_x", "border_min_y", "border_max_y"),
        lambda value, name: max(0.0, number(value, name, 1)),
    ),
}
"""Settings that every model has besides its own and those of depth of field and of pixel times, and their checks."""


def declared_by(kind: type[Model], mode: str) -> dict[str, Setting]:
    """Return the settings of a camera by name: those of its model, of depth of field and of a mode of pixel times."""
    return {setting.name: setting for setting in (*kind.SETTINGS, *DEPTH_OF_FIELD, *pixel_time.SETTINGS[mode])}


def checked(model: str, declared: Mapping[str, Setting], settings: Mapping[str, Any]) -> dict[str, Any]:
    """Return settings of a camera as records hold them. Raises InputError for one that does not exist, and for a value
    of another type.
    """
    for key in settings:
        with_ports = [repr(word) for word, read in PORTS.items() if key in {setting.name for setting in read}]
        if with_ports and key not in declared:
            words = " or ".join(with_ports)
            raise InputError(f"{key} of {model} has no effect unless {PORT.name} is {words}: change one of them")
        if key in ("pose", "size"):
            raise InputError(f"{key} is no setting: use with_pose(pose), and for another size crc.camera")
        if key not in declared and key not in (*ANY_MODEL, PORT.name):
            others = PORT.name, pixel_time.MODE.name, "name", "frame", "pose", "size"
            raise unknown(f"setting of {model}", key, dict.fromkeys([*declared, *ANY_MODEL, *others]))
    return {
        key: plain(declared[key], value) if key in declared else ANY_MODEL.get(key, word)(value, key)
        for key, value in with_angles(declared, settings).items()
    }


def with_angles(declared: Mapping[str, Setting], explicit: Mapping[str, Any]) -> dict[str, Any]:
    """Return settings with tables of angles, which are given as numbers in radians, in degrees, as records have them.

    If a number is too large for radians, all are degrees, as in earlier versions, and a FutureWarning says so.
    """
    tables = {
        name: numbers(explicit[name], name)
        for name, setting in declared.items()
        if isinstance(setting, Angles) and not isinstance(explicit.get(name, ""), str)
    }
    widest = {name: setting.widest for name, setting in declared.items() if isinstance(setting, Angles)}
    too_large = [name for name, table in tables.items() if np.abs(table).max(initial=0) > widest[name]]
    if too_large:
        warnings.warn(f"{too_large[0]} is taken as degrees: give radians, as all angles in Python", FutureWarning, 3)
        return dict(explicit)
    return {**explicit, **{name: np.degrees(table) for name, table in tables.items()}}


def plain(setting: Setting, value: Any) -> Any:
    """Return a value as records hold it. Raises InputError, which names the setting, for one of another type."""
    return CONVERSIONS[setting.kind](setting, value)


def a_number(value, name: str) -> float:
    """Return a number of Python or numpy as one of Python. Raises InputError for anything else, also for True."""
    value = value.item() if isinstance(value, np.generic | np.ndarray) and value.ndim == 0 else value
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise InputError(f"{name} is {shown(value)}: it must be a number")
    if isinstance(value, int) and abs(value) > float_info.max:
        raise InputError(f"{name} is {shown(value)}: it must be a number up to {float_info.max:g}")
    return value


def _whole(setting: Whole, value) -> float:
    whole = a_number(value, setting.name)
    if not float(whole).is_integer():  # nor are NaN and infinity
        raise InputError(f"{setting.name} is {shown(value)}: it must be a whole number")
    return whole


def _numbers(setting: Setting, value) -> tuple[float, ...]:
    vector = numbers(value, setting.name)
    if vector.ndim != 1:
        raise InputError(f"{setting.name} is of shape {vector.shape}: it must be a list of numbers")
    return tuple(vector.tolist())


def _text(setting: Setting, value) -> str:
    if isinstance(setting, Coefficients) and not isinstance(value, str):
        return " ".join(map(repr, _numbers(setting, value)))
    return word(value, setting.name)


def _file(setting: Setting, value) -> str:
    return word(os.fspath(value) if isinstance(value, os.PathLike) else value, setting.name)


def line_in_words(setting: Line) -> str:
    """Return what the value of a line has to be."""
    return "points, shape (n, 3)" if setting.sampled else "a point and a direction, shape (2, 3)"


def _line(setting: Line, value) -> tuple[np.ndarray, np.ndarray, list[tuple[int, int]]]:
    """Return a slit's point and direction, or a path's points, as records hold an object's: a path that ends where it
    begins is closed.
    """
    points = numbers(value, setting.name)
    of_shape = points.ndim == 2 and points.shape[1] == 3 and (setting.sampled or len(points) == 2)
    if not of_shape or not np.isfinite(points).all():
        raise InputError(f"{setting.name} is {shape_of(points)}: it must be {line_in_words(setting)}")
    if not setting.sampled:
        return np.stack((points[0], points[0] + points[1])), np.eye(4), [(0, 1)]
    edges = [(k, k + 1) for k in range(len(points) - 1)]
    if len(points) > 2 and np.array_equal(points[0], points[-1]):
        points, edges[-1] = points[:-1], (0, len(points) - 2)
    return points, np.eye(4), edges


def _image(setting: Setting, value) -> np.ndarray:
    gray = numbers(value, setting.name)
    if gray.ndim != 2 or not gray.size:
        raise InputError(
            f"{setting.name} is of shape {gray.shape}: it must be an image, (rows, columns) from the bottom"
        )
    return gray


def _vectors(setting: Setting, value) -> np.ndarray | None:
    if value is None:
        return None
    vectors = numbers(value, setting.name)
    require(2 * vectors.size * vectors.itemsize, f"the numbers of {setting.name}", "give a coarser table")
    return vectors.copy()  # so that it stays as it is


CONVERSIONS: dict[str, Callable[[Any, Any], Any]] = {
    "FLOAT": lambda setting, value: a_number(value, setting.name),
    "INT": _whole,
    "BOOLEAN": lambda setting, value: flag(value, setting.name),
    "ENUM": lambda setting, value: word(value, setting.name, [item.key for item in setting.items]),
    "VECTOR": _numbers,
    "TEXT": _text,
    "FILE": _file,
    "OBJECT": _line,
    "IMAGE": _image,
    "VECTORS": _vectors,
}
"""Functions that turn a value into that of a record, by kind of setting."""
