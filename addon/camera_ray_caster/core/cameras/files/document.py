"""What the readers of all formats share: the text of a file, its entries, its numbers, and what they make of them."""

from __future__ import annotations

from functools import cached_property
from reprlib import repr as shortened
from typing import Any, NamedTuple

from ...records import InputError
from ..parts.calibration import LARGEST
from ..parts.filestorage import entries_of, text_of


class Lens(NamedTuple):
    """A lens of a file: its name there, the key of its model, and the settings that are not at their defaults."""

    name: str
    model: str
    settings: dict[str, Any]


class Document:
    """A calibration file. Raises InputError where it cannot be read."""

    def __init__(self, path: str):
        self.path, self.text = path, text_of(path)

    @cached_property
    def entries(self) -> dict:
        """Return what a JSON or YAML file holds; InputError for any other."""
        return entries_of(self.text, self.path)

    def refusal(self, reason: str) -> InputError:
        """Return the error that says what is wrong, with the file's path."""
        return InputError(f"calibration file {self.path!r}: {reason}")

    def numbers(self, values, name: str, count: int | None = None) -> list[float]:
        """Return numbers, so many if that is told; InputError names what they are of."""
        items = values if isinstance(values, list | tuple) else [values]
        try:
            numbers = [float(item) for item in items]
        except (TypeError, ValueError):
            numbers = []
        if not numbers or (count or len(numbers)) != len(numbers) or not all(abs(one) <= LARGEST for one in numbers):
            wanted = f"{count or 'a list of'} finite number{'' if count == 1 else 's'}, up to {LARGEST:g}"
            raise self.refusal(f"{name} is {shortened(values)}: it must be {wanted}")
        return numbers

    def number(self, owner: dict, name: str, default: float | None = None) -> float:
        """Return a number of a mapping; InputError where it is missing and has no default."""
        if name not in owner and default is None:
            raise self.refusal(f"it has no {name}")
        return self.numbers(owner.get(name, default), name, 1)[0]


def size(width: float, height: float) -> dict[str, Any]:
    """Return the settings of a calibrated picture's size."""
    return {"calibration_width": width, "calibration_height": height}


def matrix_of(settings: dict[str, Any], first: float = 0.0) -> list[float]:
    """Return fx, fy, cx and cy of settings, where the center of the top left pixel is at (first, first): the inverse
    of ``matrix``.
    """
    return [settings["fx"], settings["fy"], settings["cx"] + first, settings["cy"] + first]


def matrix(fx: float, fy: float, cx: float, cy: float, first: float = 0.0) -> dict[str, Any]:
    """Return the settings of a camera matrix in which the center of the top left pixel is at (first, first)."""
    return {"fx": fx, "fy": fy, "cx": cx - first, "cy": cy - first}
