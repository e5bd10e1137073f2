"""Stamps, by which a later run recognizes a finished frame: its inputs and settings, and the sizes of its files.

The stamp is stored in the frame's report, which appears together with the other files.
"""

import hashlib
import json
import os
from collections.abc import Iterable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

import bpy

from ...core.records import InputError
from ...core.version import VERSION
from ..read.camera_fields import named_files


def stamp_of(settings: Mapping[str, Any]) -> dict[str, Any]:
    """Return the stamp of the open file, cast with some settings, as values that JSON can hold.

    It holds the file's SHA-256, and a SHA-256 of the names, sizes and times of change of the other files that it uses
    (libraries, images, caches), and of the content of its cameras' calibration files.
    """
    path = Path(bpy.data.filepath)
    others = sorted(filter(os.path.isfile, set(bpy.utils.blend_paths(absolute=True, packed=False))))
    states = [(os.path.basename(other), os.stat(other)) for other in others]
    used: list[tuple] = [(name, state.st_size, state.st_mtime_ns) for name, state in states]
    for named in filter(os.path.isfile, named_files()):
        with suppress(InputError):  # it cannot be read: its camera is refused where it is cast
            used.append((os.path.basename(named), file_hash(Path(named))))
    return {
        "version": VERSION,
        "blender": bpy.app.version_string,
        "file": path.name,
        "sha256": file_hash(path) if path.is_file() else None,
        "uses": hashlib.sha256(json.dumps(used).encode()).hexdigest() if used else None,
        "settings": json.loads(json.dumps(dict(settings))),  # as they are read back: lists instead of tuples
    }


def differing(stamp_a: Mapping[str, Any], stamp_b: Mapping[str, Any]) -> list[str]:
    """Return the keys in which two stamps or their settings differ. Raises KeyError or TypeError for invalid stamps."""
    first, second = ({**stamp, **stamp["settings"]} for stamp in (stamp_a, stamp_b))
    return [key for key in first if key != "settings" and first[key] != second[key]]


def file_hash(path: Path) -> str:
    """Return the SHA-256 of a file. Raises InputError if it cannot be read."""
    try:
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError as error:
        raise InputError(f"cannot read {str(path)!r}: {error.strerror}") from error


def made(
    stamp: Mapping[str, Any], paths: Iterable[Path], folder: Path = Path(), beside: Iterable[Path] = ()
) -> dict[str, Any]:
    """Return the report's entry on files: the stamp, and the sizes of the files, and of others, which are named as seen
    from the folder of the report.
    """
    files = {path.name: path.stat().st_size for path in paths}
    return {"of": stamp, "files": files | {os.path.relpath(path, folder): path.stat().st_size for path in beside}}


OWN_ENTRIES = "camera", "frame", "rays"
"""The entries in which the stamps of a data set's pictures differ."""


def short(stamp: Mapping[str, Any]) -> dict[str, Any]:
    """Return the stamp of a picture of a data set: what is the same for all pictures as a hash."""
    same = {key: value for key, value in stamp.items() if key not in OWN_ENTRIES}
    text = json.dumps(same, sort_keys=True)
    return {
        "set": hashlib.sha256(text.encode()).hexdigest()[:16],
        **{key: stamp[key] for key in OWN_ENTRIES if key in stamp},
    }


def finished(report: Path, stamp: Mapping[str, Any]) -> dict[str, Any] | None:
    """Return a report's content if it has this stamp and all its files are complete; otherwise return None."""
    try:
        content = json.loads(report.read_text(encoding="utf-8"))
        made = content["made"]
        whole = all((report.parent / name).stat().st_size == size for name, size in made["files"].items())
        is_ours = any(made["of"].items() >= expected.items() for expected in (stamp, short(stamp)))
        return content if whole and is_ours else None
    except (OSError, ValueError, KeyError, TypeError, AttributeError):  # no report, or not ours
        return None
