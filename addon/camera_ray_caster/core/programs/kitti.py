"""KITTI's calibrations and poses: calib_cam_to_cam.txt of its raw data, perspective.txt of KITTI-360, the calib.txt of
its benchmarks, which have a file for each picture, too, and poses.txt of its odometry.

A line of a calibration is a name, a colon and numbers. Camera 02 of the raw data has the size S_02, the matrix K_02,
the distortion D_02 as OpenCV's, and R_02 and T_02, from the frame of camera 00 to its own; rectified it has S_rect_02
and the matrix P_rect_02, from the frame of camera 00 after its turn by R_rect_00. The benchmarks have P0 to P3 alone,
which are those matrices, without sizes. A lens is named after its matrix. The center of the first pixel is (0, 0).
A line of poses.txt has 3 or 4 rows of 4 numbers, from the camera to the world, and before them its frame or its time,
if it has any; without, the first line is frame 1. So are those of KITTI-360 and of Replica.
References: A. Geiger, P. Lenz, C. Stiller and R. Urtasun, Vision meets Robotics: The KITTI Dataset (2013); the
development kits of KITTI's raw data and odometry; KITTI-360 documentation.
"""

import re
from functools import partial

import numpy as np

from ..conventions import LAST_FRAME
from ..maths.rotations import transform
from ..units import METERS
from .parts.document import Document
from .parts.lens import Lens, numbers_of, one_of_several
from .parts.placed import Placed, inverted, of_rotation, pose_of
from .parts.plain import plain_lens
from .parts.program import CameraRecord, FileWriter, ProgramFiles, line_by_line
from .parts.trajectory import seconds

LINE = re.compile(r"^(P\d|[SKDRT]_\d\d|[SRP]_rect_\d\d):[ \t]+(\S+[ \t]+[^\s#].*)$", re.MULTILINE)
"""A line of a name and two words or more: one number named P1 is a coefficient of other formats."""
LENS = re.compile(r"P\d|K_\d\d|P_rect_\d\d")
"""Names of the matrices that are lenses."""
ENDING = "_kitti.txt"
REFERENCE = "R_rect_00"
POSES = 12, 13, 16, 17
"""How many numbers a line of poses has."""
LONGEST = 1000
"""Characters in which such a line ends."""


def looks(document: Document) -> bool:
    return _has_rows(document) or any(map(LENS.fullmatch, _lines(document)))


def read(document: Document) -> list[Lens]:
    lines = _lines(document)
    if not any(map(LENS.fullmatch, lines)):
        raise document.refusal("it has KITTI's poses, and no lens")
    return [one_of_several(name, _lens, document, lines, name) for name in lines if LENS.fullmatch(name)]


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles: those of the cameras of a calibration, in the frame of the first one, or of poses.txt."""
    if _has_rows(document):
        rows = [line.split() for line in document.text.splitlines() if line.strip()]
        have_frames = all(row[0].isdecimal() and float(row[0]) <= LAST_FRAME for row in rows)
        return [_moved(document, number, row, len(rows[0]), have_frames) for number, row in enumerate(rows, 1)]
    lines = _lines(document)
    return [Placed(lens.name, "", None, _pose(document, lines, lens)) for lens in read(document)]


def _has_rows(document: Document) -> bool:
    first = document.text[:LONGEST].strip().partition("\n")[0].split()
    return len(first) in POSES and len(numbers_of(first)) == len(first)


def _lines(document: Document) -> dict[str, list[str]]:
    """Return the words of each line of a calibration by its name."""
    return {name: words.split() for name, words in LINE.findall(document.text)}


def _lens(document: Document, lines: dict[str, list[str]], name: str) -> Lens:
    """Return a lens, which is OpenCV's pinhole."""
    kind, _, number = name.rpartition("_")
    numbers = partial(_numbers, document, lines)
    matrix = numbers(name, 9) if kind == "K" else np.reshape(numbers(name, 12), (3, 4))[:, :3].ravel().tolist()
    entries: dict = {"camera_matrix": matrix, "distortion_model": "plumb_bob"}
    size = f"S{kind[1:]}_{number}"
    if kind and size in lines:
        entries |= zip(("image_width", "image_height"), numbers(size, 2), strict=True)
    if kind == "K":
        entries["distortion_coefficients"] = numbers(f"D_{number}", 5)
    return plain_lens(document.part(entries))._replace(name=name)


def _pose(document: Document, lines: dict[str, list[str]], lens: Lens) -> np.ndarray:
    """Return the pose of a camera in the frame of camera 00, before it was rectified if the file tells both."""
    if lens.refusal is not None:
        raise lens.refusal
    name = lens.name
    kind, _, number = name.rpartition("_")
    if kind == "K":
        turn, move = _numbers(document, lines, f"R_{number}", 9), _numbers(document, lines, f"T_{number}", 3)
        return inverted(of_rotation(document, turn, move, f"R_{number} and T_{number}"))
    matrix, turn = np.reshape(_numbers(document, lines, name, 12), (3, 4)), np.eye(3).ravel().tolist()
    if kind and REFERENCE in lines:
        turn = _numbers(document, lines, REFERENCE, 9)
    moved = transform(np.eye(3), np.linalg.solve(matrix[:, :3], matrix[:, 3]))
    return inverted(moved @ of_rotation(document, turn, [0.0] * 3, REFERENCE))


def _moved(document: Document, number: int, row: list[str], count: int, have_frames: bool) -> Placed:
    document.check()
    if len(row) != count:
        raise document.refusal(f"pose {number} has {len(row)} numbers, and the first one {count}")
    pose = pose_of(document, row[len(row) % 4 :], f"pose {number}")
    if len(row) % 4 == 0:
        return Placed("", "", float(number), pose, moves=True)
    (moment,) = document.numbers(row[:1], f"the time of pose {number}", 1)
    if have_frames:
        return Placed("", "", moment, pose, moves=True)
    return Placed("", "", None, pose, seconds(moment))


def _numbers(document: Document, lines: dict[str, list[str]], name: str, count: int) -> list[float]:
    return document.numbers(lines.get(name), name, count)


def _line(record: CameraRecord) -> str:
    return " ".join(map(repr, record.pose[:3].ravel().tolist()))


PROGRAM = ProgramFiles(
    "KITTI", "calib_cam_to_cam.txt, also perspective.txt of KITTI-360; calib.txt; poses .txt", looks,
    marks="P0 P1 P2 P3 Tr", reads="pinholes as calibrated (K_02) and rectified (P_rect_02, P2), and their places",
    lost="of calib.txt the size of the pictures; of poses lenses and times", read=read, poses=poses, unit=METERS,
    columns="12 or 16, also after a frame",
    export=FileWriter(
        "kitti", "KITTI Poses", "<camera>_kitti.txt: a matrix for each frame, of any camera",
        line_by_line(ENDING, _line), ending=ENDING,
    ),
)  # fmt: skip
