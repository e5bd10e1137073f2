"""Gyroflow's lens profiles, as JSON: OpenCV's fisheye, or its pinhole, at the size at which it was calibrated.

The center of the first pixel is (0, 0).
Reference: Gyroflow documentation, Lens profiles; its lens_profiles.
"""

from .parts.document import Document
from .parts.lens import Lens, matrix
from .parts.program import ProgramFiles

MODELS = {
    "opencv_fisheye": ("OPENCV_FISHEYE", ("k1", "k2", "k3", "k4")),
    "opencv_standard": ("OPENCV_PINHOLE", ("k1", "k2", "p1", "p2", "k3")),
}
"""Our model for a distortion_model, and its coefficients."""
STRETCHES = "input_horizontal_stretch", "input_vertical_stretch"


def looks(document: Document) -> bool:
    entries = document.entries
    return entries.has("calib_dimension") and (entries.has("fisheye_params") or entries.has("calib_params"))


def read(document: Document) -> list[Lens]:
    entries = document.entries
    plain = entries.text("use_opencv_standard") == "True"
    kind = entries.word("distortion_model", MODELS, "opencv_standard" if plain else "opencv_fisheye")
    model, terms = MODELS[kind]
    for name in STRETCHES:
        stretch = entries.number(name, 1.0)
        if stretch not in (0.0, 1.0):
            raise document.refusal(f"{name} is {stretch}: profiles of stretched pictures are not read")
    parameters = entries.part("calib_params" if plain else "fisheye_params")
    rows, coefficients = parameters.matrix("camera_matrix", 9), parameters.matrix("distortion_coeffs")
    if len(coefficients) > len(terms):
        raise document.refusal(f"distortion_coeffs has {len(coefficients)} numbers: {kind} has {len(terms)}")
    settings = entries.part("calib_dimension").sides("w", "h")
    settings |= matrix(rows[0], rows[4], rows[2], rows[5]) | {"skew": rows[1]}
    name = f"{entries.text('camera_brand')} {entries.text('camera_model')}".strip()
    return [Lens(name, model, settings | dict(zip(terms, coefficients, strict=False)))]


PROGRAM = ProgramFiles(
    "Gyroflow", "lens profiles as .json", looks,
    marks="calib_dimension fisheye_params use_opencv_fisheye calibrator_version",
    reads="opencv_fisheye, opencv_standard", lost="stretched pictures and other models are refused", read=read,
)  # fmt: skip
