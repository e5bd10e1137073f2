"""The programs whose files are read and written, one file each. A new program needs its own file and a word here."""

from __future__ import annotations

from . import colmap, euroc, kalibr, maplab, mrcal, okvis, opensfm
from .parts.document import Document
from .parts.program import ProgramFiles, in_words
from .table import ROWS

_MOVED = {one.PROGRAM.name: one.PROGRAM for one in (colmap, euroc, kalibr, maplab, mrcal, okvis, opensfm)}
PROGRAMS: tuple[ProgramFiles, ...] = tuple(_MOVED.get(name, row) for name, row in ROWS.items())
"""All programs, in the order in which messages name them."""

READ = in_words(program.name for program in PROGRAMS if program.reads)
"""The programs whose calibration files are read, in words."""


def program_of(document: Document) -> ProgramFiles | None:
    """Return the program that recognizes a document; a general one if no other does; None if none does."""
    by_rank = sorted(PROGRAMS, key=lambda program: program.general)
    return next((program for program in by_rank if program.recognizes(document)), None)
