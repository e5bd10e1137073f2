"""The settings that only some models have: read by name, with the range in which they mean something."""

from __future__ import annotations

import math

from ..records import BlenderCamera, InputError

FULL_TURN = 2 * math.pi
WIDEST_FISHEYE = math.radians(1800)
"""Where Blender ends a fisheye's field of view."""

ROUNDING = 1 + 1e-6
"""A limit stored as float32 may lie this much beyond itself."""


def number(raw: BlenderCamera, name: str, low: float = -math.inf, high: float = math.inf, unit: str = "") -> float:
    """Return a setting as a float, which must lie between low and high, both included where they are finite.

    unit "deg" writes the range in degrees; the setting itself is in radians. Raises InputError that names the
    setting, its value and the range.
    """
    if name not in raw.settings:
        raise InputError(f"camera {raw.name!r} has no setting {name}, which its model needs")
    value = raw.settings[name]
    if not isinstance(value, int | float) or not math.isfinite(value) or not low <= value <= high:
        raise InputError(f"{name} of camera {raw.name!r} is {_text(value, unit)}: it must be {_range(low, high, unit)}")
    return float(value)


def span(raw: BlenderCamera, low_name: str, high_name: str, low: float = -math.inf, high: float = math.inf):
    """Return a (low, high) pair of settings. Swapped ends mirror the picture; InputError where they are equal."""
    pair = number(raw, low_name, low, high), number(raw, high_name, low, high)
    if pair[0] == pair[1]:
        raise InputError(f"{low_name} and {high_name} of camera {raw.name!r} are both {pair[0]}: set them apart")
    return pair


def positive(raw: BlenderCamera, name: str, high: float = math.inf, unit: str = "") -> float:
    """Return a setting above zero, up to ``high`` and its rounding to float32."""
    return number(raw, name, math.ulp(0.0), high * ROUNDING, unit)


def _text(value, unit: str) -> str:
    if unit == "deg" and isinstance(value, int | float):
        return f"{math.degrees(value):.6g} degrees"
    return f"{value!r}"


def _range(low: float, high: float, unit: str) -> str:
    if low == math.ulp(0.0):
        return "above 0" if high == math.inf else f"above 0, up to {_text(high / ROUNDING, unit)}"
    if (low, high) == (-math.inf, math.inf):
        return "a finite number"
    return f"from {_text(low, unit)} to {_text(high, unit)}"
