"""Reads the YAML that calibration tools write, in one pass over the lines: without a library and in linear time.

The subset: block mappings and block sequences by indentation; flow sequences and mappings, ``[ ... ]`` and ``{ ... }``,
also over several lines; plain and quoted scalars; comments; tags, which are ignored, as are directives and document
marks. Anchors, block scalars, several documents and keys that are not plain words are refused.
Reference: YAML 1.2.2, chapters 6 to 9; OpenCV documentation, File Input and Output using XML / YAML / JSON files.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

DEEPEST = 32
"""Levels of nesting that are read: calibrations have three."""

KEY = re.compile(r"[A-Za-z_][\w.-]*(?=[ \t]*:(?:[ \t]|$))")
TOKEN = re.compile(r"""[\[\]{},]|"(?:\\.|[^"\\])*"?|'[^']*'?|[^\[\]{},"'\s][^\[\]{},"']*""")
TAG = re.compile(r"!\S*[ \t]*")

Value = str | list | dict
"""What is read: scalars stay text, as they stand in the file."""


class YamlError(ValueError):
    """The text is not of this subset. The message names the line."""


@dataclass
class _Level:
    """A mapping or a sequence that is being read, and the column in which its entries begin."""

    column: int
    node: list | dict


def parse(text: str) -> dict[str, Value]:
    """Return the mapping that a text holds. Raises YamlError."""
    root: dict[str, Value] = {}
    levels = [_Level(0, root)]
    waiting: tuple[dict | list, str | int, int] | None = None  # an entry whose value may follow, and its column
    lines = text.splitlines()
    at, ended = 0, False
    while at < len(lines):
        number, line = at + 1, _without_comment(lines[at])
        at += 1
        content = line.strip()
        if not content or content.startswith("%"):
            continue
        if content in ("---", "..."):
            ended = bool(root)
            continue
        if ended:
            raise YamlError(f"line {number} begins a second document")
        column, is_item = len(line) - len(line.lstrip()), content == "-" or content.startswith("- ")
        if waiting is not None:
            owner, name, above = waiting
            if column > above or (is_item and column == above and isinstance(owner, dict)):
                node: list | dict = [] if is_item else {}
                owner[name] = node  # type: ignore[index]
                _open(levels, column, node, number)
            waiting = None
        while len(levels) > 1 and (column < levels[-1].column or (column == levels[-1].column and not is_item
                                                                 and isinstance(levels[-1].node, list))):  # fmt: skip
            levels.pop()
        level = levels[-1]
        if column != level.column or is_item != isinstance(level.node, list):
            raise YamlError(f"line {number} has an indentation that fits no entry above it")
        if isinstance(level.node, list):
            level.node.append("")
            entry: tuple[dict | list, str | int, int] = level.node, len(level.node) - 1, column
            rest = content[1:].lstrip()
            inner = column + len(content) - len(rest)
            while rest == "-" or rest.startswith("- "):  # a sequence that begins behind the dash
                entry[0][entry[1]] = node = [""]  # type: ignore[index]
                _open(levels, inner, node, number)
                entry, behind = (node, 0, inner), rest[1:].lstrip()
                inner, rest = inner + len(rest) - len(behind), behind
            if KEY.match(rest):  # a mapping that begins behind the dash
                entry[0][entry[1]] = node = {}  # type: ignore[index]
                _open(levels, inner, node, number)
                entry, rest = _entry(node, rest, inner, number)
        else:
            entry, rest = _entry(level.node, content, column, number)
        rest = TAG.sub("", rest, count=1) if rest.startswith("!") else rest
        if rest[:1] in ("[", "{"):
            value, at = _flow(lines, at, rest, number)
            entry[0][entry[1]] = value  # type: ignore[index]
        elif rest[:1] in ("|", ">", "&", "*"):
            raise YamlError(f"line {number} has a value that is not read: {rest[:20]!r}")
        elif rest:
            entry[0][entry[1]] = _scalar(rest)  # type: ignore[index]
        else:
            waiting = entry
    return root


def _open(levels: list[_Level], column: int, node: list | dict, number: int) -> None:
    """Begin a mapping or a sequence in a line."""
    levels.append(_Level(column, node))
    if len(levels) > DEEPEST:
        raise YamlError(f"line {number} is nested deeper than {DEEPEST} levels")


def _entry(node: dict, content: str, column: int, number: int):
    """Return where the value of a line's entry goes, and the text behind its colon."""
    key = KEY.match(content)
    if key is None:
        raise YamlError(f"line {number} is not an entry of the form name: value")
    if key[0] in node:
        raise YamlError(f"line {number} repeats {key[0]!r}")
    node[key[0]] = ""
    return (node, key[0], column), content[key.end() :].lstrip()[1:].strip()


def _without_comment(line: str) -> str:
    """Return a line up to its comment: a # at its begin or behind a space, outside of quotes."""
    quote = ""
    for i, letter in enumerate(line):
        if quote:
            quote = "" if letter == quote else quote
        elif letter in "\"'" and (i == 0 or line[i - 1] in " \t[{,:"):
            quote = letter
        elif letter == "#" and (i == 0 or line[i - 1] in " \t"):
            return line[:i]
    return line


def _flow(lines: list[str], at: int, first: str, number: int) -> tuple[Value, int]:
    """Return the sequence or mapping that begins in a line, and the line behind it."""
    nodes: list[list | dict] = []
    name: str | None = None
    closed: Value | None = None
    text, before = first, "["
    while True:
        for token in TOKEN.findall(text):
            if closed is not None:
                raise YamlError(f"line {at} has text after a closing bracket: {token.strip()[:20]!r}")
            if token == "," and before in "[{,":
                raise YamlError(f"line {at} has a comma without a value before it")
            before = token
            if token in "[{":
                node: list | dict = [] if token == "[" else {}
                if nodes:
                    _put(nodes[-1], name, node, number)
                    name = None
                nodes.append(node)
                if len(nodes) > DEEPEST:
                    raise YamlError(f"line {number} is nested deeper than {DEEPEST} levels")
            elif token in "]}":
                if not nodes or isinstance(nodes[-1], list) != (token == "]"):
                    raise YamlError(
                        f"line {number} has a closing bracket without a matching opening bracket: {token!r}"
                    )
                ended = nodes.pop()
                closed = None if nodes else ended
            elif token != ",":
                words = token.strip()
                if isinstance(nodes[-1], dict):
                    key, colon, value = words.partition(":")
                    name = key.strip().strip("\"'") if colon else name
                    words = value.strip() if colon else words
                if words:
                    _put(nodes[-1], name, _scalar(words), number)
                    name = None
        if closed is not None:
            return closed, at
        if at >= len(lines):
            raise YamlError(f"line {number} opens a bracket that is not closed")
        text, at = _without_comment(lines[at]), at + 1


def _put(node: list | dict, name: str | None, value: Value, number: int) -> None:
    """Add a value to a flow sequence, or under a name to a flow mapping."""
    if isinstance(node, list):
        node.append(value)
    elif name is None:
        raise YamlError(f"line {number} has a value without a name")
    elif name in node:
        raise YamlError(f"line {number} has {name!r} twice")
    else:
        node[name] = value


def _scalar(text: str) -> str:
    """Return a scalar as it stands, without its quotes."""
    quoted = len(text) > 1 and text[0] == text[-1] and text[0] in "\"'"
    return text[1:-1] if quoted else text
