"""Gyroflow's lens profiles, as JSON: OpenCV's fisheye, or its pinhole, at the size at which it was calibrated.

The center of the first pixel is (0, 0).
Reference: Gyroflow documentation, Lens profiles; its lens_profiles.
"""

from __future__ import annotations

from ..text_forms.content import flat
from .parts.document import Document
from .parts.lens import Lens, mapping, matrix

MODELS = {
    "opencv_fisheye": ("OPENCV_FISHEYE", "fisheye_params", ("k1", "k2", "k3", "k4")),
    "opencv_standard": ("OPENCV_PINHOLE", "fisheye_params", ("k1", "k2", "p1", "p2", "k3")),
}
"""Our model for a distortion_model, the entry of its numbers, and its coefficients."""
STRETCHES = "input_horizontal_stretch", "input_vertical_stretch"


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lens of a document; see the package."""
    entries = document.raw
    if "calib_dimension" not in entries or not {"fisheye_params", "calib_params"} & entries.keys():
        return None
    old = "opencv_standard" if entries.get("use_opencv_standard") is True else "opencv_fisheye"
    kind = document.one_of(entries.get("distortion_model") or old, "distortion_model", MODELS)
    model, entry, terms = MODELS[kind]
    for name in STRETCHES:
        if entries.get(name) is not None and document.number(entries, name) not in (0.0, 1.0):
            raise document.refusal(f"{name} is {entries[name]}: profiles of stretched pictures are not read")
    given = mapping(entries.get("calib_params" if entries.get("use_opencv_standard") is True else entry))
    parts = ("camera_matrix", 9), ("distortion_coeffs", None)
    rows, rest = (document.numbers(flat(given.get(name), name, document.path), name, count) for name, count in parts)
    if len(rest) > len(terms):
        raise document.refusal(f"distortion_coeffs has {len(rest)} numbers: {kind} has {len(terms)}")
    size = mapping(entries["calib_dimension"])
    settings = document.size(document.number(size, "w"), document.number(size, "h"))
    settings |= matrix(rows[0], rows[4], rows[2], rows[5]) | {"skew": rows[1]}
    name = " ".join(str(entries[part]) for part in ("camera_brand", "camera_model") if entries.get(part))
    return [Lens(name, model, settings | dict(zip(terms, rest, strict=False)))]
