"""Basalt's calibration, as JSON: value0 with a list of intrinsics and a list of resolutions, by the cameras' numbers.

The center of the first pixel is (0, 0). Basalt's unified camera, ucm, is the enhanced one with beta = 1.
References: V. Usenko, N. Demmel and D. Cremers, The Double Sphere Camera Model (2018); Basalt documentation,
Calibration.
"""

from __future__ import annotations

from .parts.document import Document
from .parts.lens import Lens, mapping, matrix, one_of_several

MODELS = {
    "ds": ("DOUBLE_SPHERE", {"xi": "unified_xi", "alpha": "unified_alpha"}),
    "eucm": ("EUCM", {"alpha": "unified_alpha", "beta": "unified_beta"}),
    "ucm": ("EUCM", {"alpha": "unified_alpha"}),
    "kb4": ("OPENCV_FISHEYE", {name: name for name in ("k1", "k2", "k3", "k4")}),
    "pinhole": ("OPENCV_PINHOLE", {}),
    "pinhole-radtan8": (
        "OPENCV_PINHOLE", {name: name for name in ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6")}
    ),
    "fov": ("FOV", {"w": "fov_omega"}),
}  # fmt: skip
"""Our model for a camera type, and our settings for its parameters beside the focal lengths and the center."""


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lenses of a document; see the package."""
    calibration = mapping(document.raw.get("value0"))
    cameras = calibration.get("intrinsics")
    if not isinstance(cameras, list):
        return None
    sizes = calibration.get("resolution")
    if sizes is not None and (not isinstance(sizes, list) or len(sizes) != len(cameras)):
        raise document.refusal(f"it has {len(cameras)} intrinsics and not as many resolutions")
    named = [(f"cam{number}", mapping(camera), sizes and sizes[number]) for number, camera in enumerate(cameras)]
    return [one_of_several(name, _lens, document, name, *rest) for name, *rest in named]


def _lens(document: Document, name: str, camera: dict, size) -> Lens:
    model, terms = MODELS[document.one_of(camera.get("camera_type"), f"camera_type of {name}", MODELS)]
    given = mapping(camera.get("intrinsics"))
    numbers = {one: document.number(given, one) for one in ("fx", "fy", "cx", "cy", *terms)}
    settings = {own: numbers[one] for one, own in terms.items()}
    if camera["camera_type"] == "ucm":
        settings["unified_beta"] = 1.0
    sides = [None, None] if size is None else document.numbers(size, f"resolution of {name}", 2)
    camera_matrix = matrix(*(numbers[one] for one in ("fx", "fy", "cx", "cy")))
    return Lens(name, model, document.size(*sides) | camera_matrix | settings)
