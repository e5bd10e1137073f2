"""The settings of cameras, each declared once: name, kind, unit, range, default and text, and how it is read.

Blender's properties, the panel, the copying into a record, the report and the table of models are made from these
declarations. A setting that several models share is one object, declared in ``parts``.
"""

import math
from abc import ABC
from dataclasses import dataclass, field, fields
from reprlib import repr as shortened
from typing import Any, ClassVar, NamedTuple

import numpy as np

from ...maths.recording import Varied, is_recorded
from ...records import BlenderCamera, InputError
from .left_out import DECLARED

FULL_TURN = 2 * math.pi

ABOVE_ZERO = math.ulp(0.0)
"""The lower limit of numbers that must be positive."""

LARGEST, LARGEST_ANGLE = 1e152, 1e4
"""Largest magnitudes of numbers and of angles, whatever their range: the square of a larger number would overflow, and
float32 does not resolve a hundredth of a degree of a larger angle.
"""

LIMIT_ROUNDING = 1e-6
"""Relative amount by which a value may exceed a limit, since Blender stores it as float32."""
OWN, CAMERA, FOCUS, STEREO = "own", "camera", "focus", "stereo"
RENDER, CYCLES, FROM_A_FILE = "render", "cycles", "file"
"""Owner of a setting: the add-on's properties, which are made from the setting, or, for Blender's own settings, the
camera, its depth of field or stereoscopy, the scene's render or Cycles settings; FROM_A_FILE has no property.
"""

RECORD_FIELDS = frozenset(entry.name for entry in fields(BlenderCamera))


@dataclass(frozen=True)
class Setting(ABC):
    """A setting of a camera; ``kind`` is the kind of its property."""

    name: str
    """Name of the property, also used in records, reports and messages."""
    label: str
    text: str
    """Explanation for the tooltip and the table of models."""

    default: Any
    """Value of a new camera."""
    owner: str = field(default=OWN, kw_only=True)
    """Where Blender keeps the setting: OWN or one of the others."""
    partner: str = field(default="", kw_only=True)
    """The other setting of a pair of which neither makes sense alone."""
    left_out: str = field(default=DECLARED, kw_only=True)
    """What it is where it is left out of a camera made in Python: a word of ``left_out``."""
    used_with: tuple[tuple[str, Any], ...] = field(default=(), kw_only=True)
    """The settings and their values without which this one has no effect."""

    kind: ClassVar[str]

    def given(self, raw: BlenderCamera) -> Any:
        """Return the value in a record, unchanged. Raises InputError if the record has none."""
        if self.name in RECORD_FIELDS:
            return getattr(raw, self.name)
        if self.name not in raw.settings:
            raise InputError(f"camera {raw.name!r} has no setting {self.name}, which its model needs")
        return raw.settings[self.name]

    def read(self, raw: BlenderCamera) -> Any:
        """Return the value that a model uses. Raises InputError for an invalid value."""
        return self.given(raw)

    def reported(self, raw: BlenderCamera) -> Any:
        """Return the value for a report: plain numbers, words, lists and None."""
        return _plain(self.given(raw))

    def refusal(self, raw: BlenderCamera, value: str, allowed: str) -> InputError:
        """Return the error that names the setting of a camera, its value, and the values that are allowed."""
        return InputError(f"{self.name} of camera {raw.name!r} is {value}: it must be {allowed}")


@dataclass(frozen=True)
class Number(Setting):
    """A finite number. Angles are in radians, lengths in Blender units unless the unit says otherwise."""

    low: float = -math.inf
    high: float = math.inf
    unit: str = ""
    """"angle", "length", "mm", "pixels" or none."""
    digits: int = 2
    """Number of decimals shown."""
    step: float = 3.0
    """Increment of a click on the field's arrow, in hundredths, Blender's unit; an angle's is 1 degree."""
    soft_high: float = math.inf
    """Upper end of the field's slider; larger values can be typed in."""

    kind = "FLOAT"

    def read(self, raw: BlenderCamera, low: float | None = None, high: float | None = None) -> float:
        """Return the value. Raises InputError if it is not from ``low`` to ``high``, by default the setting's range."""
        low, high = self.limits(self.low if low is None else low, self.high if high is None else high)
        value, near = self.given(raw), LIMIT_ROUNDING
        is_number = isinstance(value, int | float)
        within = is_number and low - near * abs(low) <= value <= high + near * abs(high)  # NaN is not
        if not (is_recorded(value) or within):
            too_large = is_number and high == LARGEST < abs(value) < math.inf
            allowed = self.range_in_words(low, high) + f", up to {high:g}" * bool(too_large)
            raise self.refusal(raw, self.in_words(value, " ({:g} radians)"), allowed)
        return value if isinstance(value, Varied) or is_recorded(value) else float(value)

    def in_words(self, value, radians: str = "") -> str:
        """Return a value with its unit; ``radians``: the format of an angle as it is stored, which follows it."""
        if self.unit == "angle" and isinstance(value, int | float):
            return f"{math.degrees(value):.6g} degrees" + radians.format(value)
        return f"{value:.6g}" if isinstance(value, float) else f"{value!r}"

    def limits(self, low: float, high: float) -> tuple[float, float]:
        """Return a range clipped to LARGEST, or to LARGEST_ANGLE for angles."""
        largest = LARGEST_ANGLE if self.unit == "angle" else LARGEST
        return max(low, -largest), min(high, largest)

    def range_in_words(self, low: float, high: float) -> str:
        """Return the words for a range in a message."""
        if (low, high) == (-LARGEST, LARGEST):
            return "a finite number"
        lowest, highest = self.in_words(low), self.in_words(high)
        if low == ABOVE_ZERO:
            return "above 0" + f", up to {highest}" * bool(high != LARGEST)
        return f"{lowest} or more" if high == LARGEST else f"from {lowest} to {highest}"


@dataclass(frozen=True)
class Whole(Number):
    """A whole number."""

    kind = "INT"


@dataclass(frozen=True)
class Flag(Setting):
    """A check box."""

    kind = "BOOLEAN"

    def read(self, raw: BlenderCamera) -> bool:
        """Return whether it is checked."""
        return bool(self.given(raw))


class Item(NamedTuple):
    """One of the words of a choice."""

    key: str
    label: str
    text: str
    number: int
    """Number that a .blend stores: never changed, never reused."""
    group: str = ""
    """Heading that a menu shows above the items of a group."""


@dataclass(frozen=True)
class Choice(Setting):
    """A choice of one word among several."""

    items: tuple[Item, ...]

    kind = "ENUM"

    def read(self, raw: BlenderCamera) -> str:
        """Return the word. Raises InputError, which lists the known words, for any other."""
        value, known = self.given(raw), [item.key for item in self.items]
        if value not in known:
            raise self.refusal(raw, repr(value), f"one of {', '.join(known)}")
        return str(value)


@dataclass(frozen=True)
class Numbers(Setting):
    """A vector of as many finite numbers as the default has. ``components``: their names in the panel."""

    components: tuple[str, ...]

    kind = "VECTOR"

    def read(self, raw: BlenderCamera) -> tuple[float, ...]:
        """Return the numbers. Raises InputError, which names the setting and its value."""
        values, count = tuple(self.given(raw)), len(self.default)
        if is_recorded(*values):
            return values
        if len(values) != count or not all(isinstance(v, int | float) and abs(v) <= LARGEST for v in values):
            raise self.refusal(raw, f"{values}", f"{count} finite numbers")
        return values


@dataclass(frozen=True)
class Text(Setting):
    """A line of text."""

    kind = "TEXT"

    def read(self, raw: BlenderCamera) -> Any:
        """Return the text."""
        return str(self.given(raw) or "")


@dataclass(frozen=True)
class Coefficients(Text):
    """The coefficients of a polynomial of any degree, from the constant up: text, which keeps all their digits."""

    grows: tuple[int, int] = (0, 0)
    """(p, q) if the coefficient of the power i is in proportion to size^(p + q i) in pictures of one field of view."""

    limit: ClassVar[int] = 64
    order: ClassVar[str] = ", from the constant up"

    def read(self, raw: BlenderCamera) -> tuple[float, ...]:
        """Return the numbers of the text, which has commas or spaces between them, and may have brackets around them.

        Raises InputError, which names the setting and its value.
        """
        numbers = self.numbers(raw)
        if is_recorded(*numbers):
            return numbers
        if not (0 < len(numbers) <= self.limit and all(abs(number) <= LARGEST for number in numbers)):
            raise self.refusal(raw, shortened(str(self.given(raw))), f"1 to {self.limit} finite numbers{self.order}")
        return numbers

    def numbers(self, raw: BlenderCamera) -> tuple[float, ...]:
        """Return the numbers as they are given; none for text that has anything else."""
        value = self.given(raw)
        if isinstance(value, tuple):
            return value
        try:
            return tuple(map(float, str(value).strip(" []()").replace(",", " ").split()))
        except ValueError:
            return ()


@dataclass(frozen=True)
class FilePath(Text):
    """The path of a file, or empty. A record has the absolute path."""

    kind = "FILE"


@dataclass(frozen=True)
class Line(Setting):
    """An object of the scene that represents a line; ``parts.lines`` describes its value in a record.

    ``types``: Blender's object types that can be chosen. ``sampled``: whether a curve is given by all its points, not
    by its two ends.
    """

    types: tuple[str, ...]
    sampled: bool = False

    kind = "OBJECT"

    def reported(self, raw: BlenderCamera) -> Any:
        """Return the first and the last point in the world, (2, 3) as lists; None without a line."""
        line_data: Any = self.given(raw)
        if line_data is None or not len(line_data[0]):
            return None
        points, matrix = (np.asarray(array, np.float64) for array in line_data[:2])
        return (points[[0, -1]] @ matrix[:3, :3].T + matrix[:3, 3]).tolist()


@dataclass(frozen=True)
class Image(Setting):
    """An image. A record holds the mean of its channels, (rows, columns) from the bottom, or None."""

    kind = "IMAGE"


def span(
    raw: BlenderCamera, start: Number, end: Number, *, low: float | None = None, high: float | None = None
) -> tuple[float, float]:
    """Return the values of two settings, each from ``low`` to ``high``, by default in its own range. Swapped ends
    mirror the picture. Raises InputError if they are equal.
    """
    first, last = start.read(raw, low, high), end.read(raw, low, high)
    if first == last:
        same = start.in_words(first)
        raise InputError(f"{start.name} and {end.name} of camera {raw.name!r} are both {same}: set them apart")
    return first, last


def _plain(value):
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    return [_plain(item) for item in value] if isinstance(value, list | tuple) else value
