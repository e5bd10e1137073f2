"""The YAML of camodocal, by which VINS-Mono, VINS-Fusion and KITTI-360 describe their cameras.

The center of the first pixel is (0, 0). In its KANNALA_BRANDT the coefficients of theta³ to theta⁹ are k2 to k5.
Its SCARAMUZZA is OCam with x to the right: a pixel's offset is ((ac, ad), (ae, 1)) (u', v'). Its inverse polynomial is
not needed. Ours has 1 in place of ac, which scales (u', v') and the polynomial.
References: L. Heng, B. Li and M. Pollefeys, CamOdoCal (2013), and its source, camera_models; KITTI-360 documentation.
"""

from __future__ import annotations

import re

from .parts.document import Document
from .parts.lens import Lens, mapping, matrix
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


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lens of a document; see the package."""
    entries = document.raw
    if PARTS[0] not in entries and entries.get("model_type") != SCARAMUZZA:
        return None
    kind = document.one_of(entries.get("model_type"), "model_type", (*MODELS, SCARAMUZZA))
    if kind == SCARAMUZZA:
        return [_ocam(document, entries)]
    model, focal, terms = MODELS[kind]
    given: dict = {}
    for part in PARTS:
        given |= mapping(entries.get(part))
    settings = {own: document.number(given, name) for name, own in terms.items()}
    camera_matrix = matrix(*(document.number(given, name) for name in focal))
    return [Lens("", model, _size(document, entries) | camera_matrix | settings)]


def _size(document: Document, entries: dict) -> dict:
    size = Spelled(document, {name: value for name, value in entries.items() if name.lower().startswith("image")})
    width, height = (size.number(names) if size.has(names) else None for names in (WIDTH, HEIGHT))
    return document.size(width, height)


def _ocam(document: Document, entries: dict) -> Lens:
    affine, given = mapping(entries.get("affine_parameters")), mapping(entries.get("poly_parameters"))
    c, d, e, x, y = (document.number(affine, name) for name in ("ac", "ad", "ae", "cx", "cy"))
    if not c > 0:
        raise document.refusal(f"ac is {c:g}: it must be above 0")
    powers = sorted(int(name[1:]) for name in given if re.fullmatch(r"p\d{1,2}", name))
    if powers != list(range(len(powers))) or not powers:
        raise document.refusal("its poly_parameters must be p0, p1, ... without a gap")
    polynomial = [document.number(given, f"p{power}") * c ** (1 - power) for power in powers]
    return Lens("", "OCAM", _size(document, entries) | {
        "cx": x, "cy": y, "ocam_polynomial": " ".join(map(repr, polynomial)),
        "ocam_c": 1 / c, "ocam_d": e / c, "ocam_e": d / c,
    })  # fmt: skip
