"""fSpy's camera parameters as JSON: the camera matched to a picture.

The field of view is that of the picture's width, in radians; the principal point is measured from the middle, y up, in
halves of the longer side. cameraTransform leads from a camera like Blender's to the world. The center of the first
pixel is (0.5, 0.5).
Reference: fSpy, its export of camera parameters, and its importer for Blender.
"""

from __future__ import annotations

from math import pi, tan

from .parts.document import Document
from .parts.lens import Lens, matrix
from .parts.placed import FROM_BLENDER, Placed, pose_in
from .parts.program import ProgramFiles


def looks(document: Document) -> bool:
    """See ProgramFiles."""
    return document.entries.has("cameraTransform", "horizontalFieldOfView", "imageWidth")


def read(document: Document) -> list[Lens]:
    """See ProgramFiles."""
    entries = document.entries
    size = entries.sides("imageWidth", "imageHeight")
    width, height = size.values()
    angle, center = entries.number("horizontalFieldOfView"), entries.part("principalPoint").labeled("principalPoint")
    if not 0 < angle < pi:
        raise entries.refusal("horizontalFieldOfView", "above 0 and below pi")
    focal, half = width / (2 * tan(angle / 2)), max(width, height) / 2
    cx, cy = width / 2 + center.number("x", 0.0) * half, height / 2 - center.number("y", 0.0) * half
    return [Lens("", "OPENCV_PINHOLE", size | matrix(focal, focal, cx, cy, 0.5))]


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles."""
    transform = document.entries.part("cameraTransform").labeled("cameraTransform")
    return [Placed("", "", None, pose_in(transform, "rows") @ FROM_BLENDER)]


PROGRAM = ProgramFiles(
    "fSpy", "camera parameters as .json", looks,
    marks="cameraTransform horizontalFieldOfView principalPoint imageWidth relativeFocalLength", reads="pinhole",
    lost=".fspy projects are not read", read=read, poses=poses,
)  # fmt: skip
