"""ARKitScenes: .pincam files, a line of width, height, fx, fy, cx, cy, and the trajectory that moves the camera, .traj.

The center of the first pixel is (0, 0). A line of the trajectory has seconds, axis times angle, and x, y, z, from the
world to the camera.
References: ARKitScenes documentation, Dataset files formats; its tenFpsDataLoader.
"""

from pathlib import Path

import numpy as np

from ..units import METERS
from .parts.document import Document
from .parts.lens import Lens, matrix, numbers_of
from .parts.placed import Placed, inverted, of_rotation
from .parts.program import PictureFolders, ProgramFiles
from .parts.trajectory import columns_of, rows_of

PINCAM, TRAJECTORY = ".pincam", ".traj"


def looks(document: Document) -> bool:
    return _pincam(document) is not None or bool(_rows(document))


def read(document: Document) -> list[Lens]:
    words = _pincam(document)
    if words is None:
        raise document.refusal("it is a trajectory, which has no lens")
    width, height, *intrinsics = document.numbers(words, "the line", 6)
    return [Lens("", "OPENCV_PINHOLE", document.size(width, height) | matrix(*intrinsics))]


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles. The camera of a .pincam stands in the frame that the trajectory moves."""
    if _pincam(document) is not None:
        return [Placed("", "", None, np.eye(4))]
    return [_moved(document, number, row) for number, row in enumerate(_rows(document), 1)]


def _rows(document: Document) -> list[list[str]]:
    """Return the lines of a trajectory; [] of any other file."""
    rows = rows_of(document) if Path(document.path).suffix.lower() == TRAJECTORY else []
    if not rows or len(numbers_of(rows[0])) != 7 or columns_of(document) is not None:
        return []
    return rows


def _moved(document: Document, number: int, words: list[str]) -> Placed:
    document.check()
    time, *pose = document.numbers(words, f"pose {number}", 7)
    return Placed("", "", None, inverted(of_rotation(document, pose[:3], pose[3:], f"pose {number}")), time)


def _pincam(document: Document) -> list[str] | None:
    """Return the six numbers of a .pincam, as they stand there; None of any other file."""
    words = document.text[:1000].split()
    return words if len(words) == 6 and len(numbers_of(words)) == 6 and "\n" not in document.text.strip() else None


def hint(document: Document) -> str:
    if Path(document.path).suffix.lower() == PINCAM:
        return "it must be one line of six numbers: width, height, fx, fy, cx and cy"
    return "its lines must have seven numbers: a time, axis times angle, and x, y, z"


PROGRAM = ProgramFiles(
    "ARKitScenes", ".pincam; .traj", looks, reads="pinhole", read=read, poses=poses, unit=METERS,
    columns="(.traj) 7",
    endings=(PINCAM, TRAJECTORY), hint=hint,
    pictures=PictureFolders(f"*{PINCAM}", ("", "lowres_wide_intrinsics"), moved_by=TRAJECTORY),
)  # fmt: skip
