"""Reads the YAML that calibration tools write, in one pass over the lines: without a library and in linear time.

The subset: block mappings and block sequences by indentation; flow sequences and mappings, ``[ ... ]`` and ``{ ... }``,
also over several lines, and in the line below their key; plain and quoted scalars, each in one line; comments; tags,
which are ignored, as are directives and document marks. Of several messages that are echoed, the first is read.
Anchors, block scalars, other documents and keys that are neither quoted nor plain words are refused. A sequence in
place of the outermost mapping is read, too.
Reference: YAML 1.2.2, chapters 6 to 9; OpenCV documentation, File Input and Output using XML / YAML / JSON files.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass

DEEPEST = 32
"""Levels of nesting that are read: calibrations have three."""

MESSAGE = "header:"
"""The first line of each message that ROS echoes."""
COLON = re.compile(r":(?=[ \t\[]|$)")
"""What ends a name; before a list also without a space, as OpenCV reads it."""
CLOSE = re.compile(r"""([A-Za-z]\w*\.[\w.]+):([-+.\d]\S*|"[^"]*")""")
"""An entry without a space behind its colon, as in settings of ORB-SLAM, which OpenCV reads."""
KEY = re.compile(r"""[A-Za-z0-9_/.][\w./+ -]*|"[^"]*"|'[^']*'""")
COMMENT = re.compile(r"""(?:^|(?<=[ \t]))#|(?:^|(?<=[ \t[{,:]))(?:"[^"]*"?|'[^']*'?)""")
TOKEN = re.compile(r"""[\[\]{},]|"(?:\\.|[^"\\])*"?|'[^']*'?|[^\[\]{},"'\s][^\[\]{},"']*""")
TAG = re.compile(r"!\S*[ \t]*")

Value = str | list | dict
"""What is read: scalars stay text, as they stand in the file."""


NO_ENTRY = "is not an entry of the form name: value"
"""What is wrong with text of any other kind."""


class YamlError(ValueError):
    """The text is not of this subset. The message names the line."""


@dataclass
class _Level:
    """A mapping or a sequence that is being read, and the column in which its entries begin."""

    column: int
    node: list | dict


def parse(text: str, check: Callable[[], None] = lambda: None) -> dict[str, Value] | list[Value]:
    """Return the mapping or the sequence that a text holds; ``check`` is called now and then, and may raise.

    Raises YamlError.
    """
    root: dict[str, Value] | list[Value] = {}
    levels = [_Level(0, root)]
    waiting: tuple[dict | list, str | int, int] | None = None  # an entry whose value may follow, and its column
    lines = text.splitlines()
    at, ended, first = 0, False, ""
    while at < len(lines):
        check()
        number, line = at + 1, _without_comment(lines[at])
        at += 1
        content = line.strip()
        if not content or content.startswith("%"):
            continue
        if content in ("---", "..."):
            ended = bool(root)
            continue
        if ended and content == first == MESSAGE:
            return root
        first = first or content
        if ended:
            raise YamlError(f"line {number} begins a second document")
        column, is_item = len(line) - len(line.lstrip()), content == "-" or content.startswith("- ")
        if is_item and not root and isinstance(root, dict):
            root = []
            levels = [_Level(column, root)]
        if waiting is not None and column > waiting[2] and not is_item and (content[0] in "[{" or not _key(content)):
            value: Value = _scalar(content)  # in the line below its key
            if content[0] in "[{":
                value, at = _flow(lines, at, content, number, check)
            waiting[0][waiting[1]] = value  # type: ignore[index]
            waiting = None
            continue
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
            remainder = content[1:].lstrip()
            inner = column + len(content) - len(remainder)
            while remainder == "-" or remainder.startswith("- "):  # a sequence that begins behind the dash
                entry[0][entry[1]] = node = [""]  # type: ignore[index]
                _open(levels, inner, node, number)
                entry, behind = (node, 0, inner), remainder[1:].lstrip()
                inner, remainder = inner + len(remainder) - len(behind), behind
            if _key(remainder):  # a mapping that begins behind the dash
                entry[0][entry[1]] = node = {}  # type: ignore[index]
                _open(levels, inner, node, number)
                entry, remainder = _entry(node, remainder, inner, number)
        else:
            entry, remainder = _entry(level.node, content, column, number)
        remainder = TAG.sub("", remainder, count=1) if remainder.startswith("!") else remainder
        if remainder[:1] in ("[", "{"):
            value, at = _flow(lines, at, remainder, number, check)
            entry[0][entry[1]] = value  # type: ignore[index]
        elif remainder[:1] in ("|", ">", "&", "*"):
            raise YamlError(f"line {number} has a value that is not read: {remainder[:20]!r}")
        elif remainder:
            entry[0][entry[1]] = _scalar(remainder)  # type: ignore[index]
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
    entry = _key(content)
    if entry is None:
        raise YamlError(f"line {number} {NO_ENTRY}")
    key, remainder = entry
    if key in node:
        raise YamlError(f"line {number} repeats {key!r}")
    node[key] = ""
    return (node, key, column), remainder


def _key(content: str) -> tuple[str, str] | None:
    """Return the key of an entry and the text behind its colon; None of a text that is no entry."""
    quoted = content[:1] in ("'", '"')
    colon = COLON.search(content, content.find(content[0], 1) + 1 if quoted else 0)
    key = "" if colon is None else content[: colon.start()].rstrip()
    if colon is None and (close := CLOSE.fullmatch(content)):
        return close[1], close[2]
    if colon is None or not KEY.fullmatch(key):
        return None
    return _scalar(key), content[colon.end() :].strip()


def _without_comment(line: str) -> str:
    """Return a line up to its comment: a # at its begin or behind a space, outside of quotes."""
    if "#" not in line:
        return line
    return next((line[: match.start()] for match in COMMENT.finditer(line) if match[0] == "#"), line)


def _flow(lines: list[str], at: int, first: str, number: int, check: Callable[[], None]) -> tuple[Value, int]:
    """Return the sequence or mapping that begins in a line, and the line behind it."""
    nodes: list[list | dict] = []
    name: str | None = None
    closed: Value | None = None
    text, before = first, "["
    while True:
        for match in TOKEN.finditer(text):
            check()
            token = match[0]
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
