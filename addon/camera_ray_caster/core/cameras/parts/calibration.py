"""A calibrated lens: K and the distortion's coefficients, from the camera's settings or from a file of OpenCV's.

K is in OpenCV's convention: y down, (0, 0) the center of the top left pixel, focal lengths in pixels of the calibrated
picture. A frame of another size is that picture scaled to it, each axis for itself: pixel coordinates grow in
proportion, measured from the corner of the frame. Blender's lens, sensor and shift do not count.
Reference: OpenCV documentation, Camera Calibration and 3D Reconstruction; Fisheye camera model.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from math import radians
from reprlib import repr as shortened

from ...records import BlenderCamera, InputError, Raster
from .affine import AffineWindow
from .filestorage import read_entries
from .film import FARTHEST_PIXELS, Window
from .settings import FilePath, Number, Whole

FOCAL = (
    Number("fx", "Focal Length X", "In pixels of the calibrated picture", 1500.0, 1e-3, unit="pixels", digits=3),
    Number("fy", "Y", "In pixels of the calibrated picture", 1500.0, 1e-3, unit="pixels", digits=3),
)
CENTER = (
    Number(
        "cx", "Center X", "From the center of the top left pixel, to the right", 959.5, -1e6, unit="pixels", digits=3
    ),
    Number("cy", "Y", "From the center of the top left pixel, down", 539.5, -1e6, unit="pixels", digits=3),
)
SIZE = (
    Whole("calibration_width", "Width", "Of the calibrated picture, pixels; 0 is the frame's", 1920, 0, unit="pixels"),
    Whole(
        "calibration_height", "Height", "Of the calibrated picture, pixels; 0 is the frame's", 1080, 0, unit="pixels"
    ),
)
FILE = FilePath(
    "calibration_file",
    "Calibration",
    "YAML or JSON as OpenCV writes it, with all its digits; empty: the numbers below",
    "",
)
SKEW = Number(
    "skew", "Skew", "Of the camera matrix, its second number; in pixels of the calibrated picture", 0.0, unit="pixels",
    digits=3,
)  # fmt: skip
PRINCIPAL_POINT = (*SIZE, *CENTER)
MATRIX = (*SIZE, *FOCAL, *CENTER, SKEW)
CALIBRATION = (FILE, *MATRIX)
"""The settings of the calibrated picture: without a camera matrix, with one, and with a file. Where there is a file,
its numbers count.
"""


def _coefficient(name: str, text: str) -> Number:
    return Number(name, name.upper(), text, 0.0, digits=6, step=0.1)


Linear = tuple[tuple[float, float], tuple[float, float]]
"""A matrix, its rows."""

STEEPEST = radians(80)
"""Beyond which a tilted sensor is no picture to calibrate with."""

LARGEST = 1e30
"""Of a calibration's numbers: products of three of them have to be numbers, too."""

K1, K2, K3 = (_coefficient(name, "Radial") for name in ("k1", "k2", "k3"))
K4, K5, K6 = (_coefficient(name, "Radial: of a pinhole's denominator, or a fisheye's") for name in ("k4", "k5", "k6"))
P1, P2 = (_coefficient(name, "Tangential") for name in ("p1", "p2"))
S1, S2 = (_coefficient(name, "Thin prism, across") for name in ("s1", "s2"))
S3, S4 = (_coefficient(name, "Thin prism, down") for name in ("s3", "s4"))
RADIAL_TANGENTIAL = K1, K2, P1, P2, K3, K4, K5, K6, S1, S2, S3, S4
TAU_X, TAU_Y = (
    Number(f"tau_{axis}", f"Tau {axis.upper()}", text, 0.0, -STEEPEST, STEEPEST, "angle", digits=4)
    for axis, text in (("x", "Of the sensor, about its x axis"), ("y", "Of the sensor, about its y axis"))
)
PINHOLE = (*RADIAL_TANGENTIAL, TAU_X, TAU_Y)
FISHEYE = K1, K2, K3, K4
"""The distortion, in the order of OpenCV's vector of coefficients; all without unit."""

MATRIX_NAMES = ("cameramatrix", "k", "m1", "intrinsicmatrix")
DISTORTION_NAMES = ("distortioncoefficients", "distcoeffs", "distortion", "d", "d1")
WIDTH_NAMES, HEIGHT_NAMES = ("imagewidth", "width"), ("imageheight", "height")
FISHEYE_NAMES, MODEL_NAMES = ("fisheyemodel", "fisheye", "usefisheye"), ("distortionmodel", "cameramodel", "model")
FISHEYE_MODELS = ("fisheye", "equidistant", "kannala_brandt", "opencv_fisheye")
"""Names of entries in a file, without underscores, and what they say of a fisheye; small letters. OpenCV's own
samples do not agree on them."""


@dataclass(frozen=True)
class Calibration:
    """K, the size of its picture, and the coefficients by name. Without focal lengths they are 1: pixels."""

    fx: float
    fy: float
    cx: float
    cy: float
    skew: float
    width: float
    height: float
    coefficients: dict[str, float]

    @classmethod
    def from_blender(
        cls, raw: BlenderCamera, raster: Raster, distortion: tuple[Number, ...] = (), settings=CALIBRATION
    ) -> Calibration:
        """Build it from the settings, or from the file that they name; ``distortion``: the model's coefficients.

        Raises InputError for a setting, a file or an entry of it that is missing or without meaning, by its name.
        """
        path = FILE.read(raw) if FILE in settings else ""
        values = {"fx": 1.0, "fy": 1.0, "skew": 0.0} | (
            _file_values(path, distortion) if path
            else {setting.name: setting.read(raw) for setting in (*SIZE, *FOCAL) if setting in settings}
            | {setting.name: setting.read(raw, high=FARTHEST_PIXELS) for setting in CENTER}
            | {setting.name: setting.read(raw, max(setting.low, -LARGEST), min(setting.high, LARGEST))
               for setting in (SKEW, *distortion) if setting in (*settings, *distortion)}
        )  # fmt: skip
        return cls(
            **{setting.name: values[setting.name] for setting in (*FOCAL, *CENTER, SKEW)},
            width=values["calibration_width"] or raster.width,
            height=values["calibration_height"] or raster.height,
            coefficients={setting.name: values[setting.name] for setting in distortion},
        )

    def window(self, raster: Raster, linear: Linear | None = None) -> Window:
        """Return the window of (x, -y) of OpenCV's normalized, distorted image coordinates: y up.

        linear: what brings these to the calibrated picture's pixels from its center, K's if it is not given.
        """
        scale_x, scale_y = raster.width / self.width, raster.height / self.height
        center = (self.cx + 0.5) * scale_x, (self.height - (self.cy + 0.5)) * scale_y
        (xx, xy), (yx, yy) = linear or ((self.fx, self.skew), (0.0, self.fy))
        if xy == yx == 0:
            return Window(*center, 1 / (xx * scale_x), 1 / (yy * scale_y))
        volume = xx * yy - xy * yx
        pitch, shear = (yy / volume / scale_x, xx / volume / scale_y), (xy / volume / scale_y, yx / volume / scale_x)
        return AffineWindow(*center, *pitch, *shear)


def _file_values(path: str, distortion: tuple[Number, ...]) -> dict[str, float]:
    """Return the settings that a file stands for."""
    names = [setting.name for setting in distortion]
    entries = {re.sub("[_-]", "", name).lower(): (name, value) for name, value in read_entries(path).items()}
    _check_model(entries, path, fisheye=distortion == FISHEYE)
    matrix = _numbers(entries, MATRIX_NAMES, path)
    is_plain = len(matrix) == 9 and [matrix[3], *matrix[6:]] == [0, 0, 0, 1]
    if not is_plain or min(matrix[0], matrix[4]) < 1 / LARGEST:
        raise InputError(
            f"the camera matrix in {path!r} is {shortened(matrix)}: "
            "it must be fx skew cx, 0 fy cy, 0 0 1, with fx and fy above 0"
        )
    if max(map(abs, (matrix[2], matrix[5]))) > FARTHEST_PIXELS:
        raise InputError(
            f"the camera matrix in {path!r} is {shortened(matrix)}: cx and cy must be up to {FARTHEST_PIXELS:.0f}"
        )
    found = _numbers(entries, DISTORTION_NAMES, path)
    if any(found[len(names) :]):
        raise InputError(
            f"{path!r} has {len(found)} distortion coefficients: only {', '.join(names)} may be other than 0"
        )
    values = {"fx": matrix[0], "skew": matrix[1], "fy": matrix[4], "cx": matrix[2], "cy": matrix[5]}
    values |= dict.fromkeys(names, 0.0) | dict(zip(names, found, strict=False))
    for setting in distortion:
        if not setting.low <= values[setting.name] <= setting.high:
            said, allowed = setting.in_words(values[setting.name]), setting.range_in_words(setting.low, setting.high)
            raise InputError(f"{setting.name} in {path!r} is {said}: it must be {allowed}")
    for setting, spellings in zip(SIZE, (WIDTH_NAMES, HEIGHT_NAMES), strict=True):
        size = values[setting.name] = _numbers(entries, spellings, path)[0]
        if size <= 0:
            raise InputError(f"{spellings[0]} in {path!r} is {size}: it must be above 0")
    return values


def _numbers(entries, spellings, path: str) -> list[float]:
    """Return the numbers of the first entry of these names; InputError where it is missing or not of finite numbers."""
    for name, value in (entries[spelling] for spelling in spellings if spelling in entries):
        items = value if isinstance(value, list) else [value]
        try:
            numbers = [float(item) for item in items]
        except (TypeError, ValueError) as error:
            raise InputError(f"{name} in {path!r} is {shortened(value)}: it must be of numbers") from error
        if not numbers or not all(abs(one) <= LARGEST for one in numbers):
            limits = f"finite numbers, up to {LARGEST:g}"
            raise InputError(f"{name} in {path!r} is {shortened(value)}: it must be of {limits}")
        return numbers
    raise InputError(f"{path!r} has no {spellings[0]} (known names, in any case: {', '.join(spellings)})")


def _check_model(entries, path: str, fisheye: bool) -> None:
    """Raise InputError where the file says that it is for the other of OpenCV's models."""
    told = [_numbers(entries, FISHEYE_NAMES, path)[0] != 0] if set(FISHEYE_NAMES) & set(entries) else []
    told += [str(entries[name][1]).lower() in FISHEYE_MODELS for name in MODEL_NAMES if name in entries]
    if told and fisheye not in told:
        right, wrong = ("Pinhole", "Fisheye") if fisheye else ("Fisheye", "Pinhole")
        raise InputError(f"{path!r} is a calibration for OpenCV {right}, not OpenCV {wrong}: choose that model")
