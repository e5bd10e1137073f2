"""The entries of a file, which have types: one that is missing, or of another type, is refused in one line.

An entry that is null is missing; where a list, a mapping or a text may be missing, an entry without a value is, too.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from typing import Any

from ...arguments import shown
from ...records import InputError
from ...text_forms.content import flat
from .source import FileSource

EMPTY: tuple[Any, ...] = None, "", []


class Fields:
    """A mapping in a document; ``label`` tells whose it is in messages. All methods raise InputError."""

    def __init__(self, document: FileSource, values: dict[str, Any], label: str = ""):
        self.document, self.values, self.label = document, values, label

    def __iter__(self) -> Iterator[str]:
        return iter(self.values)

    def __len__(self) -> int:
        return len(self.values)

    def has(self, *names: str) -> bool:
        """Whether there are entries of all these names."""
        return all(self.values.get(name) is not None for name in names)

    def first(self, *names: str) -> str:
        """Return the first of some names that is there, or the very first one."""
        return next(filter(self.has, names), names[0])

    def labeled(self, label: str) -> Fields:
        """Return the same entries with another label."""
        return Fields(self.document, self.values, label)

    def said(self, name: str) -> str:
        """Return the name of an entry in messages."""
        return f"{name} of {self.label}" if self.label else name

    def refusal(self, name: str, wanted: str) -> InputError:
        """Return the error for an entry that is not what is wanted."""
        if not self.has(name):
            return self.document.refusal(f"it has no {self.said(name)}")
        return self.document.refusal(f"{self.said(name)} is {shown(self.values[name])}: it must be {wanted}")

    def number(self, name: str, default: float | None = None) -> float:
        """Return a number."""
        return float(default) if default is not None and not self.has(name) else self.numbers(name, 1)[0]

    def numbers(self, name: str, count: int | None = None, default: Sequence[float] | None = None) -> list[float]:
        """Return a list of numbers, ``count`` of them if given; the default also for an empty list."""
        if default is not None and self.values.get(name) in EMPTY:
            return list(default)
        return self.document.numbers(self.values.get(name), self.said(name), count)

    def matrix(self, name: str, count: int | None = None, default: Sequence[float] | None = None) -> list[float]:
        """Return the numbers of a list of rows, of OpenCV's matrix, or of a list, by rows."""
        if default is not None and self.values.get(name) in EMPTY:
            return list(default)
        value = flat(self.values.get(name), self.said(name), self.document.path)
        return self.document.numbers(value, self.said(name), count)

    def count_of(self, name: str) -> int:
        """Return the length of a list; 0 for anything else."""
        value = self.values.get(name)
        return len(value) if isinstance(value, list) else 0

    def whole(self, name: str, least: int = 0) -> int:
        """Return a whole number from ``least``."""
        number = self.number(name)
        if number % 1 or number < least:
            raise self.document.refusal(f"{self.said(name)} is {number:g}: it must be a whole number from {least}")
        return int(number)

    def word(self, name: str, known: Collection[str], default: str | None = None) -> str:
        """Return a word that is one of those known."""
        if default is not None and not self.has(name):
            return default
        return self.document.one_of(self.values.get(name), self.said(name), known)

    def text(self, name: str, default: str = "") -> str:
        """Return a scalar as text."""
        value = default if self.values.get(name) in (None, "") else self.values[name]
        if isinstance(value, list | dict):
            raise self.refusal(name, "one word")
        return str(value)

    def part(self, name: str) -> Fields:
        """Return a mapping; an empty one if it is missing."""
        value = {} if self.values.get(name) in (None, "") else self.values[name]
        if not isinstance(value, dict):
            raise self.refusal(name, "a mapping")
        return Fields(self.document, value, self.label)

    def parts(self, name: str) -> list[Fields]:
        """Return a list of mappings; an empty one if it is missing."""
        value = [] if self.values.get(name) in EMPTY else self.values[name]
        if not isinstance(value, list) or not all(isinstance(item, dict) for item in value):
            raise self.refusal(name, "a list of mappings")
        return [Fields(self.document, item, self.label) for item in value]

    def each(self, name: str) -> list[Fields]:
        """Return a list of anything, each in fields with one entry of this name."""
        value = [] if self.values.get(name) in EMPTY else self.values[name]
        if not isinstance(value, list):
            raise self.refusal(name, "a list")
        return [Fields(self.document, {name: item}, self.label) for item in value]

    def some(self, names: Collection[str]) -> Fields:
        """Return the entries of some names."""
        return Fields(self.document, {name: entry for name, entry in self.values.items() if name in names}, self.label)

    def merged(self, other: Fields) -> Fields:
        """Return these entries and those of another mapping, which count before them."""
        return Fields(self.document, self.values | other.values, self.label)

    def key(self, names: Collection[str]) -> str:
        """Return a text by which the entries of some names are told from others."""
        return repr([self.values.get(name) for name in names])

    def named(self) -> dict[str, Fields]:
        """Return the entries that are mappings, by name, labeled by it."""
        mappings = {name: entry for name, entry in self.values.items() if isinstance(entry, dict)}
        return {name: Fields(self.document, entry, name) for name, entry in mappings.items()}

    def sides(self, width: str, height: str) -> dict[str, Any]:
        """Return the settings of a picture's size by the names of its sides; that of the frame if none is there."""
        return self.document.size(*(self.number(side) if self.has(side) else None for side in (width, height)))

    def size(self, name: str) -> dict[str, Any]:
        """Return the settings of a picture's size, width and height; that of the frame if it is missing."""
        return self.document.size(*(self.numbers(name, 2) if self.has(name) else (None, None)))
