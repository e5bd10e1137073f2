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
from .parts.lens import Lens, different, matrix, numbers_of, once_each
from .parts.placed import Placed, inverted, pose_of
from .parts.program import ProgramFiles

CAMERA, TRAJECTORY = "PinholeCameraParameters", "PinholeCameraTrajectory"
ROWS = 5
"""Lines of a picture in a .log."""


def looks(document: Document) -> bool:
    if document.has_entries:
        return document.entries.text("class_name") in (CAMERA, TRAJECTORY)
    lines = [line.split() for line in document.lines()[:ROWS]]
    return [len(line) for line in lines] == [3, 4, 4, 4, 4] and all(
        len(numbers_of(words)) == len(words) for words in lines
    )


def _pictures(document: Document) -> list[Fields]:
    entries = document.entries
    pictures = entries.parts("parameters") if entries.text("class_name") == TRAJECTORY else [entries]
    return [picture.labeled(f"picture {number}" if pictures[1:] else "") for number, picture in enumerate(pictures, 1)]


def _lens(picture: Fields) -> Lens:
    intrinsics = picture.part("intrinsic").labeled(picture.label)
    fx, y, z, skew, fy, z1, cx, cy, last = intrinsics.numbers("intrinsic_matrix", 9)
    if any((y, z, z1)) or last != 1:
        raise intrinsics.refusal("intrinsic_matrix", "fx 0 0 skew fy 0 cx cy 1, by columns")
    picture.document.check()
    return Lens(
        picture.label, "OPENCV_PINHOLE", intrinsics.sides("width", "height") | matrix(fx, fy, cx, cy) | {"skew": skew}
    )


def read(document: Document) -> list[Lens]:
    if not document.has_entries:
        raise document.refusal("it is a trajectory, which has no lens")
    return different(map(_lens, _pictures(document)))


def poses(document: Document) -> list[Placed]:
    if not document.has_entries:
        return _of_log(document)
    pictures = _pictures(document)
    lenses = once_each(map(_lens, pictures))
    placed = []
    for number, (picture, lens) in enumerate(zip(pictures, lenses, strict=True), 1):
        rows = np.reshape(picture.numbers("extrinsic", 16), (4, 4)).T.tolist()
        pose = inverted(pose_of(document, rows, picture.said("extrinsic")))
        placed.append(Placed(lens.name, "", float(number) if len(pictures) > 1 else None, pose))
    return placed


def _of_log(document: Document) -> list[Placed]:
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
