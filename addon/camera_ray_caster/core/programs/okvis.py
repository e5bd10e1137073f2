"""The cameras of OKVIS's settings, in YAML: a list with focal_length, principal_point and image_dimension.

The center of the first pixel is (0, 0).
Reference: OKVIS2 documentation, Configuration files and calibration.
"""

from __future__ import annotations

from .kalibr import DISTORTIONS, bend_of
from .parts.document import Document, Lens, mapping, matrix, one_of_several

ENTRIES = "focal_length", "principal_point"


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lenses of a document; see the package."""
    cameras = document.entries.get("cameras")
    if not isinstance(cameras, list) or not all(isinstance(one, dict) and ENTRIES[0] in one for one in cameras):
        return None
    named = [(f"cam{number}", mapping(camera)) for number, camera in enumerate(cameras)]
    return [one_of_several(name, _lens, document, name, camera) for name, camera in named]


def _lens(document: Document, name: str, camera: dict) -> Lens:
    bend = bend_of(document, name, "pinhole", camera.get("distortion_type", "none"), "distortion_type")
    model, terms = DISTORTIONS["pinhole", bend] if bend != "none" else ("OPENCV_PINHOLE", ())
    focal, center = (document.numbers(camera.get(one), f"{one} of {name}", 2) for one in ENTRIES)
    entry = "distortion_coefficients"
    rest = document.numbers(camera.get(entry), f"{entry} of {name}", len(terms)) if terms else []
    size = camera.get("image_dimension")
    sides = [None, None] if size is None else document.numbers(size, f"image_dimension of {name}", 2)
    return Lens(name, model, document.size(*sides) | matrix(*focal, *center) | dict(zip(terms, rest, strict=True)))
