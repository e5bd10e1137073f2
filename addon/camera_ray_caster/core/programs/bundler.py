"""Bundler's bundle.out: for each picture the focal length, two radial coefficients, and the pose.

The center is the middle of the picture, whose size is that of the frame. The rotation and the translation lead from the
world to a camera like Blender's, y up and z back. Pictures with a focal length of 0 were not reconstructed.
Reference: Bundler User's Manual, Output format and scene representation.
"""

import numpy as np

from .parts.document import Document
from .parts.lens import FRAME_SIZE, Lens, matrix
from .parts.placed import FROM_BLENDER, Placed, inverted, of_rotation
from .parts.program import ProgramFiles, of_pictures

HEAD = "# Bundle file v0."
PER_PICTURE = 5
"""Lines of a picture."""


def looks(document: Document) -> bool:
    return document.text.startswith(HEAD)


Picture = tuple[str, list[float], np.ndarray]
"""Name, numbers of the lens, and pose."""


def _pictures(document: Document) -> list[Picture]:
    """Return the pictures that were reconstructed."""
    lines = document.lines()
    count = document.numbers(lines[0].split() if lines else None, "line of numbers of cameras and points", 2)[0]
    pictures = []
    for number in range(int(min(max(count, 0), len(lines)))):
        document.check()
        name, lines_of_picture = f"picture {number}", lines[1 + number * PER_PICTURE :][:PER_PICTURE]
        rows = [document.numbers(line.split(), name, 3) for line in lines_of_picture]
        if len(rows) < PER_PICTURE:
            raise document.refusal(f"{name} has {len(rows)} lines: it must have {PER_PICTURE}")
        if rows[0][0]:
            pictures.append((name, rows[0], of_rotation(document, rows[1:4], rows[4], f"rotation of {name}")))
    return pictures


def _lens(document: Document, picture: Picture) -> Lens:
    (name, (f, k1, k2), _), (width, height) = picture, document.picture_size or (1, 1)
    settings = FRAME_SIZE | matrix(f, f, width / 2, height / 2, 0.5) | {"k1": k1, "k2": k2}
    return Lens(name, "OPENCV_PINHOLE", settings)


def _placed(document: Document, picture: Picture) -> Placed:
    """Return the pose of a picture. Frames are the numbers in Bundler's list of pictures, from 1 on."""
    name, _, pose = picture
    return Placed("", "", float(name.rpartition(" ")[2]) + 1, inverted(pose) @ FROM_BLENDER)


PROGRAM = ProgramFiles(
    "Bundler", "bundle.out", looks, reads="pinhole with k1 and k2", lost="the size of the pictures and their names",
    **of_pictures(_pictures, _lens, _placed),
)  # fmt: skip
