"""YAML and JSON as OpenCV's calibration samples write them, and ROS, whose CameraInfo has the same entries.

The samples do not agree on names. Which of OpenCV's models it is often follows from the model that is chosen alone; a
file with an entry xi is of omnidir. The center of its first pixel is (0, 0).
References: OpenCV documentation, Camera Calibration and 3D Reconstruction; Fisheye camera model; Omnidirectional Camera
Calibration; ROS documentation, sensor_msgs/CameraInfo.
"""

from __future__ import annotations

import re
from reprlib import repr as shortened

from ...records import InputError
from ..parts.calibration import LARGEST
from ..parts.filestorage import flat
from ..parts.film import FARTHEST_PIXELS
from .document import Document, Lens, matrix, size

TERMS = {
    "OPENCV_PINHOLE": ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4", "tau_x", "tau_y"),
    "OPENCV_FISHEYE": ("k1", "k2", "k3", "k4"),
    "UCM": ("k1", "k2", "p1", "p2"),
}
"""Our models and their settings, in the order of OpenCV's vector of coefficients."""

MATRIX_NAMES = ("cameramatrix", "k", "m1", "intrinsicmatrix")
DISTORTION_NAMES = ("distortioncoefficients", "distcoeffs", "distortion", "d", "d1")
WIDTH_NAMES, HEIGHT_NAMES = ("imagewidth", "width"), ("imageheight", "height")
FISHEYE_NAMES, MODEL_NAMES = ("fisheyemodel", "fisheye", "usefisheye"), ("distortionmodel", "cameramodel", "model")
FISHEYE_MODELS = ("fisheye", "equidistant", "kannala_brandt", "opencv_fisheye")
"""Names of entries, without underscores, and what they say of a fisheye; small letters."""


def read(document: Document, key: str) -> list[Lens]:
    """See the package; every JSON or YAML file is taken for one of OpenCV's."""
    entries = {re.sub("[_-]", "", name).lower(): (name, flat(value)) for name, value in document.entries.items()}
    model = _model(entries, document.path, key)
    names = TERMS[model]
    values = _numbers(entries, MATRIX_NAMES, document.path)
    is_plain = len(values) == 9 and [values[3], *values[6:]] == [0, 0, 0, 1]
    said = f"the camera matrix in {document.path!r} is {shortened(values)}"
    if not is_plain or min(values[0], values[4]) < 1 / LARGEST:
        raise InputError(f"{said}: it must be fx skew cx, 0 fy cy, 0 0 1, with fx and fy above 0")
    if max(map(abs, (values[2], values[5]))) > FARTHEST_PIXELS:
        raise InputError(f"{said}: cx and cy must be up to {FARTHEST_PIXELS:.0f}")
    found = _numbers(entries, DISTORTION_NAMES, document.path)
    if any(found[len(names) :]):
        raise InputError(
            f"{document.path!r} has {len(found)} distortion coefficients: only {', '.join(names)} may be other than 0"
        )
    settings = {"skew": values[1], **dict(zip(names, found, strict=False))}
    if model == "UCM":
        settings["unified_xi"] = _numbers(entries, ("xi",), document.path)[0]
    width, height = (_numbers(entries, spellings, document.path)[0] for spellings in (WIDTH_NAMES, HEIGHT_NAMES))
    for side, spellings in ((width, WIDTH_NAMES), (height, HEIGHT_NAMES)):
        if side <= 0:
            raise InputError(f"{spellings[0]} in {document.path!r} is {side}: it must be above 0")
    return [Lens("", model, size(width, height) | matrix(values[0], values[4], values[2], values[5]) | settings)]


def _model(entries, path: str, key: str) -> str:
    """Return the model that a file says it is for; where it does not say, the chosen one if it is OpenCV's."""
    if "xi" in entries:
        return "UCM"
    told = [_numbers(entries, FISHEYE_NAMES, path)[0] != 0] if set(FISHEYE_NAMES) & set(entries) else []
    told += [str(entries[name][1]).lower() in FISHEYE_MODELS for name in MODEL_NAMES if name in entries]
    pinhole, fisheye, _ = TERMS
    chosen = key if key in (pinhole, fisheye) else pinhole
    return chosen if not told or (chosen == fisheye) in told else {pinhole: fisheye, fisheye: pinhole}[chosen]


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
