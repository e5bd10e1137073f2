"""The refusal of a file that no program recognizes: what is read, and the program that is nearest to the file."""

from __future__ import annotations

import re
from pathlib import Path

from ...records import InputError
from .. import PROGRAMS, READ
from ..parts.document import Document
from ..parts.lens import numbers_of

WORDS = re.compile(r"[A-Za-z_][\w.]*")
READ_UP_TO = 1 << 16
"""Number of characters in which words are looked for: files name their entries at the begin."""


def unknown(document: Document) -> InputError:
    """Return the refusal of a file that no program recognizes."""
    if not document.has_entries:
        ending = Path(document.path).suffix.lower()
        hints = [program.hint(document) for program in PROGRAMS if ending in program.endings]
        if document.data.strip() and any(hints):
            return document.refusal("; or ".join(filter(None, hints)))
        if document.is_binary:
            return document.refusal("it is not a text file, and of no binary format that is read")
        words = next(iter(document.lines()), "").split()
        if words and len(words) == len(numbers_of(words)):
            return document.refusal(f"its lines have {len(words)} numbers: those of TUM's trajectories have 8, of "
                                    "ARKitScenes 7, of KITTI 12, of EuRoC at least 8 apart by commas")  # fmt: skip
        try:
            return document.refusal(f"it has {len(document.entries)} entries")
        except InputError as refusal:
            return refusal
    there = {word.lower() for word in WORDS.findall(document.text[:READ_UP_TO])}
    marks = {one.name: one.marks.lower().split() for one in PROGRAMS if one.marks}
    found = {name: [word for word in words if word in there] for name, words in marks.items()}
    nearest = max(found, key=lambda name: (len(found[name]) / len(marks[name]), len(found[name])))
    near = ""
    if found[nearest]:
        lost = [word for word in marks[nearest] if word not in there]
        near = f"; the nearest is {nearest}, " + (f"but it has no {', '.join(lost[:2])}" if lost else "by its words")
    return document.refusal(f"it is of no format that is read: these are {READ}{near}")
