"""A file of cameras: its bytes, its text, and its entries, which have types."""

from __future__ import annotations

from copy import copy
from functools import cached_property
from hashlib import sha256

from ...records import InputError
from ...text_forms.content import content_of, deadline, decoded, element_of, entries_of
from ...text_forms.xml_subset import Element
from .fields import Fields
from .source import FileSource


class Document(FileSource):
    """A file, or a part of it. Raises InputError if it cannot be read.

    ``picture_size``: width and height of the camera's picture, for files whose lens depends on it and that do not tell
    it; or None. ``model``: key of the chosen model, for files that do not name theirs, or "".
    """

    def __init__(self, path: str, picture_size: tuple[int, int] | None = None, model: str = ""):
        self.path, self.picture_size, self.model = path, picture_size, model
        self.data, self.check = content_of(path), deadline(path)

    @property
    def digest(self) -> bytes:
        """Return a hash of the content."""
        return sha256(self.data).digest()

    @property
    def is_binary(self) -> bool:
        """Whether it begins as a file that is no text."""
        return b"\0" in self.data[:64]

    @property
    def text(self) -> str:
        """Return the text of the file. Raises InputError if it is binary."""
        return self._whole(self._text)

    @property
    def entries(self) -> Fields:
        """Return the entries of a JSON, YAML or XML file. Raises InputError for any other file."""
        return self._whole(self._entries)

    @property
    def raw(self) -> dict:
        """Return the entries without types. Raises InputError for a file without entries."""
        return self.entries.values

    @property
    def is_text(self) -> bool:
        """Whether it is text in UTF-8."""
        return not isinstance(self._text, InputError)

    @property
    def has_entries(self) -> bool:
        """Whether it is a JSON, YAML or XML file."""
        return not isinstance(self._entries, InputError)

    @cached_property
    def _text(self) -> str | InputError:
        return _tried(lambda: decoded(self.data, self.path))

    @cached_property
    def _entries(self) -> Fields | InputError:
        return _tried(lambda: Fields(self, entries_of(self.text, self.path, self.check)))

    @property
    def xml(self) -> Element:
        """Return the outermost element of an XML file. Raises InputError for any other file."""
        return self._whole(self._xml)

    @cached_property
    def _xml(self) -> Element | InputError:
        return _tried(lambda: element_of(self.text, self.path, self.check))

    @staticmethod
    def _whole(value):
        if isinstance(value, InputError):
            raise value.with_traceback(None)
        return value

    def part(self, entries: dict) -> Document:
        """Return a document of these entries alone, with the path of this one."""
        document = copy(self)
        document.__dict__.pop("_xml", None)
        document._text, document.data = "", b""
        document._entries = Fields(document, entries)
        return document

    def lines(self) -> list[str]:
        """Return the lines of a text that are neither empty nor comments (#), without the spaces around them."""
        lines = map(str.strip, self.text.splitlines())
        return [line for line in lines if line and not line.startswith("#")]

    def number(self, owner: dict, name: str, default: float | None = None) -> float:
        """Return a number of a mapping. Raises InputError if it is missing and has no default, or is not a number."""
        if name not in owner and default is None:
            raise self.refusal(f"it has no {name}")
        return self.numbers(owner.get(name, default), name, 1)[0]


def _tried(make):
    """Return what a function returns, or the InputError that it raises: a file is tried by many programs."""
    try:
        return make()
    except InputError as refusal:
        return refusal
