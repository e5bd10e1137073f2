"""Lenses in files, as plain records, and the numbers of which they are made."""

import re
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from ...records import InputError

NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", re.ASCII)
"""How files write a finite number."""


class Lens(NamedTuple):
    """A lens of a file: its name in the file, the key of its model, and the settings that are not at their defaults."""

    name: str
    model: str
    settings: dict[str, Any]
    refusal: InputError | None = None
    """Why the lens cannot be read; it has only a name then."""

    def values(self, names: Iterable[str]) -> list[float]:
        """Return the values of settings; 0 for settings that the lens does not have."""
        return [float(self.settings.get(name, 0.0)) for name in names]

    @property
    def size(self) -> tuple[int, int]:
        """Return width and height of the calibrated picture; 0 if the file does not tell them."""
        width, height = self.values(FRAME_SIZE)
        return int(width), int(height)


FRAME_SIZE = {"calibration_width": 0.0, "calibration_height": 0.0}
"""The settings of a calibrated picture that is as large as the frame."""

MATRIX = "fx", "fy", "cx", "cy"

ANGLES = "longitude_min", "longitude_max", "latitude_min", "latitude_max"
"""The settings of an equirectangular panorama."""

ARIA_TERMS = "k1", "k2", "k3", "k4", "k5", "k6", "p2", "p1", "s1", "s2", "s3", "s4"
"""The coefficients of a FISHEYE624 in the order of Project Aria."""

Models = Mapping[str, tuple[str, Sequence[str]]]
"""Models of a program by its words: the key of our model, and the settings that follow the camera matrix."""


def word_of(models: Models, lens: Lens) -> str | None:
    """Return the first model of a program that can store a lens; None if no model can."""
    known = ((word, terms) for word, (key, terms) in models.items() if key == lens.model)
    return next((word for word, terms in known if not beyond(lens, terms)), None)


def beyond(lens: Lens, terms: Collection[str]) -> list[str]:
    """Return the settings of a lens that are not 0 and that neither the matrix nor ``terms`` contain."""
    stored = {*MATRIX, *FRAME_SIZE, *terms}
    return [name for name, value in lens.settings.items() if value and name not in stored]


def one_of_several(name: str, read: Callable[..., Lens], *arguments) -> Lens:
    """Return the lens that ``read`` returns for what is given, or a lens with the reason why it cannot be read: the
    other lenses of its file may be chosen. The first thing given is the document, or entries of it.
    """
    getattr(arguments[0], "document", arguments[0]).check()
    try:
        return read(*arguments)
    except InputError as refusal:
        return Lens(name, "", {}, refusal.with_traceback(None))


def once_each(lenses: Iterable[Lens]) -> list[Lens]:
    """Return the lens of each picture; equal ones are one, by the name of its first picture."""
    first: dict[str, Lens] = {}
    return [first.setdefault(repr(lens[1:]), lens) for lens in lenses]


def different(lenses: Iterable[Lens]) -> list[Lens]:
    """Return the lenses of pictures without repetition; an only one has no name."""
    distinct = list({lens.name: lens for lens in once_each(lenses)}.values())
    return [distinct[0]._replace(name="")] if len(distinct) == 1 else distinct


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


def matrix_of(settings: Mapping[str, Any], first: float = 0.0) -> list[float]:
    """Return fx, fy, cx and cy of settings, with the center of the top left pixel at (first, first).

    This is the inverse of ``matrix``.
    """
    return [settings["fx"], settings["fy"], settings["cx"] + first, settings["cy"] + first]


def matrix(fx: float, fy: float, cx: float, cy: float, first: float = 0.0) -> dict[str, Any]:
    """Return the settings of a camera matrix in which the center of the top left pixel is at (first, first)."""
    return {"fx": fx, "fy": fy, "cx": cx - first, "cy": cy - first}


