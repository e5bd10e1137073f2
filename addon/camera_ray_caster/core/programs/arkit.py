"""The cameras of Apple's ARKit: .pincam files of ARKitScenes, and those that Polycam stores for each picture.

A .pincam is one line: width, height, fx, fy, cx, cy; the center of the first pixel is (0, 0). Its camera stands in the
frame that the trajectory beside it (.traj) moves. Polycam's JSON, whose lens is read by its plain names, has the rows
of a matrix, t_00 to t_23, from the camera, y up and z back, to a world whose y is up.
References: ARKitScenes documentation, Dataset files formats; polyform, Polycam's data format.
"""

from __future__ import annotations

import numpy as np

from .parts.document import Document
from .parts.lens import Lens, matrix, numbers_of
from .parts.placed import FROM_BLENDER, Placed, pose_of

ENTRIES = [[f"t_{row}{column}" for column in range(4)] for row in range(3)]
"""Names of the entries of Polycam's matrix."""


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lens of a .pincam; see the package."""
    numbers = of_pincam(document)
    if numbers is None:
        return None
    width, height, *rest = document.numbers(numbers, "the line", 6)
    return [Lens("", "OPENCV_PINHOLE", document.size(width, height) | matrix(*rest))]


def poses(document: Document) -> list[Placed] | None:
    """Return the pose of the camera of a document; None of any other file. Raises InputError."""
    if of_pincam(document) is not None:
        return [Placed("", "", None, np.eye(4))]
    entries = document.raw
    if ENTRIES[0][0] not in entries:
        return None
    rows = [[document.number(entries, name) for name in row] for row in ENTRIES]
    return [Placed("", "", None, pose_of(document, rows, "the matrix t_00 to t_23") @ FROM_BLENDER)]


def of_pincam(document: Document) -> list[str] | None:
    """Return the six numbers of a .pincam, as they stand there; None of any other file."""
    words = document.text[:1000].split()
    return words if len(words) == 6 and len(numbers_of(words)) == 6 and "\n" not in document.text.strip() else None
