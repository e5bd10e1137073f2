"""Open3D's PinholeCameraParameters and PinholeCameraTrajectory, as JSON, and trajectories .log.

Matrices of JSON are stored by columns; extrinsic leads from the world to the camera, x right, y down, z ahead. A .log
has for each picture a line of three whole numbers and the four rows of the matrix from the camera to the world. The
center of the first pixel is (0, 0).
References: Open3D documentation, PinholeCameraParameters; Redwood, Trajectory file format (.log).
"""

import numpy as np

from ..units import METERS
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens, matrix, numbers_of
from .parts.placed import Placed, inverted, pose_of
from .parts.program import ProgramFiles, of_pictures

CAMERA, TRAJECTORY = "PinholeCameraParameters", "PinholeCameraTrajectory"
ROWS = 5
"""Lines of a picture in a .log."""


def looks(document: Document) -> bool:
    if document.has_entries:
        return document.entries.text("class_name") in (CAMERA, TRAJECTORY)
    lines = [numbers_of(line.split()) for line in document.lines()[:ROWS]]
    return [len(numbers) for numbers in lines] == [3, 4, 4, 4, 4]


def _pictures(document: Document) -> list[Fields]:
    entries = document.entries
    pictures = entries.parts("parameters") if entries.text("class_name") == TRAJECTORY else [entries]
    return [picture.labeled(f"picture {number}" if pictures[1:] else "") for number, picture in enumerate(pictures, 1)]


def _lens(document: Document, picture: Fields) -> Lens:
    intrinsics = picture.part("intrinsic").labeled(picture.label)
    fx, y, z, skew, fy, z1, cx, cy, last = intrinsics.numbers("intrinsic_matrix", 9)
    if any((y, z, z1)) or last != 1:
        raise intrinsics.refusal("intrinsic_matrix", "fx 0 0 skew fy 0 cx cy 1, by columns")
    document.check()
    settings = intrinsics.sides("width", "height") | matrix(fx, fy, cx, cy) | {"skew": skew}
    return Lens(picture.label, "OPENCV_PINHOLE", settings)


def _placed(document: Document, picture: Fields) -> Placed:
    rows = np.reshape(picture.numbers("extrinsic", 16), (4, 4)).T.tolist()
    frame = float(picture.label.rpartition(" ")[2]) if picture.label else None
    return Placed("", "", frame, inverted(pose_of(document, rows, picture.said("extrinsic"))))


PICTURES = of_pictures(_pictures, _lens, _placed)


def read(document: Document) -> list[Lens]:
    if not document.has_entries:
        raise document.refusal("it is a trajectory, which has no lens")
    return PICTURES["read"](document)


def poses(document: Document) -> list[Placed]:
    if document.has_entries:
        return PICTURES["poses"](document)
    lines, placed = document.lines(), []
    for number, begin in enumerate(range(0, len(lines), ROWS), 1):
        document.check()
        rows = [document.numbers(line.split(), f"pose {number}", 4) for line in lines[begin + 1 : begin + ROWS]]
        placed.append(Placed("", "", float(number), pose_of(document, rows, f"pose {number}"), moves=True))
    return placed


PROGRAM = ProgramFiles(
    "Open3D", "PinholeCameraParameters and PinholeCameraTrajectory as .json; trajectories .log", looks,
    marks="class_name PinholeCameraParameters PinholeCameraTrajectory extrinsic intrinsic_matrix", reads="pinhole",
    read=read, poses=poses, unit=METERS,
)  # fmt: skip
