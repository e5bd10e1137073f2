"""The poses of the cameras of a file of any program; see ``placed``."""

import re
from collections.abc import Sequence
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


def objects_and_frames(images: Sequence[str]) -> list[tuple[str, float | None]]:
    """Return the camera's name and the frame in each picture's name, which may have folders and an ending; "" is the
    camera of a number alone. A number beyond Blender's frames, such as a time in nanoseconds, is none, and so is a
    date. Words behind frames that are those of single pictures, such as titles, name no cameras, and neither do times
    of pictures before their numbers.
    """
    stems = [PurePath(image.replace("\\", "/")).name for image in images]
    stems = [stem.rsplit(".", 1)[0] if re.search(r"\.[A-Za-z]+\d?$", stem) else stem for stem in stems]
    matches = [_of_frame(stem) for stem in stems]
    names = [(match[1] or "", match[3] or "", float(match[2])) for match in matches if match]
    cameras, frames = {name[:2] for name in names}, {frame for _, _, frame in names}
    once = len(cameras) == len(names) and len(frames) > 1 and any(word or DATE.match(name) for name, word, _ in names)
    apart = len({word for _, word, _ in names}) > 1 and len({(name, frame) for name, _, frame in names}) == len(names)
    if once or apart:
        return [(stem, None) for stem in stems]
    return [("_".join(filter(None, (match[1], match[3]))), float(match[2])) if match else (stem, None)
            for stem, match in zip(stems, matches, strict=True)]  # fmt: skip


def _of_frame(stem: str) -> re.Match[str] | None:
    match = ENDING.fullmatch(stem)
    is_none = match is None or DATE.fullmatch(stem[: match.end(2)]) or abs(float(match[2])) > LAST_FRAME
    return None if is_none else match
