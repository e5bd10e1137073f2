"""Lens files of pbrt (.dat): radius, distance, index and clear DIAMETER in each line; # begins a comment.

A radius of 0 is the stop. pbrt's distances are those BEHIND a surface. The older files of Kolb have the distance BEFORE
it, so that the first is 0 and the last is not. The medium of the stop is that in front of it: its index is not read.
Reference: pbrt.org, Realistic Camera; C. Kolb et al., A Realistic Camera Model for Computer Graphics (1995).
"""

from math import inf, isfinite

from ...records import InputError
from ..prescription import Prescription, Row


def recognizes(text: str, path: str) -> bool:
    """Return whether a text is one of pbrt's lens files: lines of four or five numbers."""
    lines = _words(text)
    return bool(lines) and all(len(line) in (4, 5) and all(map(_is_number, line)) for line in lines)


def _words(text: str) -> list[list[str]]:
    """Return the words of each line, without comments and empty lines."""
    return [words for line in text.splitlines() if (words := line.split("#")[0].split())]


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def read(text: str, name: str) -> Prescription:
    """Return the lens. Raises InputError, which names the line's surface, for one without a stop."""
    numbers = [[float(word) for word in words] for words in _words(text)]
    comments = [line.strip("# \t") for line in text.splitlines() if line.lstrip().startswith("#")]
    if numbers[0][1] == 0 and numbers[-1][1] != 0:
        after = [row[1] for row in numbers[1:]]
        numbers = [[row[0], gap, *row[2:]] for row, gap in zip(numbers, [*after, 0.0], strict=True)]
    stops = [index for index, row in enumerate(numbers) if row[0] == 0]
    if len(stops) != 1:
        raise InputError(f"it has {len(stops)} rows of radius 0: one must be the stop")
    rows, medium = [], 1.0
    for radius, gap, index, diameter, *abbe in numbers:
        medium = medium if radius == 0 or index == 0 else index
        curvature = 0.0 if radius == 0 or not isfinite(radius) else 1 / radius
        dispersion = abbe[0] if abbe and abbe[0] > 0 and medium > 1 else inf
        rows.append(Row(curvature, gap, medium, diameter / 2 if diameter > 0 else inf, abbe=dispersion))
    return Prescription(tuple(rows), stops[0], name, "; ".join(comments[:2]))
