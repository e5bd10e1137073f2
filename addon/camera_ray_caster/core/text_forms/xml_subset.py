"""Reads the XML of OpenCV's opencv_storage as entries, without definitions of a document type and to a limited depth.

In OpenCV's files an element is an entry. One with elements in it is a mapping, or a list if they are all named "_"; the
words of one without are a scalar, or a list of scalars.
Reference: OpenCV documentation, File Input and Output using XML / YAML / JSON files; XML 1.0.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from xml.parsers import expat

from .yaml_subset import DEEPEST

WORD = re.compile(r'"[^"]*"?|[^\s"]+')
ITEM, ROOT = "_", "opencv_storage"

Value = str | list | dict
"""An entry: scalars stay text, as they stand in the file."""


class XmlError(ValueError):
    """The text is not of this subset. The message names the line."""


@dataclass
class Element:
    """An element of XML; ``text`` is all text directly in it."""

    name: str
    line: int
    children: list[Element] = field(default_factory=list)
    text: str = ""
    attributes: dict[str, str] = field(default_factory=dict)

    def child(self, name: str) -> Element | None:
        """Return the first element of a name directly in it."""
        return next((element for element in self.children if element.name == name), None)

    def all(self, name: str) -> list[Element]:
        """Return the elements of a name, in any depth."""
        matching = [self] if self.name == name else []
        return matching + [element for child in self.children for element in child.all(name)]

    def texts(self) -> dict[str, str]:
        """Return the texts of the elements directly in it, by name."""
        return {element.name: element.text for element in self.children}


def tree(text: str, check: Callable[[], None] = lambda: None) -> Element:
    """Return the outermost element of a text; ``check`` is called now and then, and may raise. Raises XmlError."""
    parser = expat.ParserCreate("utf-8")
    parser.buffer_text = True
    open_elements: list[Element] = []
    texts: list[list[str]] = []
    done: list[Element] = []

    def begin(name, attributes):
        check()
        if len(open_elements) >= DEEPEST:
            raise XmlError(f"line {parser.CurrentLineNumber} is nested deeper than {DEEPEST} levels")
        element = Element(name, parser.CurrentLineNumber, attributes=attributes)
        if open_elements:
            open_elements[-1].children.append(element)
        open_elements.append(element)
        texts.append([])

    def end(name):
        element = open_elements.pop()
        element.text = "".join(texts.pop()).strip()
        done[:] = [element]

    def refuse(_name, _system, _public, has_definitions):
        if has_definitions:  # entities may grow without end; a document type elsewhere is not looked up
            raise XmlError(f"line {parser.CurrentLineNumber} has a document type, which is not read")

    parser.StartElementHandler, parser.EndElementHandler = begin, end
    parser.CharacterDataHandler = lambda data: texts[-1].append(data)
    parser.StartDoctypeDeclHandler = refuse
    try:
        parser.Parse(text.encode(), True)
    except expat.ExpatError as error:
        raise XmlError(str(error)) from error
    return done[0]


def storage(text: str, check: Callable[[], None] = lambda: None) -> dict[str, Value]:
    """Return the entries of an opencv_storage; of other XML none that a format has. Raises XmlError."""
    root = tree(text, check)
    if root.name != ROOT:
        return {root.name: ""}
    value = _value(root, check)
    return value if isinstance(value, dict) else {}


def _value(element: Element, check: Callable[[], None]) -> Value:
    check()
    if not element.children:
        words = [word.strip('"') for word in WORD.findall(element.text)]
        return words[0] if len(words) == 1 else words or ""
    if all(child.name == ITEM for child in element.children):
        return [_value(child, check) for child in element.children]
    entries: dict[str, Value] = {}
    for child in element.children:
        if child.name in entries:
            raise XmlError(f"line {child.line} repeats {child.name!r}")
        entries[child.name] = _value(child, check)
    return entries
