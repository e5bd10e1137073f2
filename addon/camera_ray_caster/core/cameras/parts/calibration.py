"""A calibrated lens: K and the distortion's coefficients, from the camera's settings or from a file of OpenCV's.

K is in OpenCV's convention: y down, (0, 0) the center of the top left pixel, focal lengths in pixels of the calibrated
picture. A frame of another size is that picture scaled to it, each axis for itself: pixel coordinates grow in
proportion, measured from the corner of the frame. Blender's lens, sensor and shift do not count.
Reference: OpenCV documentation, Camera Calibration and 3D Reconstruction; Fisheye camera model.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from math import isfinite

from ...records import BlenderCamera, InputError, Raster
from .filestorage import read_entries
from .film import Window
from .settings import number, positive

FOCAL = ("fx", "fy")
CENTER = ("cx", "cy")
SIZE = ("calibration_width", "calibration_height")
"""Settings of the calibrated picture, in pixels. A size of 0 stands for the frame's own."""

RADIAL_TANGENTIAL = ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4")
FISHEYE = ("k1", "k2", "k3", "k4")
"""Settings of the distortion, in the order of OpenCV's vector of coefficients; all without unit."""

FILE = "calibration_file"
"""The setting that holds the path of a file; where it is not empty the file's numbers count."""

MATRIX_NAMES = ("cameramatrix", "k", "m1", "intrinsicmatrix")
DISTORTION_NAMES = ("distortioncoefficients", "distcoeffs", "distortion", "d", "d1")
WIDTH_NAMES, HEIGHT_NAMES = ("imagewidth", "width"), ("imageheight", "height")
FISHEYE_NAMES, MODEL_NAMES = ("fisheyemodel", "fisheye", "usefisheye"), ("distortionmodel", "cameramodel", "model")
FISHEYE_MODELS = ("fisheye", "equidistant", "kannala_brandt", "opencv_fisheye")
"""Names of entries in a file, without underscores, and what they say of a fisheye; small letters. OpenCV's own
samples do not agree on them."""


@dataclass(frozen=True)
class Calibration:
    """K, the size of its picture, and the coefficients by name."""

    fx: float
    fy: float
    cx: float
    cy: float
    width: float
    height: float
    coefficients: dict[str, float]

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster, names: tuple[str, ...]) -> Calibration:
        """Build it from the settings, or from the file that they name; ``names`` are the model's coefficients.

        Raises InputError for a setting, a file or an entry of it that is missing or without meaning, by its name.
        """
        path = raw.settings.get(FILE)
        if path:
            values = _file_values(str(path), names)
        else:
            values = {name: number(raw, name) for name in (*CENTER, *names)}
            values |= {name: positive(raw, name) for name in FOCAL}
            values |= {name: number(raw, name, low=0.0) for name in SIZE}
        return cls(
            **{name: values[name] for name in (*FOCAL, *CENTER)},
            width=values[SIZE[0]] or raster.width,
            height=values[SIZE[1]] or raster.height,
            coefficients={name: values[name] for name in names},
        )

    def window(self, raster: Raster) -> Window:
        """Return the window of (x, -y) of OpenCV's normalized, distorted image coordinates: y up."""
        scale_x, scale_y = raster.width / self.width, raster.height / self.height
        return Window(
            (self.cx + 0.5) * scale_x,
            (self.height - (self.cy + 0.5)) * scale_y,
            1 / (self.fx * scale_x),
            1 / (self.fy * scale_y),
        )


def _file_values(path: str, names: tuple[str, ...]) -> dict[str, float]:
    """Return the settings that a file stands for."""
    entries = {re.sub("[_-]", "", name).lower(): (name, value) for name, value in read_entries(path).items()}
    _check_model(entries, path, fisheye=names == FISHEYE)
    matrix = _numbers(entries, MATRIX_NAMES, path)
    if len(matrix) != 9 or matrix[1] or matrix[3:4] != [0] or matrix[6:] != [0, 0, 1] or min(matrix[0], matrix[4]) <= 0:
        raise InputError(
            f"the camera matrix in {path!r} is {matrix}: it must be fx 0 cx, 0 fy cy, 0 0 1, with fx and fy above 0"
        )
    found = _numbers(entries, DISTORTION_NAMES, path)
    if any(found[len(names) :]):
        raise InputError(
            f"{path!r} has {len(found)} distortion coefficients, {found}: only {', '.join(names)} may be other than 0"
        )
    values = dict(zip((*FOCAL, *CENTER), (matrix[0], matrix[4], matrix[2], matrix[5]), strict=True))
    values |= dict.fromkeys(names, 0.0) | dict(zip(names, found, strict=False))
    for name, spellings in zip(SIZE, (WIDTH_NAMES, HEIGHT_NAMES), strict=True):
        values[name] = _numbers(entries, spellings, path)[0]
        if values[name] <= 0:
            raise InputError(f"{spellings[0]} in {path!r} is {values[name]}: it must be above 0")
    return values


def _numbers(entries, spellings, path: str) -> list[float]:
    """Return the numbers of the first entry of these names; InputError where it is missing or not of finite numbers."""
    for name, value in (entries[spelling] for spelling in spellings if spelling in entries):
        items = value if isinstance(value, list) else [value]
        try:
            numbers = [float(item) for item in items]
        except (TypeError, ValueError) as error:
            raise InputError(f"{name} in {path!r} is {value!r}: it must be of numbers") from error
        if not numbers or not all(map(isfinite, numbers)):
            raise InputError(f"{name} in {path!r} is {value!r}: it must be of finite numbers")
        return numbers
    raise InputError(f"{path!r} has no {spellings[0]} (known names, in any case: {', '.join(spellings)})")


def _check_model(entries, path: str, fisheye: bool) -> None:
    """Raise InputError where the file says that it is for the other of OpenCV's models."""
    told = [_numbers(entries, FISHEYE_NAMES, path)[0] != 0] if set(FISHEYE_NAMES) & set(entries) else []
    told += [str(entries[name][1]).lower() in FISHEYE_MODELS for name in MODEL_NAMES if name in entries]
    if told and fisheye not in told:
        right, wrong = ("Pinhole", "Fisheye") if fisheye else ("Fisheye", "Pinhole")
        raise InputError(f"{path!r} is a calibration for OpenCV {right}, not OpenCV {wrong}: choose that model")
