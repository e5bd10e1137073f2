"""VisualSFM's .nvm: for each picture the focal length, the rotation, the center and a radial coefficient.

The middle of the picture, whose size is that of the frame, is the center unless FixedK tells another camera matrix. The
quaternion w, x, y, z leads from the world to the camera, x right, y down, z ahead. The first model of a file is read.
Reference: VisualSFM documentation, NVM file format.
"""

from __future__ import annotations

import re

from .parts.document import Document
from .parts.lens import FRAME_SIZE, Lens, different, matrix, once_each
from .parts.placed import Placed, of_quaternion
from .parts.program import ProgramFiles

HEAD = "NVM_V3"
PICTURE = re.compile(r'("[^"]*"|\S+)\s+(.*)')


def looks(document: Document) -> bool:
    """See ProgramFiles."""
    return document.text.startswith(HEAD)


def _pictures(document: Document) -> list[tuple[str, list[float]]]:
    """Return the name and the numbers of each picture."""
    lines = document.lines()[1:]
    count = int(document.numbers(lines[0].split()[:1] if lines else None, "number of cameras", 1)[0])
    pictures = []
    for line in lines[1 : 1 + max(count, 0)]:
        document.check()
        match = PICTURE.fullmatch(line)
        name = match[1].strip('"') if match else line[:20]
        pictures.append((name, document.numbers(match[2].split() if match else None, f"line of {name}", 10)))
    if len(pictures) < count:
        raise document.refusal(f"it has {len(pictures)} of {count:,} cameras")
    return pictures


def _lenses(document: Document) -> list[Lens]:
    width, height = document.frame or (1, 1)
    fixed = document.lines()[0].split()
    lenses = []
    for name, (f, *_, radial, _end) in _pictures(document):
        own = matrix(f, f, width / 2, height / 2, 0.5)
        if "FixedK" in fixed:
            fx, cx, fy, cy, radial = document.numbers(fixed[fixed.index("FixedK") + 1 :], "FixedK", 5)
            own = matrix(fx, fy, cx, cy, 0.5)
        if radial:
            raise document.refusal(
                f"the radial distortion of {name} is {radial:g}: it leads from pictures to rays, which no model has; "
                "undistort the pictures in VisualSFM, or export a Bundler file"
            )
        lenses.append(Lens(name, "OPENCV_PINHOLE", FRAME_SIZE | own))
    return once_each(lenses)


def read(document: Document) -> list[Lens]:
    """See ProgramFiles."""
    return different(_lenses(document))


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles."""
    placed = []
    for (name, (_, w, x, y, z, *center, _radial, _end)), lens in zip(
        _pictures(document), _lenses(document), strict=True
    ):
        pose = of_quaternion(document, [w, -x, -y, -z], center, name)
        placed.append(Placed(lens.name, name, None, pose))
    return placed


PROGRAM = ProgramFiles(
    "NVM", "VisualSFM's .nvm", looks, reads="pinhole", lost="the size of the pictures; radial distortion is refused",
    read=read, poses=poses,
)  # fmt: skip
