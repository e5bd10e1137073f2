"""The poses of the cameras of a file of any program; see ``placed``."""

from __future__ import annotations

import re
from pathlib import PurePath

import numpy as np

from ...conventions import LAST_FRAME
from ...units import factor
from .. import PLACED, program_of
from ..parts.document import Document
from ..parts.placed import Placed
from .nearest import unknown

ENDING = re.compile(r"(.*?)_(-?\d{4,}(?:\.\d+)?)")
"""The name of a picture of this add-on: CAMERA_FRAME."""


def placed_in(document: Document, meters: float) -> list[Placed]:
    """Return the poses of a document in its order, their places in Blender units of ``meters``. Raises InputError, in
    one line, for a document without poses.
    """
    program = program_of(document)
    document.check()
    if program is None and not document.has_entries:
        raise unknown(document)
    placed = [] if program is None or program.poses is None else program.poses(document)
    if program is None or not placed:
        raise document.refusal(f"it has no poses that are read: give a file of {PLACED}")
    size = np.ones((4, 4))
    size[:3, 3] = factor(program.unit, meters)
    return [one._replace(pose=one.pose / size) for one in placed]


def object_and_frame(image: str) -> tuple[str, float | None]:
    """Return the camera's name and the frame in the name of a picture, which may have folders and an ending. A number
    beyond Blender's frames, such as a time in nanoseconds, is none.
    """
    stem = PurePath(image.replace("\\", "/")).name
    stem = stem.rsplit(".", 1)[0] if re.search(r"\.[A-Za-z]+\d?$", stem) else stem
    found = ENDING.fullmatch(stem)
    return (found[1], float(found[2])) if found and abs(float(found[2])) <= LAST_FRAME else (stem, None)
