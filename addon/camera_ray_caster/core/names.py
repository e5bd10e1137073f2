"""File names made from names in Blender: unique for each camera and frame, and without a path to another folder."""

from __future__ import annotations

import re
from collections.abc import Iterable
from unicodedata import normalize

from .records import InputError

UNSAFE = re.compile(r'[\x00-\x1f\x7f/\\:*?"<>|]|^\.')
"""Characters that a file name may not contain on some system, and a leading dot, which would hide the file."""
DEVICE = re.compile(r"(con|prn|aux|nul|(com|lpt)[0-9¹²³])\s*(\.|$)", re.IGNORECASE)
"""Names that are devices on Windows, with any ending."""


def file_name(name: str) -> str:
    """Return a name with ``_`` in place of characters that a file name may not contain, and before that of a device."""
    safe = UNSAFE.sub("_", name).rstrip(". ") or "_"
    return f"_{safe}" if DEVICE.match(safe) else safe


def folded(file: str) -> str:
    """Return what is equal for names of one file on some system: Windows takes upper and lower case for one, and macOS
    composed and decomposed letters, too.
    """
    return normalize("NFC", normalize("NFD", file).casefold())


def file_names(names: Iterable[str]) -> dict[str, str]:
    """Return ``file_name`` of each name.

    Raises InputError if two names would have the same file on some system; see ``folded``.
    """
    files = {name: file_name(name) for name in names}
    owners: dict[str, str] = {}
    for name, file in files.items():
        other = owners.setdefault(folded(file), name)
        if other != name:
            raise InputError(f"files of {other!r} and {name!r} would have the same name, {file!r}: rename one of them")
    return files


def frame_digits(frame: float) -> str:
    """Return a frame for a file name, as Blender writes it: four digits or more, after a minus if it is negative; and
    up to six decimals if it lies between whole frames.
    """
    whole, point, decimals = f"{abs(frame):.6f}".rstrip("0").partition(".")
    digits = whole.zfill(4) + (point + decimals if decimals else "")
    return f"-{digits}" if round(frame, 6) < 0 else digits
