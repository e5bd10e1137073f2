"""The YAML of camodocal, by which VINS-Mono, VINS-Fusion and KITTI-360 describe their cameras.

The center of the first pixel is (0, 0). In its KANNALA_BRANDT the coefficients of theta³ to theta⁹ are k2 to k5.
extrinsicRotation and extrinsicTranslation of VINS-Mono's settings lead from the camera to the IMU.
Its SCARAMUZZA is OCam with x to the right: a pixel's offset is ((ac, ad), (ae, 1)) (u', v'). Its inverse polynomial is
not needed. Ours has 1 in place of ac, which scales (u', v') and the polynomial.
References: L. Heng, B. Li and M. Pollefeys, CamOdoCal (2013), and its source, camera_models; KITTI-360 documentation.
"""

import re

from ..units import METERS
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens, matrix
from .parts.placed import Placed, of_rotation
from .parts.program import ProgramFiles
from .parts.spelled import HEIGHT, WIDTH, Spelled

RADIAL_TANGENTIAL = {name: name for name in ("k1", "k2", "p1", "p2")}
RATIONAL = RADIAL_TANGENTIAL | {name: name for name in ("k3", "k4", "k5", "k6")}
MODELS = {
    "PINHOLE": ("OPENCV_PINHOLE", ("fx", "fy", "cx", "cy"), RADIAL_TANGENTIAL),
    "PINHOLE_FULL": ("OPENCV_PINHOLE", ("fx", "fy", "cx", "cy"), RATIONAL),
    "MEI": ("UCM", ("gamma1", "gamma2", "u0", "v0"), RADIAL_TANGENTIAL | {"xi": "unified_xi"}),
    "KANNALA_BRANDT": (
        "OPENCV_FISHEYE", ("mu", "mv", "u0", "v0"), {f"k{number + 1}": f"k{number}" for number in (1, 2, 3, 4)}
    ),
}  # fmt: skip
"""Our model for a model_type, its names of the focal lengths and the center, and our settings for its coefficients."""

SCARAMUZZA = "SCARAMUZZA"

PARTS = "projection_parameters", "distortion_parameters", "mirror_parameters"
TURN, PLACE = "extrinsicRotation", "extrinsicTranslation"
CALIBRATION = "cam0_calib"


def looks(document: Document) -> bool:
    entries = document.entries
    is_ocam = entries.has("model_type") and entries.text("model_type") == SCARAMUZZA
    return entries.has(PARTS[0]) or is_ocam or entries.has(CALIBRATION)


def read(document: Document) -> list[Lens]:
    entries = document.entries
    if entries.has(CALIBRATION):
        raise document.refusal(f"its lenses are in files of their own: give {entries.text(CALIBRATION)} beside it")
    kind = entries.word("model_type", (*MODELS, SCARAMUZZA))
    if kind == SCARAMUZZA:
        return [_ocam(entries)]
    model, focal, terms = MODELS[kind]
    parameters = entries.part(PARTS[0])
    for name in PARTS[1:]:
        parameters = parameters.merged(entries.part(name))
    settings = {setting: parameters.number(name) for name, setting in terms.items()}
    return [Lens("", model, _size(entries) | matrix(*(parameters.number(name) for name in focal)) | settings)]


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles: that of the camera in the body, of settings that tell it; at 2 VINS does not use theirs."""
    entries = document.entries
    if not entries.has(TURN, PLACE) or entries.number("estimate_extrinsic", 0.0) == 2:
        return []
    return [Placed("", "", None, of_rotation(document, entries.matrix(TURN, 9), entries.matrix(PLACE, 3), TURN))]


def _size(entries: Fields) -> dict:
    size = Spelled(entries.some([name for name in entries if name.lower().startswith("image")]))
    width, height = (size.number(names) if size.has(names) else None for names in (WIDTH, HEIGHT))
    return entries.document.size(width, height)


def _ocam(entries: Fields) -> Lens:
    document = entries.document
    affine, coefficients = entries.part("affine_parameters"), entries.part("poly_parameters")
    c, d, e, x, y = (affine.number(name) for name in ("ac", "ad", "ae", "cx", "cy"))
    if not c > 0:
        raise document.refusal(f"ac is {c:g}: it must be above 0")
    powers = sorted(int(name[1:]) for name in coefficients if re.fullmatch(r"p\d{1,2}", name))
    if powers != list(range(len(powers))) or not powers:
        raise document.refusal("its poly_parameters must be p0, p1, ... without a gap")
    polynomial = [coefficients.number(f"p{power}") * c ** (1 - power) for power in powers]
    return Lens("", "OCAM", _size(entries) | {
        "cx": x, "cy": y, "ocam_polynomial": " ".join(map(repr, polynomial)),
        "ocam_c": 1 / c, "ocam_d": e / c, "ocam_e": d / c,
    })  # fmt: skip


PROGRAM = ProgramFiles(
    "VINS", "camodocal's .yaml, of VINS-Mono, VINS-Fusion and KITTI-360", looks,
    marks="model_type projection_parameters distortion_parameters mirror_parameters",
    reads="PINHOLE, PINHOLE_FULL, MEI, KANNALA_BRANDT, SCARAMUZZA", read=read, poses=poses, unit=METERS,
)  # fmt: skip
