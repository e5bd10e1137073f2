"""The steps of a pixel for a class: a few lines at a time, the model's formula first, numbers with four digits."""

from __future__ import annotations

import re

from .formula import NOISE
from .lesson import Lesson

NUMBER = re.compile(r"\d+\.\d+(e[-+]?\d+)?")


def rounded(line: str) -> str:
    """Return a line with its decimal fractions rounded to four digits; those below ``NOISE`` are 0."""

    def short(match: re.Match) -> str:
        number = float(match[0])
        if number >= 1000 and not match[1]:
            return f"{number:.0f}"
        return "0" if number < NOISE else f"{number:.4g}"

    return NUMBER.sub(short, line)


def screens(lesson: Lesson) -> list[tuple[str, tuple[str, ...]]]:
    """Return pairs (title, lines): the model's formula in symbols, then the steps, in which it has its numbers."""
    steps = ((title, tuple(map(rounded, texts))) for title, texts in lesson.steps)
    return [(lesson.label, lesson.formula), *steps]
