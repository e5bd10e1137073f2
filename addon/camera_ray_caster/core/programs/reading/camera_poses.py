"""The poses of the cameras of a file of any program; see ``placed``."""

import re
from pathlib import PurePath

import numpy as np

from ...conventions import LAST_FRAME
from ...units import factor
from .. import PLACED, program_of
from ..parts.document import Document
from ..parts.placed import Placed
from .unknown_file import unknown

DATE = re.compile(
    r"(|.*\D)(19|20)\d\d([-_.]?)(0[1-9]|1[0-2])\3([0-2]\d|3[01])"
    r"([-_T ]?([01]\d|2[0-3])([-_.:]?)[0-5]\d(\8[0-5]\d\d*)?)?"
)
"""A name that ends in a date, with a time of the day or without."""
ENDING = re.compile(r"(?:(.*?)[_-](?=.))?(-?\d{4,}(?:\.\d+)?)(?:[_.-]([A-Za-z]\w*))?")
"""The name of a picture of this add-on, CAMERA_FRAME, or of others, FRAME, FRAME_CAMERA or CAMERA-FRAME.CAMERA."""


def placed_in(document: Document, meters: float) -> list[Placed]:
    """Return the poses of a document in its order, their places in Blender units of ``meters``. Raises InputError, in
    one line, for a document without poses.
    """
    program = program_of(document)
    document.check()
    if program is None and not document.has_entries:
        raise unknown(document)
    placed = [] if program is None or program.poses is None else program.poses(document)
    if program is not None and program.poses is not None and not placed and not program.general:
        raise document.refusal("it has no pose of a camera")
    if program is None or not placed:
        raise document.refusal(f"it has no poses that are read: give a file of {PLACED}")
    size = np.ones((4, 4))
    size[:3, 3] = factor(program.unit, meters)
    return [pose.changed(lambda matrix: matrix / size) for pose in placed]


def object_and_frame(image: str) -> tuple[str, float | None]:
    """Return the camera's name and the frame in the name of a picture, which may have folders and an ending; "" is the
    camera of a number alone. A number beyond Blender's frames, such as a time in nanoseconds, is none, and so is a
    date.
    """
    stem = PurePath(image.replace("\\", "/")).name
    stem = stem.rsplit(".", 1)[0] if re.search(r"\.[A-Za-z]+\d?$", stem) else stem
    match = ENDING.fullmatch(stem)
    if match is None or DATE.fullmatch(stem[: match.end(2)]) or abs(float(match[2])) > LAST_FRAME:
        return stem, None
    return "_".join(filter(None, (match[1], match[3]))), float(match[2])
