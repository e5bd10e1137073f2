"""Reads calibration files as OpenCV's cv::FileStorage writes them, YAML and JSON, without a library for YAML.

Of YAML only what FileStorage writes for numbers and matrices: "name: value" at the margin; indented below a name
"rows", "cols", "dt" and "data: [ ... ]", which may run over lines; comments. Anything else is passed over. JSON is JSON
but for comments and the words .Nan and .Inf.
Reference: OpenCV documentation, File Input and Output using XML / YAML / JSON files.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path

from ...records import InputError

COMMENT = re.compile(r"(^|[ \t])#[^\"\n]*$", re.MULTILINE)
ENTRY = re.compile(r"^([A-Za-z_][\w-]*)[ \t]*:(.*(?:\n(?:[ \t-].*|$))*)", re.MULTILINE)
DATA = re.compile(r"^\s*data:\s*\[(.*?)\]", re.MULTILINE | re.DOTALL)
JSON_TOKEN = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|-?\.(?:Nan|Inf)')


def read_entries(path: str) -> dict[str, object]:
    """Return the entries of a file by name: texts and numbers as they stand, matrices as flat lists.

    Raises InputError where the file cannot be read or is neither YAML nor JSON.
    """
    try:
        text = Path(path).read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "it is not a text file"
        raise InputError(f"calibration file {path!r} cannot be read: {reason}") from error
    if text.lstrip().startswith("{"):
        return _json_entries(text, path)
    entries = {name: _yaml_value(body) for name, body in ENTRY.findall(COMMENT.sub("", text))}
    if not entries:
        raise InputError(f"calibration file {path!r} is neither YAML nor JSON as OpenCV writes it")
    return entries


def _yaml_value(body: str):
    data = DATA.search(body)
    if data:
        return _items(data[1])
    value = body.strip()
    return _items(value[1:-1]) if value[:1] == "[" and value[-1:] == "]" else value.strip("\"'")


def _items(text: str) -> list[str]:
    return [item.strip() for item in text.replace("[", " ").replace("]", " ").split(",") if item.strip()]


def _json_entries(text: str, path: str) -> dict[str, object]:
    words = {"//": "", ".N": "NaN", ".I": "Infinity", "-.": "-Infinity"}
    plain = JSON_TOKEN.sub(lambda token: words.get(token[0][:2], token[0]), text)
    try:
        entries = json.loads(plain)
    except json.JSONDecodeError as error:
        raise InputError(f"calibration file {path!r} is not JSON: {error}") from error
    return {name: _flat(value) for name, value in entries.items()}


def _flat(value):
    """Return a matrix, as OpenCV or as nested lists, as a flat list; anything else as it is."""
    if isinstance(value, Mapping):
        return _flat(value.get("data", ""))
    if isinstance(value, list):
        return [number for row in value for number in (_flat(row) if isinstance(row, list) else [row])]
    return value
