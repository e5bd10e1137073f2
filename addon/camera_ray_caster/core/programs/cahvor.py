"""JPL's camera models as text, .cahv, .cahvor and .cahvore: lines NAME = numbers.

C is the place, A the axis, H and V lead to the column and the row; O is the axis of the distortion R, and E that of
CAHVORE's pupil: see ``parts.cahvor_lens``. Model = CAHVORE1 has the linearity 1, CAHVORE2 0, CAHVORE3,L its number.
The frame of a camera's lens has z along O. Lengths are meters, the file's frame is that of C.
Reference: JPL, the CAHV family of camera models.
"""

import re

import numpy as np

from ..units import METERS
from .parts.cahvor_lens import lens_of
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens
from .parts.placed import Placed, of_rotation
from .parts.program import ProgramFiles

LINE = re.compile(r"(\w+)\s*=\s*(.*)")
KIND = re.compile(r"CAHVORE\s*([123])(?:\s*,\s*([-+.\deE]+))?")
LINEARITY = {"1": 1.0, "2": 0.0}


def looks(document: Document) -> bool:
    return "=" in document.text and "{" not in document.text and _entries(document).has("C", "A", "H", "V")


def _entries(document: Document) -> Fields:
    matches = [match for line in document.lines() if (match := LINE.match(line))]
    texts = {match[1]: match[2].strip() for match in matches}
    return Fields(document, {name: text if name == "Model" else text.split() for name, text in texts.items()})


def read(document: Document) -> list[Lens]:
    return [_lens(document)[0]]


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles: in the frame of the file."""
    axes, center = _lens(document)[1], _entries(document).numbers("C", 3)
    return [Placed("", "", None, of_rotation(document, axes, center, "the frame of its lens"))]


def _lens(document: Document) -> tuple[Lens, np.ndarray]:
    entries = _entries(document)
    rows = [entries.numbers(name, 3) for name in "HVA"]
    kind, axis = entries.text("Model"), entries.numbers("O", 3, default=rows[2])
    radial, pupil = (entries.numbers(name, 3, default=[0.0] * 3) for name in "RE")
    match = KIND.search(kind)
    if (match is None) != (not entries.has("E")):
        raise document.refusal(f"Model is {kind!r}: CAHVORE1, CAHVORE2 or CAHVORE3,L has E, and no other model")
    linearity_words = match[2] and [match[2]] if match and match[1] == "3" else [LINEARITY[match[1]] if match else 1.0]
    linearity = document.numbers(linearity_words, "linearity", 1)[0]
    return lens_of(document, entries.size("Dimensions"), rows, axis, radial, pupil, linearity)


PROGRAM = ProgramFiles(
    "CAHVOR", ".cahv, .cahvor and .cahvore of JPL", looks, marks="Model Dimensions C A H V O R",
    reads="CAHV, CAHVOR, CAHVORE", lost="S and covariances", read=read, poses=poses, unit=METERS,
)  # fmt: skip
