"""Reads the files of calibrations: YAML and JSON as OpenCV's cv::FileStorage and its relatives write them.

JSON is read by the standard library; beyond the standard, OpenCV writes the words .Nan and .Inf, and comments.
Reference: OpenCV documentation, File Input and Output using XML / YAML / JSON files.
"""

from __future__ import annotations

import json
import re
from pathlib import Path

from ...records import InputError
from .yaml_subset import YamlError, parse

LARGEST = 1 << 20
"""Bytes of a file that is read: a calibration has a few thousand, with all images' points some hundred thousand."""

JSON_TOKEN = re.compile(r'"(?:\\.|[^"\\])*"?|//[^\n]*|-?\.(?:Nan|Inf)')
JSON_WORDS = {"//": "", ".N": "NaN", ".I": "Infinity", "-.": "-Infinity"}


def entries_of(text: str, path: str) -> dict:
    """Return the entries of a text by name: JSON's values, and YAML's scalars as they stand.

    Raises InputError, in one line, where it is neither YAML nor JSON, or empty; ``path`` is named.
    """
    entries: dict
    if text.lstrip().startswith("{"):
        plain = JSON_TOKEN.sub(lambda token: JSON_WORDS.get(token[0][:2], token[0]), text)
        try:
            entries = json.loads(plain, parse_int=float)  # of any number of digits
        except (json.JSONDecodeError, RecursionError) as error:
            reason = error if isinstance(error, json.JSONDecodeError) else "it is nested too deeply"
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


def text_of(path: str) -> str:
    """Return the text of a file. Raises InputError where it cannot be read, or is larger than LARGEST."""
    file = Path(path)
    refusal = f"calibration file {path!r} cannot be read"
    try:
        if file.exists() and not file.is_file():
            raise InputError(f"{refusal}: it is a {'directory' if file.is_dir() else 'device'}, not a file")
        if file.stat().st_size > LARGEST:
            raise InputError(f"{refusal}: it is larger than {LARGEST >> 20} MB, as no calibration is")
        return file.read_text(encoding="utf-8-sig")
    except (OSError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        reason = error.strerror if isinstance(error, OSError) else "it is not a text file"
        raise InputError(f"{refusal}: {reason}") from error


def flat(value):
    """Return a matrix, as OpenCV or as nested lists, as a flat list; anything else as it is."""
    if isinstance(value, dict) and "data" in value:
        value = value["data"]
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
