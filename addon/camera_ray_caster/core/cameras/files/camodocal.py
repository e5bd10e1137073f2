"""The YAML of camodocal, by which VINS-Mono, VINS-Fusion and KITTI-360 describe their cameras.

The center of the first pixel is (0, 0). In its KANNALA_BRANDT the coefficients of theta³ to theta⁹ are k2 to k5.
References: L. Heng, B. Li and M. Pollefeys, CamOdoCal (2013), and its source, camera_models; KITTI-360 documentation.
"""

from __future__ import annotations

from .document import Document, Lens, mapping, matrix
from .spelled import HEIGHT, WIDTH, Spelled

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

PARTS = "projection_parameters", "distortion_parameters", "mirror_parameters"


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lens of a document; see the package."""
    entries = document.entries
    if PARTS[0] not in entries:
        return None
    kind = document.one_of(entries.get("model_type"), "model_type", MODELS)
    model, focal, terms = MODELS[kind]
    given: dict = {}
    for part in PARTS:
        given |= mapping(entries.get(part))
    size = Spelled(document, {name: value for name, value in entries.items() if name.lower().startswith("image")})
    width, height = (size.number(names) if size.has(names) else None for names in (WIDTH, HEIGHT))
    settings = {own: document.number(given, name) for name, own in terms.items()}
    camera_matrix = matrix(*(document.number(given, name) for name in focal))
    return [Lens("", model, document.size(width, height) | camera_matrix | settings)]
