"""OCamCalib's calib_results.txt: five lines of numbers, with comments between them; and the same as JSON.

The lines are the polynomial after its number of coefficients, the inverse polynomial, which is not needed, the center
(row, column), the affine terms c, d and e, and the picture's height and width.
The JSON of data sets of head-mounted cameras has the polynomial as polynomialC2W, and size and image_center as x and y;
in place of the center it may have a matrix, intrinsic, whose last column but one is the center.
The center of the first pixel is (0, 0).
Reference: D. Scaramuzza, OCamCalib: Omnidirectional Camera Calibration Toolbox for Matlab.
"""

import re

import numpy as np

from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens
from .parts.program import ProgramFiles

BEGIN, COMMENT = re.compile(r"\d+\s+[-+.\d]"), "#polynomial"
"""Pattern of the first line, and what the toolbox writes before it. Files of poses begin with numbers, too."""


def looks(document: Document) -> bool:
    if document.text.lstrip()[:1] == "{" or not document.text:
        return document.entries.has("polynomialC2W")
    lines = document.lines()
    if not lines or not BEGIN.match(lines[0]):
        return False
    return COMMENT in document.text or (len(lines) == 5 and len(lines[2].split()) == 2)


def read(document: Document) -> list[Lens]:
    if document.text.lstrip()[:1] == "{" or not document.text:
        entries = document.entries
        terms, size = entries.numbers("affine", 3, [1.0, 0.0, 0.0]), entries.numbers("size", 2)
        return [_lens(document, entries.numbers("polynomialC2W"), _center(entries), terms, size)]
    lines = document.lines()
    if len(lines) != 5:
        raise document.refusal(f"it has {len(lines)} lines of numbers: a calib_results.txt of OCamCalib has 5")
    polynomial, _, center, affine, sides = (line.split() for line in lines)
    count, *coefficients = document.numbers(polynomial, "its polynomial")
    if count != len(coefficients):
        raise document.refusal(f"its polynomial has {len(coefficients)} coefficients, but states {count:g}")
    row, column = document.numbers(center, "its center", 2)
    height, width = document.numbers(sides, "its image size", 2)
    terms = document.numbers(affine, "its affine parameters", 3)
    return [_lens(document, coefficients, (column, row), terms, (width, height))]


def _center(entries: Fields) -> list[float]:
    if entries.has("image_center") or not entries.has("intrinsic"):
        return list(entries.numbers("image_center", 2))
    return np.reshape(entries.matrix("intrinsic", 16), (4, 4))[:2, 2].tolist()


def _lens(document: Document, coefficients, center, terms, size) -> Lens:
    return Lens("", "OCAM", document.size(*size) | {
        "cx": center[0], "cy": center[1], "ocam_polynomial": " ".join(map(repr, coefficients)),
        **{f"ocam_{name}": number for name, number in zip("cde", terms, strict=True)},
    })  # fmt: skip


PROGRAM = ProgramFiles(
    "OCamCalib", "calib_results.txt; the same as .json", looks,
    marks="polynomial direct mapping affine polynomialC2W image_center", reads="OCam", read=read,
)  # fmt: skip
