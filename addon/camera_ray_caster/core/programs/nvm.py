"""VisualSFM's .nvm: for each picture the focal length, the rotation, the center and a radial coefficient.

The middle of the picture, whose size is that of the frame, is the center unless FixedK tells another camera matrix. The
radial coefficient leads from the picture to the undistorted one: r (1 + k r^2), which is OCam's model with a power
series; r is in focal lengths, as other readers take it. The quaternion w, x, y, z leads from the world to the camera,
x right, y down, z ahead. The first model of a file is read.
Reference: VisualSFM documentation, NVM file format.
"""

import re
from math import inf

from .parts.document import Document
from .parts.lens import FRAME_SIZE, Lens, matrix
from .parts.placed import Placed, inverted, of_quaternion, of_rotation
from .parts.program import ProgramFiles, of_pictures

HEAD, TURNED = "NVM_V3", "NVM_V3_R9T"
"""The second has a rotation of nine numbers and a translation, from the world to the camera."""
STRONGEST, TERMS = 0.4, 24
"""Largest distortion, and terms of its power series: they leave STRONGEST^25, 1e-10 of the focal length."""
PICTURE = re.compile(r'("[^"]*"|\S+)\s+(.*)')


def looks(document: Document) -> bool:
    return document.text.startswith(HEAD)


Picture = tuple[str, list[float], list[float]]
"""Name; fx, cx, fy, cy and the radial coefficient; and the numbers of the pose."""


def _pictures(document: Document) -> list[Picture]:
    head, *lines = document.lines()
    words, (width, height) = head.split(), document.picture_size or (1, 1)
    fixed = document.numbers(words[words.index("FixedK") + 1 :], "FixedK", 5) if "FixedK" in words else None
    count = int(document.numbers(lines[0].split()[:1] if lines else None, "number of cameras", 1)[0])
    total = 15 if document.text.startswith(TURNED) else 10
    pictures = []
    for line in lines[1 : 1 + max(count, 0)]:
        document.check()
        match = PICTURE.fullmatch(line)
        name = match[1].strip('"') if match else line[:20]
        numbers = document.numbers(match[2].split() if match else None, f"line of {name}", total)
        f, *pose, radial, _ = numbers
        pictures.append((name, fixed or [f, width / 2, f, height / 2, radial], pose))
    if len(pictures) < count:
        raise document.refusal(f"it has {len(pictures)} of {count:,} cameras")
    return pictures


def _lens(document: Document, picture: Picture) -> Lens:
    """Return the lens of a picture. With a radial coefficient its rays are (x, y, f / (1 + radial (r / f)^2)) for
    pixels x, y at r from the center, with a power series of the third component.
    """
    name, (fx, cx, fy, cy, radial), _ = picture
    if not radial:
        return Lens(name, "OPENCV_PINHOLE", FRAME_SIZE | matrix(fx, fy, cx, cy, 0.5))
    width, height = document.picture_size or (1, 1)
    share = abs(radial) * ((width / 2) ** 2 + (height / 2) ** 2) / fx**2 if fx > 0 else inf
    if share > STRONGEST or fx != fy:
        raise document.refusal(
            f"the radial distortion of {name} is {radial:g}, with focal lengths {fx:g} and {fy:g}: it is read with "
            f"equal ones, and up to {STRONGEST:g} of the radius in the corner of the frame; undistort the pictures"
        )
    coefficients = [-fx]
    for _ in range(TERMS):
        coefficients += [0.0, -radial / fx**2 * coefficients[-1]]
    polynomial = " ".join(map(repr, coefficients))
    return Lens(name, "OCAM", FRAME_SIZE | {"cx": cx - 0.5, "cy": cy - 0.5, "ocam_polynomial": polynomial})


def _placed(document: Document, picture: Picture) -> Placed:
    name, _, (*turn, x, y, z) = picture
    if len(turn) == 4:
        pose = of_quaternion(document, [turn[0], *(-number for number in turn[1:])], [x, y, z], name)
    else:
        pose = inverted(of_rotation(document, turn, [x, y, z], f"rotation of {name}"))
    return Placed("", name, None, pose)


PROGRAM = ProgramFiles(
    "NVM", "VisualSFM's .nvm", looks, reads="pinhole, with a radial coefficient", lost="the size of the pictures",
    **of_pictures(_pictures, _lens, _placed),
)  # fmt: skip
