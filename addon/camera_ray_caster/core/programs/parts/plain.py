"""Calibrations by plain entries: as OpenCV's samples write them, and other programs by the same names.

A calibration has a camera matrix, or fx, fy, cx and cy; it may have distortion coefficients, in OpenCV's order or by
name, and the size of its pictures. An intrinsic_matrix is stored by columns. Names differ: see ``spelled``.
Four coefficients may be a pinhole's or a fisheye's; if the file does not name its model, the chosen one decides. A file
with an entry xi is omnidir's. The center of the first pixel is (0, 0).
References: OpenCV documentation, Camera Calibration and 3D Reconstruction; Fisheye camera model; Omnidirectional Camera
Calibration.
"""

from reprlib import repr as shortened
from typing import cast

from ...cameras.parts.calibration import LARGEST
from ...cameras.parts.film import FARTHEST_PIXELS
from ...records import InputError
from . import spelled
from .document import Document
from .fields import Fields
from .lens import Lens, matrix, one_of_several
from .spelled import Spelled, plain_name

TERMS = {
    "OPENCV_PINHOLE": ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4", "tau_x", "tau_y"),
    "OPENCV_FISHEYE": ("k1", "k2", "k3", "k4"),
    "UCM": ("k1", "k2", "p1", "p2"),
}
"""Our models and their settings, in the order of OpenCV's vector of coefficients."""

BY_NUMBER = "d"
"""What the numbers of coefficients follow in the settings of SVO: d0, d1, ..."""
BEFORE_TERMS = "", "distortion", "dist", "radial", "tangential", "lens"
"""What may stand before the name of a coefficient."""
LISTS = {"radial": ("k1", "k2", "k3", "k4", "k5", "k6"), "radialdistortion": ("k1", "k2", "k3", "k4", "k5", "k6"),
         "tangential": ("p1", "p2"), "tangentialdistortion": ("p1", "p2")}  # fmt: skip
"""Lists of some coefficients."""

NO_DISTORTION = (0.0,)
"""What an empty list of coefficients stands for."""
COUNTS = {"OPENCV_PINHOLE": (4, 5, 8, 12, 14), "OPENCV_FISHEYE": (4,), "UCM": (4,)}
"""How many coefficients OpenCV takes; of zeros any number."""

APART = 1e-3
"""Part by which a camera matrix and numbers beside it may differ: they may be rounded."""

LEAST = 16
"""Pixels from which on sides of a picture and focal lengths are taken for such: smaller ones may be parts of a size."""

PINHOLE, FISHEYE, _ = TERMS
FISHEYE_NAMES = ("fisheyemodel", "fisheye", "usefisheye", "isfisheye")
MODEL_NAMES = ("distortionmodel", "cameramodel", "model", "cameratype", "distortiontype", "type")
DISTORTION_NAMES = "distortionmodel", "distortiontype"
"""Those of MODEL_NAMES that name the distortion alone, whatever the camera."""
FISHEYE_MODELS = (
    "fisheye", "equidistant", "equi", "kannala_brandt", "kannala_brandt4", "kannala_brandt8", "opencv_fisheye", "kb4",
)  # fmt: skip
PINHOLE_MODELS = (
    "plumb_bob", "rational_polynomial", "thin_prism", "radtan", "radial-tangential", "pinhole", "opencv",
    "opencv_pinhole", "perspective", "rectified", "rectilinear", "brown_conrady", "none",
)  # fmt: skip
KNOWN_MODELS = {plain_name(word): FISHEYE if word in FISHEYE_MODELS else PINHOLE
                for word in (*FISHEYE_MODELS, *PINHOLE_MODELS, "")}  # fmt: skip
"""Names of models; simulators leave them empty."""
INVERSE = "inversebrownconrady", "modifiedbrownconrady"
"""RealSense's models that are not OpenCV's unless all coefficients are 0."""


def has_plain(document: Document) -> bool:
    """Whether a document has a calibration by plain entries, or entries that contradict each other."""
    if not len(document.entries):
        return False
    try:
        return all(camera.has(spelled.FX) or camera.has_list(spelled.MATRIX, spelled.DISTORTION)
                   for _, camera in _cameras(document))  # fmt: skip
    except InputError:
        return True


def plain_lens(document: Document) -> Lens:
    """Return the only lens of a document. Raises InputError."""
    return (plain_lenses(document) or [])[0]


def plain_lenses(document: Document) -> list[Lens] | None:
    """Return the lens of a document, or those of several cameras in it; None if it has none. Raises InputError."""
    if not has_plain(document):
        return None
    lenses: list[Lens] = []
    for name, camera in _cameras(document):
        if camera.has(spelled.DISTORTION) and not camera.has(spelled.MATRIX, spelled.FX, *TERMS.values()):
            camera.numbers(spelled.MATRIX)  # raises
        lenses.append(one_of_several(name, _lens, document, name, camera, document.model))
    if len(lenses) == 1:
        if lenses[0].refusal is not None:
            raise lenses[0].refusal
        return [lenses[0]._replace(name="")]
    return lenses


def of_matrix(camera: Fields, matrix: str, distortion: str, size: dict, kind: str = "plumb_bob") -> Lens:
    """Return the lens of entries that name a camera matrix and OpenCV's coefficients, of a picture's size."""
    plain = {"camera_matrix": camera.matrix(matrix, 9), "distortion_model": kind}
    plain["distortion_coefficients"] = camera.matrix(distortion, default=[0.0] * 4)
    lens = plain_lens(cast("Document", camera.document).part(plain))
    return lens._replace(name=camera.label, settings=lens.settings | size)


def _cameras(document: Document) -> list[tuple[str, Spelled]]:
    """Return the cameras of a document with their names."""
    cameras = []
    for prefix, entries in spelled.cameras_of(document.entries):
        camera = Spelled(entries)
        sides = camera.sides()
        if len(sides) == 1 and any(map(camera.is_list, spelled.MATRIX)):
            raise document.refusal(f"it has matrices of two cameras, one of them named {sides[0]}: name both")
        for end in sides if len(sides) > 1 else [""]:
            cameras.append((f"{prefix}{end}", camera.side(end or "".join(sides)) if sides else camera))
    return cameras


def _lens(document: Document, name: str, camera: Spelled, key: str) -> Lens:
    if camera.has(spelled.MATRIX):
        fx, skew, cx, fy, cy = _matrix(document, camera.numbers(spelled.MATRIX))
        for names, entry in zip((spelled.FX, spelled.FY, spelled.CX, spelled.CY), (fx, fy, cx, cy), strict=True):
            if camera.has(names) and abs(camera.number(names) - entry) > APART * max(1, abs(entry)):
                problem = f"its {names[0]} is {camera.number(names):g}, and {entry:g} in the camera matrix"
                raise document.refusal(f"{problem}: leave one out")
    else:
        (fx, fy), (cx, cy), skew = _focal(camera), _center(camera), 0.0
    skew = skew or camera.number(("skew",), 0.0) or fx * camera.number(("alphac",), 0.0)
    listed = camera.numbers(spelled.DISTORTION, empty=NO_DISTORTION, default=())
    named = {} if any(listed) else _named(document, camera)
    listed = [] if any(named.values()) else listed
    model = _model(document, camera, listed or list(named.values()), "p1" in named or "p2" in named, key)
    terms = TERMS[model]
    if model == "UCM" and len(listed) == 5 and listed[-1] == 0:  # the fifth is of OpenCV's pinhole alone
        listed = listed[:-1]
    if any(listed) and len(listed) not in COUNTS[model]:
        counts, order = " or ".join(map(str, COUNTS[model])), ", ".join(terms)
        raise InputError(
            f"{document.path!r} has {len(listed)} distortion coefficients: give {counts}, in the order {order}"
        )
    if beyond := [name for name, value in named.items() if value and name not in terms]:
        raise document.refusal(f"{beyond[0]} is not 0, but {model} has no such coefficient")
    settings = dict(zip(terms, listed, strict=False)) | {name: named[name] for name in terms if name in named}
    if model == "UCM":
        settings["unified_xi"] = camera.number(("xi",))
    if not camera.has(spelled.WIDTH, spelled.HEIGHT) and camera.has(spelled.SIZE):
        document.check_sides(camera.size(), (cx, cy))
    x, y, size = _region(document, camera)
    width, height = (size[f"calibration_{side}"] for side in ("width", "height"))
    if 0 < cx <= 1 and 0 < cy <= 1 and max(fx, fy) < LEAST and min(width or LEAST, height or LEAST) >= LEAST:
        raise document.refusal(
            f"fx, fy, cx and cy are {fx:g}, {fy:g}, {cx:g} and {cy:g}, which are not pixels: if they are parts of the "
            "picture's size, multiply those of x by its width and those of y by its height"
        )
    return Lens(name, model, size | matrix(fx, fy, cx - x, cy - y) | {"skew": skew, **settings})


def _matrix(document: Document, values: list[float]) -> list[float]:
    """Return fx, skew, cx, fy and cy of a camera matrix: (3, 3) by rows or by columns, (4, 4), or fx, fy, cx, cy."""
    entry, path = values, document.path
    if len(values) == 16:
        values = [values[i] for i in (0, 1, 2, 4, 5, 6, 8, 9, 10)]
    if len(values) == 4:
        values = [values[0], 0.0, values[2], 0.0, values[1], values[3], 0.0, 0.0, 1.0]
    if len(values) == 9 and [values[i] for i in (1, 2, 5, 8)] == [0, 0, 0, 1] and any(values[6:8]):
        values = [values[i] for i in (0, 3, 6, 1, 4, 7, 2, 5, 8)]
    is_plain = len(values) == 9 and [values[3], *values[6:]] == [0, 0, 0, 1]
    problem = f"the camera matrix in {path!r} is {shortened(entry)}"
    if not is_plain or min(values[0], values[4]) < 1 / LARGEST:
        raise InputError(f"{problem}: it must be fx skew cx, 0 fy cy, 0 0 1, with fx and fy above 0")
    if max(map(abs, (values[2], values[5]))) > FARTHEST_PIXELS:
        raise InputError(f"{problem}: cx and cy must be up to {FARTHEST_PIXELS:.0f}")
    return [values[0], values[1], values[2], values[4], values[5]]


def _focal(camera: Spelled) -> tuple[float, float]:
    if camera.has(spelled.FX):
        fx = camera.number(spelled.FX)
        return fx, camera.number(spelled.FY, fx)
    focal = camera.numbers(spelled.FOCAL)
    return focal[0], focal[-1]


def _center(camera: Spelled) -> tuple[float, float]:
    if camera.has(spelled.CX, spelled.CY):
        return camera.number(spelled.CX), camera.number(spelled.CY)
    x, y, *_ = (*camera.numbers(spelled.CENTER), 0.0)
    return x, y


def _named(document: Document, camera: Spelled) -> dict[str, float]:
    """Return the coefficients that have entries of their own, in the order of OpenCV's vector. Raises InputError for
    entries that may be others.
    """
    terms, named = TERMS[PINHOLE], {}
    if f"{BY_NUMBER}0" in camera.by_name:
        named = {term: f"{BY_NUMBER}{i}" for i, term in enumerate(terms) if f"{BY_NUMBER}{i}" in camera.by_name}
    for name in terms:
        spellings = [f"{before}{plain_name(name)}" for before in BEFORE_TERMS]
        if there := [spelling for spelling in spellings if spelling in camera.by_name]:
            named[name] = there[0]
    lists = {name: camera.numbers((name,)) for name in LISTS if camera.by_name.get(name, ("", []))[1] != []}
    values = {name: camera.number((entry,)) for name, entry in named.items()}
    for name, numbers in lists.items():
        if len(numbers) > len(LISTS[name]) and any(numbers[len(LISTS[name]) :]):
            raise document.refusal(f"{camera.by_name[name][0]} has {len(numbers)} numbers: {len(LISTS[name])} are read")
        values |= dict(zip(LISTS[name], numbers, strict=False))
    unread = camera.unread({*named.values(), *LISTS, *spelled.DISTORTION, *spelled.MATRIX})
    if unread:
        raise document.refusal(f"{unread[0]} may be its distortion: name it distortion_coefficients, or leave it out")
    return {name: values[name] for name in terms if name in values}


def _region(document: Document, camera: Spelled) -> tuple[float, float, dict]:
    """Return x and y of the picture in the calibrated one, and the settings of its size: all of it, unless a roi
    tells a part.
    """
    width, height = camera.size()
    name, value = camera.by_name.get("roi", ("roi", {}))
    region = Fields(document, value if isinstance(value, dict) else {}, name)
    x, y, *size = (region.number(side, 0.0) for side in ("x_offset", "y_offset", "width", "height"))
    whole = document.size(width, height)
    if not any((x, y, *size)):
        return 0.0, 0.0, whole
    if width is None or height is None:
        raise document.refusal(f"it has {name} and no image size")
    size = size if any(size) else [width, height]
    if min(x, y) < 0 or x + size[0] > width or y + size[1] > height:
        raise document.refusal(f"{name} reaches beyond the picture of {width:g} x {height:g}")
    return x, y, document.size(*size)


def _model(document: Document, camera: Spelled, coefficients: list[float], tangential: bool, key: str) -> str:
    """Return the model that a file names, or that its coefficients have by their names; else the chosen model."""
    if "xi" in camera.by_name:
        return "UCM"
    is_fisheye_by_name: dict[str, bool] = {}
    flags = [name for name in FISHEYE_NAMES if name in camera.by_name]
    for name in flags:
        is_fisheye_by_name[name] = camera.number((name,)) != 0
    for name in MODEL_NAMES:
        entry, value = camera.by_name.get(name, ("", None))
        word = plain_name(str(value)).removeprefix("distortion")
        if value is None or (word in INVERSE and not any(coefficients)):
            continue
        if word not in KNOWN_MODELS:
            if is_fisheye_by_name.keys() - flags:
                continue  # it may be of something else
            known = ", ".join((*PINHOLE_MODELS, *FISHEYE_MODELS))
            raise InputError(f"{entry} in {document.path!r} is {shortened(value)}: it must be one of {known}")
        if word == "none" and name == "distortionmodel" and any(coefficients):
            raise document.refusal("it has distortion coefficients and distortion_model none: say which it is")
        if word not in ("", "none"):
            is_fisheye_by_name[name] = KNOWN_MODELS[word] == FISHEYE
    if is_fisheye_by_name:
        bent = next((name for name, is_fisheye in is_fisheye_by_name.items() if is_fisheye), None)
        plain = [name for name in (*flags, *DISTORTION_NAMES) if is_fisheye_by_name.get(name) is False]
        if bent and plain:  # a pinhole's camera_model may have a fisheye's distortion_model
            (first, text), (second, other_text) = (camera.by_name[name] for name in (bent, plain[0]))
            raise document.refusal(
                f"{first} is {shortened(text)} and {second} is {shortened(other_text)}: they contradict each other"
            )
        return FISHEYE if bent else PINHOLE
    four = len(coefficients) == 4 and any(coefficients) and not tangential
    if four and key not in (PINHOLE, FISHEYE):
        raise document.refusal(
            f"its 4 coefficients may be of OpenCV's pinhole or of its fisheye: choose the model {PINHOLE} or {FISHEYE} "
            "first (--model, in Python model=)"
        )
    return FISHEYE if key == FISHEYE and (four or not any(coefficients)) else PINHOLE
