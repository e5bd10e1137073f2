"""Lines of numbers: a time and a pose each."""

from __future__ import annotations

import re

from ...arguments import shown
from .document import Document
from .lens import numbers_of


def rows_of(document: Document, count: int, commas: bool | None = None) -> list[list[str]] | None:
    """Return the words of the lines of a trajectory whose first line begins with a number without a sign and has
    ``count`` numbers, or ``count`` and more apart by commas; None of any other file. ``commas``: whether lines have
    commas, None for either.
    """
    lines = document.lines()
    if not lines or not lines[0][0].isdigit() or commas not in (None, "," in lines[0]):
        return None
    words = re.split(r"[\s,]+", lines[0])
    if len(numbers_of(words[:count])) != count or (len(words) != count and not commas):
        return None
    if len(lines) == 5 and len(lines[2].split()) == 2:  # a calibration of OCamCalib
        return None
    return [re.split(r"[\s,]+", line) for line in lines]


def check_commas(document: Document) -> None:
    """Raise InputError unless all lines have commas, or none."""
    lines = document.lines()
    odd = next((number for number, line in enumerate(lines, 1) if ("," in line) != ("," in lines[0])), None)
    if odd is not None:
        raise document.refusal(f"pose {odd} is {shown(lines[odd - 1])}: all lines must have commas, or none")
