"""poses_bounds.npy of LLFF and of data sets after it: a row of 17 numbers for each picture.

The first 15 are a matrix of three rows: the camera's axes down, right and back, its place, and height, width and focal
length in pixels. The last two are the nearest and the farthest depth. The center is the middle of the picture.
Reference: LLFF, its documentation, Using your own poses.
"""

import numpy as np

from .parts import ray_arrays
from .parts.document import Document
from .parts.lens import Lens, different, matrix, once_each
from .parts.placed import Placed, checked
from .parts.program import ProgramFiles


def looks(document: Document) -> bool:
    return ray_arrays.is_poses_bounds(document)


def _rows(document: Document) -> np.ndarray:
    return ray_arrays.array_of(document)[:, :15].reshape(-1, 3, 5)


def _lenses(document: Document) -> list[Lens]:
    lenses = []
    for number, (height, width, focal) in enumerate(_rows(document)[:, :, 4].tolist(), 1):
        document.check()
        document.numbers([height, width, focal], f"size and focal length of picture {number}", 3)
        settings = document.size(width, height) | matrix(focal, focal, width / 2, height / 2, 0.5)
        lenses.append(Lens(f"picture {number}", "OPENCV_PINHOLE", settings))
    return once_each(lenses)


def read(document: Document) -> list[Lens]:
    return different(_lenses(document))


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles: one for each frame."""
    placed = []
    for number, (row, lens) in enumerate(zip(_rows(document), _lenses(document), strict=True), 1):
        document.numbers(row[:, :4].ravel().tolist(), f"pose {number}", 12)
        down, right, back, position = row.T[:4]
        pose = np.eye(4)
        pose[:3] = np.stack((right, down, -back, position), axis=1)
        placed.append(Placed(lens.name, "", float(number), checked(document, pose, f"pose {number}")))
    return placed


PROGRAM = ProgramFiles("LLFF", "poses_bounds.npy", looks, reads="pinhole", lost="distortion", read=read, poses=poses)
