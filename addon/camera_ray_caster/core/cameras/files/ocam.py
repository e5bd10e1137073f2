"""OCamCalib's calib_results.txt: five lines of numbers, with comments between them.

The lines are the polynomial after its number of coefficients, the inverse polynomial, which is not needed, the center
(row, column), the affine terms c, d and e, and the picture's height and width.
The center of the first pixel is (0, 0).
Reference: D. Scaramuzza, OCamCalib: Omnidirectional Camera Calibration Toolbox for Matlab.
"""

from __future__ import annotations

import re

from .document import Document, Lens

BEGIN, COMMENT = re.compile(r"\d+\s+[-+.\d]"), "#polynomial"
"""Pattern of the first line, and what the toolbox writes before it. COLMAP's files of poses begin with numbers, too."""


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lens of a document; see the package."""
    lines = [line for line in map(str.strip, document.text.splitlines()) if line and not line.startswith("#")]
    if not lines or not BEGIN.match(lines[0]) or not (len(lines) == 5 or COMMENT in document.text):
        return None
    if len(lines) != 5:
        raise document.refusal(f"it has {len(lines)} lines of numbers: a calib_results.txt of OCamCalib has 5")
    polynomial, _, center, affine, sides = (line.split() for line in lines)
    count, *coefficients = document.numbers(polynomial, "its polynomial")
    if count != len(coefficients):
        raise document.refusal(f"its polynomial has {len(coefficients)} coefficients, but states {count:g}")
    row, column = document.numbers(center, "its center", 2)
    height, width = document.numbers(sides, "its image size", 2)
    terms = zip("cde", document.numbers(affine, "its affine parameters", 3), strict=True)
    return [Lens("", "OCAM", document.size(width, height) | {
        "cx": column, "cy": row, "ocam_polynomial": " ".join(map(repr, coefficients)),
        **{f"ocam_{name}": number for name, number in terms},
    })]  # fmt: skip
