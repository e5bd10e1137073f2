"""poses_bounds.npy of LLFF and of data sets after it: a row of 17 numbers for each picture.

The first 15 are a matrix of three rows: the camera's axes down, right and back, its place, and height, width and focal
length in pixels. The last two are the nearest and the farthest depth. The center is the middle of the picture.
Reference: LLFF, its documentation, Using your own poses.
"""

import numpy as np

from .parts.document import Document
from .parts.lens import Lens, matrix
from .parts.placed import Placed, of_rotation
from .parts.program import ProgramFiles, of_pictures
from .parts.ray_arrays import array_of, is_poses_bounds


def _pictures(document: Document) -> list[tuple[int, np.ndarray]]:
    """Return the number and the matrix, (3, 5), of each picture."""
    return list(enumerate(array_of(document)[:, :15].reshape(-1, 3, 5), 1))


def _lens(document: Document, picture: tuple[int, np.ndarray]) -> Lens:
    document.check()
    number, rows = picture
    height, width, focal = document.numbers(rows[:, 4].tolist(), f"size and focal length of picture {number}", 3)
    settings = document.size(width, height) | matrix(focal, focal, width / 2, height / 2, 0.5)
    return Lens(f"picture {number}", "OPENCV_PINHOLE", settings)


def _placed(document: Document, picture: tuple[int, np.ndarray]) -> Placed:
    number, rows = picture
    document.numbers(rows[:, :4].ravel().tolist(), f"pose {number}", 12)
    down, right, back, position = rows.T[:4]
    axes = np.stack((right, down, -back), axis=1)
    return Placed("", "", float(number), of_rotation(document, axes, position, f"pose {number}"))


PROGRAM = ProgramFiles(
    "LLFF", "poses_bounds.npy", is_poses_bounds, reads="pinhole", lost="distortion",
    **of_pictures(_pictures, _lens, _placed),
)  # fmt: skip
