"""The refusal of a file that no program recognizes: what is read, and the program that is nearest to the file."""

import re
from pathlib import Path

from ...records import InputError
from ...text_forms.yaml_subset import NO_ENTRY
from .. import PROGRAMS, READ
from ..parts.document import Document
from ..parts.lens import numbers_of

WORDS = re.compile(r"[A-Za-z_][\w.]*")
YAML = ".yaml", ".yml"
ENTRIES = *YAML, ".json", ".xml"
"""Ends of the names of files that have entries."""
FEWEST = 6
"""Numbers of a line from which on it may be a pose."""
READ_UP_TO = 1 << 16
"""Number of characters in which words are looked for: files name their entries at the begin."""


def unknown(document: Document) -> InputError:
    """Return the refusal of a file that no program recognizes, with the nearest program if half of its words are there.
    What is wrong with YAML, JSON or XML is told if the file is called so, or looks like it.
    """
    if not document.is_text:
        return document.refusal(_by_name(document) or "it is not a text file, and of no binary format that is read")
    there = {word.lower() for word in WORDS.findall(document.text[:READ_UP_TO])}
    marks = {program.name: program.marks.lower().split() for program in PROGRAMS if program.marks}
    lost = {name: [word for word in words if word not in there] for name, words in marks.items()}
    nearest = min(lost, key=lambda name: (len(lost[name]) / len(marks[name]), -len(marks[name])))
    near = ""
    if 2 * len(lost[nearest]) <= len(marks[nearest]):
        missing = f"it has no {', '.join(lost[nearest][:2])}" if lost[nearest] else "its entries cannot be read"
        near = f"; the nearest is {nearest}, but {missing}"
    if not document.has_entries:
        reason = document.data.strip() and (_by_name(document) or _by_numbers(document))
        if reason:
            return document.refusal(reason)
        refusal, endings = _of_text(document), {*map(str.lower, Path(document.path).suffixes)}
        looks = YAML if NO_ENTRY in str(refusal) else ENTRIES
        if not document.data.strip() or endings.intersection(looks) or (near and looks is ENTRIES):
            return refusal
    return document.refusal(f"it is of no format that is read: these are {READ}{near}")


def _by_name(document: Document) -> str:
    """Return what is wrong with a file that has the name of a program's; "" of any other file."""
    ending = Path(document.path).suffix.lower()
    hints = [program.hint(document) for program in PROGRAMS if ending in program.endings]
    return "; or ".join(filter(None, hints))


def _by_numbers(document: Document) -> str:
    """Return what is wrong with lines of numbers; "" of any other file."""
    words = next(iter(document.lines()), "").split()
    if len(words) < FEWEST or len(words) != len(numbers_of(words)):
        return ""
    known = ", ".join(f"of {program.name} {program.columns}" for program in PROGRAMS if program.columns)
    return (f"its lines have {len(words)} numbers: those of trajectories have, {known}; or name the columns in the "
            "first line, such as # timestamp x y z qx qy qz qw")  # fmt: skip


def _of_text(document: Document) -> InputError:
    """Return why a document has no entries."""
    try:
        return document.refusal(f"it has {len(document.entries)} entries")
    except InputError as refusal:
        return refusal
