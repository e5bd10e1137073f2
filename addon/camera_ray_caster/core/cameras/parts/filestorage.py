"""Reads calibration files: YAML and JSON as OpenCV's cv::FileStorage and its relatives write them.

JSON is read by the standard library. Beyond the JSON standard, OpenCV writes the words .Nan and .Inf, and comments.
Reference: OpenCV documentation, File Input and Output using XML / YAML / JSON files.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

from ...records import InputError
from .yaml_subset import YamlError, parse

LARGEST = 1 << 20
"""Maximum size of a file in bytes: a calibration has a few thousand, with the points of all images some 100,000."""

JSON_TOKEN = re.compile(r'"(?:\\.|[^"\\])*"?|//[^\n]*|-?\.(?:Nan|Inf)')
JSON_WORDS = {"//": "", ".N": "NaN", ".I": "Infinity", "-.": "-Infinity"}


def entries_of(text: str, path: str) -> dict:
    """Return the entries of a text by name: values of JSON, or scalars of YAML as text.

    Raises InputError, one line that names ``path``, if the text is neither YAML nor JSON, or has no entries.
    """
    entries: dict
    if text.lstrip().startswith("{"):
        plain = JSON_TOKEN.sub(lambda token: JSON_WORDS.get(token[0][:2], token[0]), text)
        try:
            entries = json.loads(plain, parse_int=float, object_pairs_hook=_once)  # any number of digits
        except (ValueError, RecursionError) as error:
            reason = error if isinstance(error, ValueError) else "it is nested too deeply"
            raise InputError(f"calibration file {path!r} is not JSON: {reason}") from error
    else:
        try:
            entries = parse(text)
        except YamlError as error:
            reason = f"neither YAML nor JSON as OpenCV writes it: {error}"
            raise InputError(f"calibration file {path!r} is {reason}") from error
    if not entries:
        raise InputError(f"calibration file {path!r} is empty")
    return entries


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Return an object of JSON; ValueError where it has a name twice."""
    found: dict[str, Any] = {}
    for name, value in pairs:
        if name in found:
            raise ValueError(f"it has {name!r} twice")
        found[name] = value
    return found


def text_of(path: str) -> str:
    """Return the text of a file. Raises InputError if it cannot be read, or is larger than LARGEST."""
    file = Path(path)
    refusal = f"calibration file {path!r} cannot be read"
    try:
        if file.exists() and not file.is_file():
            raise InputError(f"{refusal}: it is a {'directory' if file.is_dir() else 'device'}, not a file")
        if path.encode(errors="replace") != path.encode(errors="surrogatepass"):
            raise InputError(f"{refusal}: its path is not UTF-8, as reports are: rename it")
        if file.stat().st_size > LARGEST:
            raise InputError(f"{refusal}: it is larger than {LARGEST >> 20} MB, too large for a calibration")
        return file.read_text(encoding="utf-8-sig")
    except (OSError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        reason = error.strerror if isinstance(error, OSError) else "it is not a text file"
        raise InputError(f"{refusal}: {reason}") from error


def flat(value, name: str, path: str):
    """Return a matrix, given as OpenCV's mapping or as nested lists, as a flat list; anything else unchanged.

    Raises InputError for a matrix of OpenCV if its number of values is not rows times cols.
    """
    if isinstance(value, dict) and "data" in value:
        sides, value = [str(value.get(side)) for side in ("rows", "cols")], value["data"]
        if isinstance(value, list) and all(side.isdecimal() for side in sides):
            rows, columns = map(int, sides)
            if not any(isinstance(entry, list) for entry in value) and len(value) != rows * columns:
                raise InputError(f"{name} in {path!r} has {len(value)} numbers for {rows} rows x {columns} columns")
    if not isinstance(value, list):
        return value
    flat, waiting = [], [iter(value)]
    while waiting:
        for entry in waiting[-1]:
            if isinstance(entry, list):
                waiting.append(iter(entry))
                break
            flat.append(entry)
        else:
            waiting.pop()
    return flat
