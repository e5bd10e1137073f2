"""Kalibr's camchain: cam0, cam1, ..., each a camera model and a distortion model; and EuRoC's and Kimera's sensor.yaml.

A sensor.yaml has the entries of one camera. A radial-tangential distortion of five coefficients has a k3, too.
The center of the first pixel is (0, 0).
References: Kalibr wiki, Supported models; YAML formats. The EuRoC MAV dataset, Data format. Kimera-VIO documentation.
"""

from __future__ import annotations

from .parts.document import Document, Lens, matrix, numbers_of, one_of_several
from .parts.spelled import plain_name

SHAPES = {
    "pinhole": ("OPENCV_PINHOLE", ()),
    "omni": ("UCM", ("unified_xi",)),
    "eucm": ("EUCM", ("unified_alpha", "unified_beta")),
    "ds": ("DOUBLE_SPHERE", ("unified_xi", "unified_alpha")),
}
"""Our model for a camera model of Kalibr, and the settings whose numbers precede the focal lengths."""
DISTORTIONS = {
    ("pinhole", "radtan"): ("OPENCV_PINHOLE", ("k1", "k2", "p1", "p2")),
    ("pinhole", "radialtangential8"): ("OPENCV_PINHOLE", ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6")),
    ("pinhole", "equidistant"): ("OPENCV_FISHEYE", ("k1", "k2", "k3", "k4")),
    ("pinhole", "fov"): ("FOV", ("fov_omega",)),
    ("omni", "radtan"): ("UCM", ("k1", "k2", "p1", "p2")),
}
"""Our model for a camera model with a distortion, and the distortion's settings. Any model may have no distortion."""


COEFFICIENTS = "distortion_coeffs", "distortion_coefficients"
SPELLINGS = {
    "radialtangential": "radtan", "plumbbob": "radtan", "equi": "equidistant", "kannalabrandt": "equidistant",
    "mei": "omni",
}  # fmt: skip
"""Other plain names of camera models and distortions, by which EuRoC, Kimera, OKVIS and others say the same."""


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lenses of a document; see the package."""
    entries = document.entries
    if "camera_model" in entries and "intrinsics" in entries:
        return [_lens(document, "", entries)]
    cameras = {name: one for name, one in entries.items() if isinstance(one, dict) and "camera_model" in one}
    return [one_of_several(name, _lens, document, name, camera) for name, camera in cameras.items()] or None


def spelled(word) -> str:
    """Return Kalibr's word for a camera model or a distortion."""
    plain = plain_name(str(word))
    return SPELLINGS.get(plain, plain)


def bend_of(document: Document, name: str, kind: str, word, entry: str) -> str:
    """Return Kalibr's word for the distortion of a camera model. Raises InputError for one that it cannot have."""
    bend = spelled(word) or "none"
    if bend != "none" and (kind, bend) not in DISTORTIONS:
        known = ", ".join(["none", *(one for of, one in DISTORTIONS if of == kind)])
        of = f"{entry} of {name}, {kind}," if name else f"{entry} of a {kind}"
        raise document.refusal(f"{of} is {str(word)!r}: it must be one of {known}")
    return bend


def _lens(document: Document, name: str, camera: dict) -> Lens:
    def of(entry: str) -> str:
        return f"{entry} of {name}" if name else entry

    kind = document.one_of(spelled(camera["camera_model"]), of("camera_model"), SHAPES)
    model, shape = SHAPES[kind]
    terms: tuple[str, ...] = ()
    entry = next((one for one in COEFFICIENTS if one in camera), COEFFICIENTS[0])
    bend = bend_of(document, name, kind, camera.get("distortion_model", "none"), "distortion_model")
    if bend == "none" and any(document.numbers(camera.get(entry) or 0, of(entry))):
        raise document.refusal(f"{name} has {entry} and no distortion_model: say which it is")
    if bend != "none":
        model, terms = DISTORTIONS[kind, bend]

    def listed(entry: str, count: int) -> list[float]:
        return document.numbers(camera.get(entry), of(entry), count)

    first = listed("intrinsics", len(shape) + 4)
    size = listed("resolution", 2) if "resolution" in camera else [None, None]
    if (kind, bend) == ("pinhole", "radtan") and len(numbers_of(camera.get(entry))) == 5:
        terms = (*terms, "k3")
    rest = listed(entry, len(terms)) if terms else []
    settings = dict(zip((*shape, *terms), (*first[: len(shape)], *rest), strict=True))
    return Lens(name, model, document.size(*size) | matrix(*first[len(shape) :]) | settings)
