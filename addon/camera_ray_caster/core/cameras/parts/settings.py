"""The settings that only some models have: read by name, with the range in which they mean something."""

from __future__ import annotations

import math
from typing import Any

from ...records import BlenderCamera, InputError

FULL_TURN = 2 * math.pi
WIDEST_FISHEYE = math.radians(1800)
"""Where Blender ends a fisheye's field of view."""

ROUNDING = 1e-6
"""Of itself: a limit stored as float32 may lie this much beyond."""


def number(raw: BlenderCamera, name: str, low: float = -math.inf, high: float = math.inf, unit: str = "") -> float:
    """Return a setting as a float, which must lie between low and high, both included where they are finite.

    unit "deg" writes the range in degrees; the setting itself is in radians. Raises InputError that names the
    setting, its value and the range.
    """
    if name not in raw.settings:
        raise InputError(f"camera {raw.name!r} has no setting {name}, which its model needs")
    value = raw.settings[name]
    if (
        not isinstance(value, int | float)
        or not math.isfinite(value)
        or not low - ROUNDING * abs(low) <= value <= high + ROUNDING * abs(high)
    ):
        raise InputError(f"{name} of camera {raw.name!r} is {_text(value, unit)}: it must be {_range(low, high, unit)}")
    return float(value)


def numbers(raw: BlenderCamera, name: str, count: int) -> tuple[float, ...]:
    """Return a setting of ``count`` finite numbers. Raises InputError that names it and its value."""
    given: Any = raw.settings.get(name, ())
    values = tuple(given)
    if len(values) != count or not all(isinstance(value, int | float) and math.isfinite(value) for value in values):
        raise InputError(f"{name} of camera {raw.name!r} is {values}: it must be {count} finite numbers")
    return values


def choice(raw: BlenderCamera, name: str, known) -> str:
    """Return a setting that is one of the known words. Raises InputError that names them."""
    value = raw.settings.get(name)
    if value not in known:
        raise InputError(f"{name} of camera {raw.name!r} is {value!r}: it must be one of {', '.join(known)}")
    return str(value)


def span(raw: BlenderCamera, start: str, end: str, low: float = -math.inf, high: float = math.inf, unit: str = ""):
    """Return a pair of settings. Swapped ends mirror the picture; InputError where they are equal."""
    pair = number(raw, start, low, high, unit), number(raw, end, low, high, unit)
    if pair[0] == pair[1]:
        raise InputError(f"{start} and {end} of camera {raw.name!r} are both {_text(pair[0], unit)}: set them apart")
    return pair


def positive(raw: BlenderCamera, name: str, high: float = math.inf, unit: str = "") -> float:
    """Return a setting above zero, up to ``high``."""
    return number(raw, name, math.ulp(0.0), high, unit)


def _text(value, unit: str) -> str:
    if unit == "deg" and isinstance(value, int | float):
        return f"{math.degrees(value):.6g} degrees"
    return f"{value!r}"


def _range(low: float, high: float, unit: str) -> str:
    if low == math.ulp(0.0):
        return "above 0" if high == math.inf else f"above 0, up to {_text(high, unit)}"
    if (low, high) == (-math.inf, math.inf):
        return "a finite number"
    return f"from {_text(low, unit)} to {_text(high, unit)}"
