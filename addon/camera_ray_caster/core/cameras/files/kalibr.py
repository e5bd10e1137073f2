"""Kalibr's camchain: cam0, cam1, ..., each a camera model and a distortion model.

The center of the first pixel is (0, 0).
Reference: Kalibr wiki, Supported models; YAML formats.
"""

from __future__ import annotations

from .document import Document, Lens, matrix, one_of_several

SHAPES = {
    "pinhole": ("OPENCV_PINHOLE", ()),
    "omni": ("UCM", ("unified_xi",)),
    "eucm": ("EUCM", ("unified_alpha", "unified_beta")),
    "ds": ("DOUBLE_SPHERE", ("unified_xi", "unified_alpha")),
}
"""Our model for a camera model of Kalibr, and the settings whose numbers precede the focal lengths."""
DISTORTIONS = {
    ("pinhole", "radtan"): ("OPENCV_PINHOLE", ("k1", "k2", "p1", "p2")),
    ("pinhole", "equidistant"): ("OPENCV_FISHEYE", ("k1", "k2", "k3", "k4")),
    ("pinhole", "fov"): ("FOV", ("fov_omega",)),
    ("omni", "radtan"): ("UCM", ("k1", "k2", "p1", "p2")),
}
"""Our model for a camera model with a distortion, and the distortion's settings. Any model may have no distortion."""


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lenses of a document; see the package."""
    cameras = {name: one for name, one in document.entries.items() if isinstance(one, dict) and "camera_model" in one}
    return [one_of_several(name, _lens, document, name, camera) for name, camera in cameras.items()] or None


def _lens(document: Document, name: str, camera: dict) -> Lens:
    kind = document.one_of(camera["camera_model"], f"camera_model of {name}", SHAPES)
    bend = str(camera.get("distortion_model", "none"))
    model, shape = SHAPES[kind]
    terms: tuple[str, ...] = ()
    if bend == "none" and any(document.numbers(camera.get("distortion_coeffs") or 0, f"distortion_coeffs of {name}")):
        raise document.refusal(f"{name} has distortion_coeffs and no distortion_model: say which it is")
    if bend != "none":
        if (kind, bend) not in DISTORTIONS:
            known = ", ".join(["none", *(one for of, one in DISTORTIONS if of == kind)])
            raise document.refusal(f"distortion_model of {name}, {kind}, is {bend!r}: it must be one of {known}")
        model, terms = DISTORTIONS[kind, bend]

    def listed(entry: str, count: int) -> list[float]:
        return document.numbers(camera.get(entry), f"{entry} of {name}", count)

    first, (width, height) = listed("intrinsics", len(shape) + 4), listed("resolution", 2)
    rest = listed("distortion_coeffs", len(terms)) if terms else []
    settings = dict(zip((*shape, *terms), (*first[: len(shape)], *rest), strict=True))
    return Lens(name, model, document.size(width, height) | matrix(*first[len(shape) :]) | settings)
