"""Bundler's bundle.out: for each picture the focal length, two radial coefficients, and the pose.

The center is the middle of the picture, whose size is that of the frame. The rotation and the translation lead from the
world to a camera like Blender's, y up and z back. Pictures with a focal length of 0 were not reconstructed.
Reference: Bundler User's Manual, Output format and scene representation.
"""

import numpy as np

from .parts.document import Document
from .parts.lens import FRAME_SIZE, Lens, different, matrix, once_each
from .parts.placed import FROM_BLENDER, Placed, checked, inverted
from .parts.program import ProgramFiles

HEAD = "# Bundle file v0."
PER_PICTURE = 5
"""Lines of a picture."""


def looks(document: Document) -> bool:
    return document.text.startswith(HEAD)


def _pictures(document: Document) -> list[tuple[str, list[float], np.ndarray]]:
    """Return name, numbers of the lens, and pose, of each picture that was reconstructed."""
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
            to_camera = np.eye(4)
            to_camera[:3, :3], to_camera[:3, 3] = rows[1:4], rows[4]
            pictures.append((name, rows[0], checked(document, to_camera, f"rotation of {name}")))
    return pictures


def _lenses(document: Document) -> list[Lens]:
    width, height = document.picture_size or (1, 1)
    return once_each(
        Lens(name, "OPENCV_PINHOLE", FRAME_SIZE | matrix(f, f, width / 2, height / 2, 0.5) | {"k1": k1, "k2": k2})
        for name, (f, k1, k2), _ in _pictures(document)
    )


def read(document: Document) -> list[Lens]:
    return different(_lenses(document))


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles. The frames are the numbers of the pictures in Bundler's list of them, from 1 on."""
    return [
        Placed(lens.name, "", float(name.rpartition(" ")[2]) + 1, inverted(pose) @ FROM_BLENDER)
        for (name, _, pose), lens in zip(_pictures(document), _lenses(document), strict=True)
    ]


PROGRAM = ProgramFiles(
    "Bundler", "bundle.out", looks, reads="pinhole with k1 and k2", lost="the size of the pictures and their names",
    read=read, poses=poses,
)  # fmt: skip
