"""Rigs of Surround360 and Facebook360: cameras by their ids, with their places and axes.

focal is in pixels per radian at the center, its second number negative. The distance from the center is x + d0 x^3 +
d1 x^5 ... times focal, where x is the angle (FTHETA), or its tangent (RECTILINEAR). The center of the first pixel is
(0.5, 0.5). Lengths are those of the file: centimeters in Surround360, meters in Facebook360.
Reference: Surround 360 Rig Geometry Format.
"""

import numpy as np

from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens, matrix
from .parts.placed import of_rotation
from .parts.program import ProgramFiles, of_cameras

MODELS = {
    "FTHETA": ("OPENCV_FISHEYE", ("k1", "k2", "k3", "k4")),
    "RECTILINEAR": ("OPENCV_PINHOLE", ("k1", "k2", "k3")),
}


def looks(document: Document) -> bool:
    cameras = _cameras(document)
    return bool(cameras) and all(camera.has("id", "forward", "right", "up", "focal") for camera in cameras)


def _cameras(document: Document) -> list[Fields]:
    return [camera.labeled(camera.text("id")) for camera in document.entries.parts("cameras")]


def _lens(camera: Fields) -> Lens:
    document = camera.document
    model, terms = MODELS[camera.word("type", MODELS)]
    size, (fx, fy) = camera.size("resolution"), camera.numbers("focal", 2)
    if fx <= 0 or fy >= 0:
        raise camera.refusal("focal", "a number above 0 and one below 0")
    cx, cy = camera.numbers("principal", 2, default=[side / 2 for side in size.values()])
    values = camera.numbers("distortion", default=[])
    if any(values[len(terms) :]):
        raise document.refusal(f"{camera.said('distortion')} has {len(values)} numbers: {len(terms)} are read")
    return Lens(camera.label, model, size | matrix(fx, -fy, cx, cy, 0.5) | dict(zip(terms, values, strict=False)))


def _pose(camera: Fields) -> np.ndarray:
    camera.document.check()
    right, up, ahead, origin = (np.array(camera.numbers(name, 3)) for name in ("right", "up", "forward", "origin"))
    axes = np.stack((right, -up, ahead), axis=1)
    return of_rotation(camera.document, axes, origin, f"right, up and forward of {camera.label}")


PROGRAM = ProgramFiles(
    "Surround360", "rigs of Surround360 and Facebook360 as .json", looks,
    marks="cameras origin forward up right principal focal resolution", reads="FTHETA, RECTILINEAR",
    lost="edges of the field of view (fov); other types are refused", **of_cameras(_cameras, _lens, _pose),
)  # fmt: skip
