"""The calibration of Project Aria's glasses, as JSON: cameras by their labels.

The center of the first pixel is (0, 0). The file does not give the size of the pictures: the frame must have that size.
Reference: Project Aria documentation, Camera Intrinsic Models for Project Aria devices.
"""

from __future__ import annotations

from .parts.document import Document
from .parts.lens import FRAME_SIZE, Lens, mapping, matrix, one_of_several

MODELS = {
    "FisheyeRadTanThinPrism": (
        "FISHEYE624", ("k1", "k2", "k3", "k4", "k5", "k6", "p2", "p1", "s1", "s2", "s3", "s4"), 1
    ),
    "KannalaBrandtK3": ("OPENCV_FISHEYE", ("k1", "k2", "k3", "k4"), 2),
    "Linear": ("OPENCV_PINHOLE", (), 2),
}  # fmt: skip
"""Our model, the settings that follow the center, and the number of focal lengths before it."""


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lenses of a document; see the package."""
    cameras = document.raw.get("CameraCalibrations")
    if not isinstance(cameras, list):
        return None
    named = [(str(camera.get("Label", "")), camera) for camera in map(mapping, cameras)]
    return [one_of_several(name, _lens, document, name, camera) for name, camera in named]


def _lens(document: Document, name: str, camera: dict) -> Lens:
    projection = mapping(camera.get("Projection"))
    model, terms, count = MODELS[document.one_of(projection.get("Name"), f"Projection of {name!r}", MODELS)]
    given = document.numbers(projection.get("Params"), f"Params of {name!r}", count + 2 + len(terms))
    focal, center, rest = given[:count], given[count : count + 2], given[count + 2 :]
    settings = FRAME_SIZE | matrix(focal[0], focal[-1], *center) | dict(zip(terms, rest, strict=True))
    return Lens(name, model, settings)
