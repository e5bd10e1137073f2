"""Reads the contents of calibration files: YAML, JSON and XML as OpenCV's cv::FileStorage and its relatives write them.

JSON and TOML are read by the standard library. Beyond the JSON standard, OpenCV writes the words .Nan and .Inf, and
comments. A file of several JSON objects, one per line, and a list stand for a mapping of their entries by number. Files
that are compressed by gzip are read, too. Reading is limited by memory and processor time, so that any file ends in a
lens or in one line.
Reference: OpenCV documentation, File Input and Output using XML / YAML / JSON files.
"""

import json
import re
import tomllib
import zlib
from collections.abc import Callable
from pathlib import Path
from time import thread_time
from typing import Any

from .. import memory
from ..records import InputError
from .xml_subset import Element, storage, tree
from .yaml_subset import parse

LARGEST = 1 << 28
"""Maximum size in bytes, decompressed: JSON of this size, some 250,000 frames with poses, takes 5 s to read."""

PER_BYTE = 25
"""Bytes of memory that a byte of a file takes when it is read: lists of short numbers take the most."""

LONGEST_READING = 2.0
"""Processor time in seconds that reading YAML, XML or a file's lenses may take: some 4 MB of YAML."""

JSON_TOKEN = re.compile(r'"(?:\\.|[^"\\])*"?|//[^\n]*|-?\.(?:Nan|Inf)')
JSON_WORDS = {"//": "", ".N": "NaN", ".I": "Infinity", "-.": "-Infinity"}
BEYOND_JSON = "//", ".Nan", ".Inf"
LIST_OF_NUMBERS = re.compile(r"\s*\[[\s\[]*[-+.\d]")
"""How a list of numbers begins, or one of lists of numbers."""
TOML_TABLE = re.compile(r"(?:\s*#[^\n]*\n)*\s*\[[A-Za-z_][\w.\-]*\][^\S\n]*(?:#[^\n]*)?\n")
"""How TOML begins, with the name of its first table."""
MOST_LISTED = 1 << 18
"""Largest number of entries of a file that is a list: more take readers longer than LONGEST_READING."""
SURROGATE = re.compile(r"\\u[dD][89a-fA-F]")
"""How JSON begins the halves of characters beyond 16 bits."""

GZIP = b"\x1f\x8b"

Check = Callable[[], None]
"""Raises InputError when the time for a file is over."""


def deadline(path: str) -> Check:
    """Return a function that raises InputError, with the path, once LONGEST_READING has passed in this thread."""
    end = thread_time() + LONGEST_READING

    def check() -> None:
        if thread_time() > end:
            raise InputError(
                f"calibration file {path!r} takes longer than {LONGEST_READING:g} s to read: is it a calibration? "
                "A part of it with fewer cameras or frames may be read"
            )

    return check


def entries_of(text: str, path: str, check: Check | None = None) -> dict:
    """Return the entries of a text by name: values of JSON, or scalars of YAML and XML as text.

    Raises InputError, one line that names ``path``, if the text is none of the three, has no entries, or takes too
    long.
    """
    begin = text.lstrip()[:1]
    if LIST_OF_NUMBERS.match(text):
        raise InputError(f"calibration file {path!r} is a list of numbers without names: choose another file")
    form, parser = (
        ("not TOML", _toml) if TOML_TABLE.match(text)
        else ("not JSON", _json) if begin in ("{", "[")
        else ("not XML as OpenCV writes it", storage) if begin == "<"
        else ("neither YAML nor JSON as OpenCV writes it", parse)
    )  # fmt: skip
    entries = _parsed(text, path, check or deadline(path), form, parser)
    if not entries:
        raise InputError(f"calibration file {path!r} is empty")
    if isinstance(entries, list) and len(entries) > MOST_LISTED:
        raise InputError(f"calibration file {path!r} is a list of {len(entries)} entries, too many for cameras")
    return entries if isinstance(entries, dict) else {str(number): entry for number, entry in enumerate(entries)}


def element_of(text: str, path: str, check: Check) -> Element:
    """Return the outermost element of XML. Raises InputError, one line that names ``path``, for any other text."""
    if text.lstrip()[:1] != "<":
        raise InputError(f"calibration file {path!r} is not XML")
    return _parsed(text, path, check, "not XML", tree)


def _parsed(text: str, path: str, check: Check, form: str, parser: Callable[[str, Check], Any]) -> Any:
    """Return what a parser makes of a text. Raises InputError, "PATH is FORM" and why, for what it refuses."""
    try:
        return parser(text, check)
    except InputError:
        raise
    except (ValueError, RecursionError) as error:
        reason = "it is nested too deeply" if isinstance(error, RecursionError) else error
        raise InputError(f"calibration file {path!r} is {form}: {reason}") from error


def _toml(text: str, check: Check) -> dict:
    def number(digits: str) -> float:
        check()
        return float(digits)

    return tomllib.loads(text, parse_float=number)


def _json(text: str, check: Check) -> dict | list:
    try:
        return _loaded(text)
    except json.JSONDecodeError as error:
        if error.msg == "Extra data" and (lines := [line for line in text.splitlines() if line.strip()])[1:]:
            try:
                return [_loaded(line) for line in lines]
            except json.JSONDecodeError:
                pass
        if not any(word in text for word in BEYOND_JSON):
            raise

        def plain(token: re.Match) -> str:
            check()
            return JSON_WORDS.get(token[0][:2], token[0])

        return _loaded(JSON_TOKEN.sub(plain, text))


def _loaded(text: str) -> Any:
    value = json.loads(text, parse_int=float, object_pairs_hook=_once)  # integers may have any number of digits
    if SURROGATE.search(text):
        try:
            json.dumps(value, ensure_ascii=False).encode()
        except UnicodeEncodeError as error:
            raise ValueError("a name has half of a character (a lone surrogate)") from error
    return value


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Return an object of JSON; ValueError where it has a name twice."""
    result: dict[str, Any] = {}
    for name, value in pairs:
        if name in result:
            raise ValueError(f"it has {name!r} twice")
        result[name] = value
    return result


def content_of(path: str) -> bytes:
    """Return the content of a file, decompressed. Raises InputError if it cannot be read, or is larger than LARGEST."""
    file = Path(path)
    refusal = f"calibration file {path!r} cannot be read"
    too_large = InputError(f"{refusal}: it is larger than {LARGEST >> 20} MB, too large for a calibration")
    try:
        if file.exists() and not file.is_file():
            raise InputError(f"{refusal}: it is a {'directory' if file.is_dir() else 'device'}, not a file")
        if path.encode(errors="replace") != path.encode(errors="surrogatepass"):
            raise InputError(f"{refusal}: its path is not UTF-8, as reports are: rename it")
        size = file.stat().st_size
        if size > LARGEST:
            raise too_large
        memory.require(PER_BYTE * size, f"the entries of calibration file {path!r}", "give a part of it")
        content = file.read_bytes()
    except (OSError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        reason = error.strerror if isinstance(error, OSError) else "its path is no path"
        raise InputError(f"{refusal}: {reason}") from error
    if not content.startswith(GZIP):
        return content
    try:
        content = _unpacked(content)
    except zlib.error as error:
        raise InputError(f"{refusal}: it begins as a file of gzip, but is damaged or cut off") from error
    if len(content) > LARGEST:
        raise too_large
    memory.require(PER_BYTE * len(content), f"the entries of calibration file {path!r}", "give a part of it")
    return content


def _unpacked(content: bytes) -> bytes:
    """Return the content of all members of a gzip file; if it is more than LARGEST, the first bytes of it. Zeros may
    follow the last member, as on tapes. Raises zlib.error for a file that is damaged or cut off.
    """
    parts, size = [], 0
    while content and size <= LARGEST:
        unpacking = zlib.decompressobj(wbits=31)
        parts.append(unpacking.decompress(content, LARGEST + 1 - size))
        size += len(parts[-1])
        if size <= LARGEST and not unpacking.eof:
            raise zlib.error("the file ends within a member")
        content = unpacking.unused_data.lstrip(b"\0")
    return b"".join(parts)


def decoded(content: bytes, path: str) -> str:
    """Return the content of a file as text. Raises InputError if it is not UTF-8, or has a null character."""
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = "\0"
    if "\0" in text:
        raise InputError(f"calibration file {path!r} cannot be read: it is not a text file")
    return text


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
