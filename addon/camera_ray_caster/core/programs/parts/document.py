"""Code that the readers of all formats share: the text of a file, its entries and numbers, and the resulting lenses."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection
from copy import copy
from functools import cached_property
from hashlib import sha256
from typing import Any, NamedTuple

from ...arguments import shown
from ...cameras.parts.calibration import LARGEST
from ...records import InputError
from ...text_forms.content import content_of, deadline, decoded, entries_of

NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", re.ASCII)
"""How files write a finite number."""


class Lens(NamedTuple):
    """A lens of a file: its name in the file, the key of its model, and the settings that are not at their defaults."""

    name: str
    model: str
    settings: dict[str, Any]
    refusal: InputError | None = None
    """Why the lens cannot be read; it has only a name then."""


FRAME_SIZE = {"calibration_width": 0.0, "calibration_height": 0.0}
"""The settings of a calibrated picture that is as large as the frame."""


class Document:
    """A calibration file. Raises InputError if it cannot be read.

    ``frame``: width and height of the camera's frame, for files that do not tell the size of their pictures, and whose
    lens depends on it; None if it does not matter.
    """

    def __init__(self, path: str, frame: tuple[int, int] | None = None):
        self.path, self.frame, self.data, self.check = path, frame, content_of(path), deadline(path)

    @property
    def digest(self) -> bytes:
        """Return a hash of the content."""
        return sha256(self.data).digest()

    @cached_property
    def text(self) -> str:
        """Return the text of the file. Raises InputError if it is binary."""
        return decoded(self.data, self.path)

    @cached_property
    def entries(self) -> dict:
        """Return the entries of a JSON, YAML or XML file. Raises InputError for any other file."""
        return entries_of(self.text, self.path, self.check)

    def part(self, entries: dict) -> Document:
        """Return a document of these entries alone, with the path of this one."""
        part = copy(self)
        part.text, part.data, part.entries = "", b"", entries
        return part

    def refusal(self, reason: str) -> InputError:
        """Return the error with this reason and the file's path."""
        return InputError(f"calibration file {self.path!r}: {reason}")

    def numbers(self, values, name: str, count: int | None = None) -> list[float]:
        """Return a list of finite numbers, ``count`` of them if given. Raises InputError, with ``name``, otherwise."""
        if values is None:
            raise self.refusal(f"it has no {name}")
        numbers = numbers_of(values)
        if not numbers or (count or len(numbers)) != len(numbers) or not all(abs(one) <= LARGEST for one in numbers):
            wanted = f"{count or 'a list of'} finite number{'' if count == 1 else 's'}, up to {LARGEST:g}"
            raise self.refusal(f"{name} is {shown(values)}: it must be {wanted}")
        return numbers

    def one_of(self, value, name: str, known: Collection[str]) -> str:
        """Return a word that is one of ``known``. Raises InputError, with ``name``, otherwise."""
        if value is None:
            raise self.refusal(f"it has no {name}: it must be one of {', '.join(known)}")
        if not isinstance(value, str) or value not in known:
            raise self.refusal(f"{name} is {shown(value)}: it must be one of {', '.join(known)}")
        return value

    def size(self, width: float | None, height: float | None) -> dict[str, Any]:
        """Return the settings of a calibrated picture's size; without one, that of the frame.

        Raises InputError unless both sides are whole pixels.
        """
        if width is None and height is None:
            return dict(FRAME_SIZE)
        if width is None or height is None:
            raise self.refusal(f"it has {'a height and no width' if width is None else 'a width and no height'}")
        if min(width, height) < 1 or width % 1 or height % 1:
            raise self.refusal(f"its image size is {width:g} x {height:g}: it must be of whole numbers above 0")
        return {"calibration_width": width, "calibration_height": height}

    def number(self, owner: dict, name: str, default: float | None = None) -> float:
        """Return a number of a mapping. Raises InputError if it is missing and has no default, or is not a number."""
        if name not in owner and default is None:
            raise self.refusal(f"it has no {name}")
        return self.numbers(owner.get(name, default), name, 1)[0]


def one_of_several(name: str, read: Callable[..., Lens], *given) -> Lens:
    """Return the lens that ``read`` returns for what is given, or a lens with the reason why it cannot be read: the
    other lenses of its file may be chosen. The first thing given is the document.
    """
    given[0].check()
    try:
        return read(*given)
    except InputError as refusal:
        return Lens(name, "", {}, refusal.with_traceback(None))


def numbers_of(value) -> list[float]:
    """Return a number or a list of numbers as floats; empty if an entry is not a number, as True and words are not."""
    items = value if isinstance(value, list | tuple) else [value]
    if any(isinstance(item, bool) or (isinstance(item, str) and not NUMBER.fullmatch(item.strip())) for item in items):
        return []
    try:
        return [float(item) for item in items]
    except (TypeError, ValueError, OverflowError):
        return []


def mapping(value) -> dict:
    """Return a value if it is a mapping; else an empty one."""
    return value if isinstance(value, dict) else {}


def matrix_of(settings: dict[str, Any], first: float = 0.0) -> list[float]:
    """Return fx, fy, cx and cy of settings, with the center of the top left pixel at (first, first).

    This is the inverse of ``matrix``.
    """
    return [settings["fx"], settings["fy"], settings["cx"] + first, settings["cy"] + first]


def matrix(fx: float, fy: float, cx: float, cy: float, first: float = 0.0) -> dict[str, Any]:
    """Return the settings of a camera matrix in which the center of the top left pixel is at (first, first)."""
    return {"fx": fx, "fy": fy, "cx": cx - first, "cy": cy - first}
