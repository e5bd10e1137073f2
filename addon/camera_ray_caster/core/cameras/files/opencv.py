"""YAML and JSON as written by OpenCV's calibration samples, and by ROS, whose CameraInfo has the same entries.

The samples do not agree on names. Often only the model that the user chose tells which of OpenCV's models a file is
for; a file with an entry xi is omnidir's. The center of the first pixel is (0, 0).
References: OpenCV documentation, Camera Calibration and 3D Reconstruction; Fisheye camera model; Omnidirectional Camera
Calibration; ROS documentation, sensor_msgs/CameraInfo.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from reprlib import repr as shortened

from ...records import InputError
from ..parts.calibration import LARGEST
from ..parts.filestorage import flat
from ..parts.film import FARTHEST_PIXELS
from .document import Document, Lens, mapping, matrix, numbers_of, one_of_several

TERMS = {
    "OPENCV_PINHOLE": ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4", "tau_x", "tau_y"),
    "OPENCV_FISHEYE": ("k1", "k2", "k3", "k4"),
    "UCM": ("k1", "k2", "p1", "p2"),
}
"""Our models and their settings, in the order of OpenCV's vector of coefficients."""

NO_DISTORTION = (0.0,)
"""What an empty list of coefficients stands for."""
COUNTS = {"OPENCV_PINHOLE": (4, 5, 8, 12, 14), "OPENCV_FISHEYE": (4,), "UCM": (4,)}
"""How many coefficients OpenCV takes; of zeros any number."""

MATRIX_NAMES = ("cameramatrix", "k", "m1", "intrinsicmatrix")
DISTORTION_NAMES = ("distortioncoefficients", "distcoeffs", "distortion", "d", "d1")
WIDTH_NAMES, HEIGHT_NAMES = ("imagewidth", "width"), ("imageheight", "height")
FISHEYE_NAMES, MODEL_NAMES = ("fisheyemodel", "fisheye", "usefisheye"), ("distortionmodel", "cameramodel", "model")
FISHEYE_MODELS = ("fisheye", "equidistant", "equi", "kannala_brandt", "kannala_brandt4", "opencv_fisheye")
PINHOLE_MODELS = (
    "plumb_bob", "rational_polynomial", "thin_prism", "radtan", "pinhole", "opencv", "opencv_pinhole", "none",
)  # fmt: skip
"""Names of entries, without underscores, and of models in them; lower case."""


def read(document: Document, key: str) -> list[Lens]:
    """Return the lens of a document, or both of a stereo pair; see the package. Every JSON or YAML file is read as one
    of OpenCV's.
    """
    entries: dict[str, tuple] = {}
    for name, value in document.entries.items():
        before = entries.setdefault(re.sub("[_-]", "", name).lower(), (name, value))
        if before[0] != name:
            raise document.refusal(f"it has {before[0]} and {name}: leave one out")
    if "m2" not in entries:
        return [_lens(document, "", entries, key)]
    pair = []
    for side, other in ("12", "21"):
        own = {name.replace(side, "1") if name in ("m2", "d2") else name: entries[name]
               for name in entries if name not in (f"m{other}", f"d{other}")}  # fmt: skip
        pair.append(one_of_several(side, _lens, document, side, own, key))
    return pair


def _lens(document: Document, name: str, entries: dict[str, tuple], key: str) -> Lens:
    values = _numbers(entries, MATRIX_NAMES, document.path)
    is_plain = len(values) == 9 and [values[3], *values[6:]] == [0, 0, 0, 1]
    said = f"the camera matrix in {document.path!r} is {shortened(values)}"
    if not is_plain or min(values[0], values[4]) < 1 / LARGEST:
        raise InputError(f"{said}: it must be fx skew cx, 0 fy cy, 0 0 1, with fx and fy above 0")
    if max(map(abs, (values[2], values[5]))) > FARTHEST_PIXELS:
        raise InputError(f"{said}: cx and cy must be up to {FARTHEST_PIXELS:.0f}")
    model = _model(entries, document.path, key)
    names = TERMS[model]
    found = _numbers(entries, DISTORTION_NAMES, document.path, empty=NO_DISTORTION)
    if any(found) and str(entries.get("distortionmodel", ("", ""))[1]).lower() == "none":
        raise document.refusal("it has distortion coefficients and distortion_model none: say which it is")
    if any(found) and len(found) not in COUNTS[model]:
        counts, order = " or ".join(map(str, COUNTS[model])), ", ".join(names)
        raise InputError(
            f"{document.path!r} has {len(found)} distortion coefficients: give {counts}, in the order {order}"
        )
    settings = {"skew": values[1], **dict(zip(names, found, strict=False))}
    if model == "UCM":
        settings["unified_xi"] = _numbers(entries, ("xi",), document.path)[0]
    x, y, width, height = _region(document, entries)
    camera_matrix = matrix(values[0], values[4], values[2] - x, values[5] - y)
    return Lens(name, model, document.size(width, height) | camera_matrix | settings)


def _region(document: Document, entries) -> list[float]:
    """Return x, y, width and height of the picture in the calibrated one: all of it, unless ROS's roi tells a part."""
    width, height = (_numbers(entries, spellings, document.path)[0] for spellings in (WIDTH_NAMES, HEIGHT_NAMES))
    name, region = entries.get("roi", ("roi", {}))
    region = mapping(region)
    x, y, *size = (document.number(region, one, 0.0) for one in ("x_offset", "y_offset", "width", "height"))
    size = size if any(size) else [width, height]
    if min(x, y) < 0 or x + size[0] > width or y + size[1] > height:
        raise document.refusal(f"{name} reaches beyond the picture of {width:g} x {height:g}")
    return [x, y, *size]


def _model(entries, path: str, key: str) -> str:
    """Return the model that a file names; else the chosen model, or the pinhole if that is not OpenCV's."""
    if "xi" in entries:
        return "UCM"
    told = [_numbers(entries, FISHEYE_NAMES, path)[0] != 0] if set(FISHEYE_NAMES) & set(entries) else []
    for own, value in (entries[name] for name in MODEL_NAMES if name in entries):
        word = str(value).lower()
        if word not in (*FISHEYE_MODELS, *PINHOLE_MODELS):
            known = ", ".join((*PINHOLE_MODELS, *FISHEYE_MODELS))
            raise InputError(f"{own} in {path!r} is {shortened(value)}: it must be one of {known}")
        told.append(word in FISHEYE_MODELS)
    pinhole, fisheye, _ = TERMS
    coefficients = _numbers(entries, DISTORTION_NAMES, path, empty=NO_DISTORTION)
    may_be_fisheye = len(coefficients) in COUNTS[fisheye] or not any(coefficients)
    chosen = fisheye if key == fisheye and may_be_fisheye else pinhole
    return chosen if not told or (chosen == fisheye) in told else {pinhole: fisheye, fisheye: pinhole}[chosen]


def _numbers(entries, spellings, path: str, empty: Sequence[float] = ()) -> list[float]:
    """Return the numbers of the entry with one of these names, or ``empty`` if it is an empty list. Raises InputError
    if it is missing, not of numbers, or there twice with different values.
    """
    given = [entries[spelling] for spelling in spellings if spelling in entries]
    for name, value in given:
        if repr(flat(value, name, path)) != repr(flat(given[0][1], given[0][0], path)):
            raise InputError(f"calibration file {path!r}: {given[0][0]} and {name} differ: leave one out")
    for name, value in given:
        numbers = list(empty) if empty and value == [] else numbers_of(flat(value, name, path))
        if not numbers or not all(abs(one) <= LARGEST for one in numbers):
            limits = f"finite numbers, up to {LARGEST:g}"
            raise InputError(f"{name} in {path!r} is {shortened(value)}: it must be of {limits}")
        return numbers
    raise InputError(f"{path!r} has no {spellings[0]} (known names, in any case: {', '.join(spellings)})")
