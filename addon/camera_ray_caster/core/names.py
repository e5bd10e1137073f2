"""Names of files that are made of names in Blender: of each camera and frame its own, and none that leads elsewhere."""

from __future__ import annotations

import re
from collections.abc import Iterable

from .records import InputError

UNSAFE = re.compile(r'[\x00-\x1f\x7f/\\:*?"<>|]|^\.')
"""What a file's name may not have on some system; a dot in front would hide it."""


def file_name(name: str) -> str:
    """Return a name with ``_`` for what no file's name may have."""
    return UNSAFE.sub("_", name).rstrip(". ") or "_"


def file_names(names: Iterable[str]) -> dict[str, str]:
    """Return ``file_name`` of each name.

    Raises InputError where two names would have the same file, also where only small and capital letters differ.
    """
    found = {name: file_name(name) for name in names}
    owners: dict[str, str] = {}
    for name, file in found.items():
        other = owners.setdefault(file.casefold(), name)
        if other != name:
            raise InputError(f"files of {other!r} and {name!r} would have the same name, {file!r}: rename one of them")
    return found


def frame_digits(frame: float) -> str:
    """Return a frame as file names have it: four digits or more, and up to six decimals of one between frames."""
    whole, point, rest = f"{frame:.6f}".rstrip("0").partition(".")
    return whole.zfill(4) + (point + rest if rest else "")
