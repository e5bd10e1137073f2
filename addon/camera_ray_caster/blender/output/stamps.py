"""What a finished frame says of itself, so that a later run knows it: what it was made of, and its files' sizes.

The stamp stands in the frame's report, and appears together with the files beside it.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import bpy

from ...core.records import InputError
from ...core.version import VERSION


def stamp_of(settings: Mapping[str, Any]) -> dict[str, Any]:
    """Return the stamp of the open file, cast with some settings: values that JSON has.

    It holds the file's SHA-256, and of other files that it uses (libraries, images, caches) size and time of change.
    """
    path = Path(bpy.data.filepath)
    others = sorted(set(map(Path, bpy.utils.blend_paths(absolute=True, packed=False))))
    states = [(other.name, other.stat()) for other in others if other.is_file()]
    seen = json.dumps([(name, state.st_size, state.st_mtime_ns) for name, state in states])
    return {
        "version": VERSION,
        "blender": bpy.app.version_string,
        "file": path.name,
        "sha256": file_hash(path) if path.is_file() else None,
        "uses": hashlib.sha256(seen.encode()).hexdigest() if states else None,
        "settings": dict(settings),
    }


def differing(one: Mapping[str, Any], other: Mapping[str, Any]) -> list[str]:
    """Return in what two stamps differ, settings by their names. Raises KeyError or TypeError where one is none."""
    first, second = ({**stamp, **stamp["settings"]} for stamp in (one, other))
    return [key for key in first if key != "settings" and first[key] != second[key]]


def file_hash(path: Path) -> str:
    """Return the SHA-256 of a file. Raises InputError where it cannot be read."""
    try:
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError as error:
        raise InputError(f"cannot read {str(path)!r}: {error.strerror}") from error


def made(stamp: Mapping[str, Any], paths: Iterable[Path]) -> dict[str, Any]:
    """Return what a report says of the files that were made under a stamp."""
    return {"of": stamp, "files": {path.name: path.stat().st_size for path in paths}}


def finished(report: Path, stamp: Mapping[str, Any]) -> dict[str, Any] | None:
    """Return what a report says, if it is of a frame with this stamp and all of its files; None otherwise."""
    try:
        found = json.loads(report.read_text(encoding="utf-8"))
        made = found["made"]
        whole = all((report.parent / name).stat().st_size == size for name, size in made["files"].items())
        return found if whole and made["of"].items() >= stamp.items() else None
    except (OSError, ValueError, KeyError, TypeError, AttributeError):  # none, or not ours
        return None
