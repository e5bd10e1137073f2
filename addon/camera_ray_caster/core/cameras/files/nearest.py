"""The refusal of a file that no reader knows: what is read, and the format that is nearest to the file."""

from __future__ import annotations

import re

from ...records import InputError
from ..parts.programs import FILE_WRITERS, PROGRAMS
from .document import Document

WORDS = re.compile(r"[A-Za-z_][\w.]*")
READ_UP_TO = 1 << 16
"""Number of characters in which words are looked for: files name their entries at the begin."""


def unknown(document: Document) -> InputError:
    """Return the refusal of a file that no reader knows."""
    there = {word.lower() for word in WORDS.findall(document.text[:READ_UP_TO])}
    marks = {one.name: one.marks.lower().split() for one in PROGRAMS if one.marks}
    found = {name: [word for word in words if word in there] for name, words in marks.items()}
    nearest = max(found, key=lambda name: (len(found[name]) / len(marks[name]), len(found[name])))
    near = ""
    if found[nearest]:
        lost = [word for word in marks[nearest] if word not in there]
        near = f"; the nearest is {nearest}, " + (f"but it has no {', '.join(lost[:2])}" if lost else "by its words")
    return document.refusal(f"it is of no format that is read: these are {FILE_WRITERS}{near}")
