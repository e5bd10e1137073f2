"""fSpy's camera parameters, as JSON or in a project (.fspy): the camera matched to a picture.

A project is fspy, the version, the sizes of its JSON and of its picture in 4 bytes each, and then these two.

The field of view is that of the picture's width, in radians; the principal point is measured from the middle, y up, in
halves of the longer side. cameraTransform leads from a camera like Blender's to the world. The center of the first
pixel is (0.5, 0.5).
Reference: fSpy, its export of camera parameters, its project file format, and its importer for Blender.
"""

from math import pi, tan

import numpy as np

from ..text_forms.content import decoded, entries_of
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens, matrix
from .parts.placed import FROM_BLENDER, Placed, pose_in
from .parts.program import ProgramFiles

MAGIC, VERSION = b"fspy", 1


def looks(document: Document) -> bool:
    return document.data.startswith(MAGIC) or document.entries.has("cameraTransform", "horizontalFieldOfView")


def _parameters(document: Document) -> Fields:
    if not document.data.startswith(MAGIC):
        return document.entries
    head = np.frombuffer(document.data[: 4 * 4].ljust(4 * 4), "<u4").tolist()
    if head[1] != VERSION:
        raise document.refusal(f"it is an fSpy project of version {head[1]}: {VERSION} is read")
    text = decoded(document.data[16 : 16 + head[2]], document.path)
    project = Fields(document, entries_of(text, document.path, document.check))
    if not project.has("cameraParameters"):
        raise document.refusal("its camera is not solved: place the vanishing points in fSpy, and save it")
    return project.part("cameraParameters")


def read(document: Document) -> list[Lens]:
    entries = _parameters(document)
    size = entries.sides("imageWidth", "imageHeight")
    width, height = size.values()
    angle, center = entries.number("horizontalFieldOfView"), entries.part("principalPoint").labeled("principalPoint")
    if not 0 < angle < pi:
        raise entries.refusal("horizontalFieldOfView", "above 0 and below pi")
    focal, half = width / (2 * tan(angle / 2)), max(width, height) / 2
    cx, cy = width / 2 + center.number("x", 0.0) * half, height / 2 - center.number("y", 0.0) * half
    return [Lens("", "OPENCV_PINHOLE", size | matrix(focal, focal, cx, cy, 0.5))]


def poses(document: Document) -> list[Placed]:
    transform = _parameters(document).part("cameraTransform").labeled("cameraTransform")
    return [Placed("", "", None, pose_in(transform, "rows") @ FROM_BLENDER)]


PROGRAM = ProgramFiles(
    "fSpy", "camera parameters as .json; projects, .fspy", looks,
    marks="cameraTransform horizontalFieldOfView principalPoint imageWidth relativeFocalLength", reads="pinhole",
    lost="the picture in a project", read=read, poses=poses,
)  # fmt: skip
