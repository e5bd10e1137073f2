"""The words of Kalibr's camera and distortion models, which several programs share."""

from .fields import Fields
from .lens import Lens, matrix, numbers_of
from .spelled import plain_name

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
"""Other plain names of camera models and distortions."""


def is_camera(entries: Fields) -> bool:
    """Whether these are the entries of one camera."""
    return entries.has("camera_model", "intrinsics")


def spelled(word: str) -> str:
    """Return Kalibr's word for a camera model or a distortion."""
    plain = plain_name(word)
    return SPELLINGS.get(plain, plain)


def bend_of(entries: Fields, kind: str, entry: str) -> str:
    """Return Kalibr's word for the distortion of a camera model. Raises InputError for one that it cannot have."""
    word = entries.text(entry, "none")
    bend = spelled(word) or "none"
    if bend != "none" and (kind, bend) not in DISTORTIONS:
        known = ", ".join(["none", *(name for of, name in DISTORTIONS if of == kind)])
        of = f"{entry} of {entries.label}, {kind}," if entries.label else f"{entry} of a {kind}"
        raise entries.document.refusal(f"{of} is {word!r}: it must be one of {known}")
    return bend


def lens_of(camera: Fields, name: str) -> Lens:
    """Return the lens of a camera. Raises InputError."""
    document = camera.document
    kind = document.one_of(spelled(camera.text("camera_model")), camera.said("camera_model"), SHAPES)
    model, shape = SHAPES[kind]
    terms: tuple[str, ...] = ()
    entry = camera.first(*COEFFICIENTS)
    bend = bend_of(camera, kind, "distortion_model")
    if bend == "none" and any(camera.numbers(entry, default=[0.0])):
        raise document.refusal(f"{name or 'the camera'} has {entry} and no distortion_model: say which it is")
    if bend != "none":
        model, terms = DISTORTIONS[kind, bend]
    first = camera.numbers("intrinsics", len(shape) + 4)
    if (kind, bend) == ("pinhole", "radtan") and len(numbers_of(camera.values.get(entry))) == 5:
        terms = (*terms, "k3")
    coefficients = camera.numbers(entry, len(terms)) if terms else []
    settings = dict(zip((*shape, *terms), (*first[: len(shape)], *coefficients), strict=True))
    size = camera.size("resolution")
    document.check_sides(list(size.values()), first[-2:])
    return Lens(name, model, size | matrix(*first[len(shape) :]) | settings)
