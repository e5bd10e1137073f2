"""What the nodes of materials compute, as functions of arrays (channels, m): the formulas of Blender's manual.

Colors and vectors have three channels, values one.
"""

from collections.abc import Callable

import numpy as np

Operation = Callable[..., np.ndarray]


def mix(factor: np.ndarray, first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Return the linear interpolation of two values; exactly the first at 0 and the second at 1."""
    return np.where(factor == 1, second, first + factor * (second - first))


def _safe(above: np.ndarray, below: np.ndarray) -> np.ndarray:
    return np.where(below != 0, above / np.where(below != 0, below, 1.0), 0.0)


def _overlay(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.where(a < 0.5, 2 * a * b, 1 - 2 * (1 - a) * (1 - b))


def _soft_light(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return (1 - a) * b * a + a * (1 - (1 - b) * (1 - a))


BLENDS: dict[str, Operation] = {
    "MIX": lambda a, b: b + 0 * a,
    "ADD": lambda a, b: a + b,
    "SUBTRACT": lambda a, b: a - b,
    "MULTIPLY": lambda a, b: a * b,
    "DIVIDE": lambda a, b: np.where(b != 0, _safe(a, b), a),
    "SCREEN": lambda a, b: 1 - (1 - a) * (1 - b),
    "OVERLAY": _overlay,
    "SOFT_LIGHT": _soft_light,
    "LINEAR_LIGHT": lambda a, b: a + 2 * (b - 0.5),
    "DIFFERENCE": lambda a, b: np.abs(a - b),
    "EXCLUSION": lambda a, b: a + b - 2 * a * b,
    "DARKEN": np.minimum,
    "LIGHTEN": np.maximum,
}
"""What the blend types of a Mix Color node make of two colors at factor 1; those that convert to HSV are missing."""

MATHS: dict[str, Operation] = {
    "ADD": lambda a, b, c: a + b,
    "SUBTRACT": lambda a, b, c: a - b,
    "MULTIPLY": lambda a, b, c: a * b,
    "DIVIDE": lambda a, b, c: _safe(a, b),
    "MULTIPLY_ADD": lambda a, b, c: a * b + c,
    "POWER": lambda a, b, c: np.nan_to_num(np.power(a, b), posinf=0.0),
    "SQRT": lambda a, b, c: np.sqrt(np.maximum(a, 0)),
    "ABSOLUTE": lambda a, b, c: np.abs(a),
    "EXPONENT": lambda a, b, c: np.exp(a),
    "MINIMUM": lambda a, b, c: np.minimum(a, b),
    "MAXIMUM": lambda a, b, c: np.maximum(a, b),
    "LESS_THAN": lambda a, b, c: (a < b) * 1.0,
    "GREATER_THAN": lambda a, b, c: (a > b) * 1.0,
    "SIGN": lambda a, b, c: np.sign(a),
    "ROUND": lambda a, b, c: np.floor(a + 0.5),
    "FLOOR": lambda a, b, c: np.floor(a),
    "CEIL": lambda a, b, c: np.ceil(a),
    "TRUNC": lambda a, b, c: np.trunc(a),
    "FRACT": lambda a, b, c: a - np.floor(a),
    "MODULO": lambda a, b, c: np.where(b != 0, np.fmod(a, np.where(b != 0, b, 1.0)), 0.0),
    "SINE": lambda a, b, c: np.sin(a),
    "COSINE": lambda a, b, c: np.cos(a),
    "RADIANS": lambda a, b, c: np.radians(a),
    "DEGREES": lambda a, b, c: np.degrees(a),
}
"""The operations of a Math node that are read."""

VECTOR_MATHS: dict[str, Operation] = {
    name: MATHS[name]
    for name in ("ADD", "SUBTRACT", "MULTIPLY", "DIVIDE", "MULTIPLY_ADD", "ABSOLUTE", "MINIMUM", "MAXIMUM", "SIGN")
} | {
    "FLOOR": MATHS["FLOOR"],
    "CEIL": MATHS["CEIL"],
    "FRACTION": MATHS["FRACT"],
    "MODULO": MATHS["MODULO"],
}
"""The operations of a Vector Math node that are read, besides SCALE."""


def saturated(values: np.ndarray) -> np.ndarray:
    """Return values clamped to 0 .. 1."""
    return np.clip(values, 0.0, 1.0)


def map_range(value, from_min, from_max, to_min, to_max) -> np.ndarray:
    """Return a value mapped linearly from one range to another."""
    return to_min + _safe(value - from_min, from_max - from_min) * (to_max - to_min)


def gamma(color: np.ndarray, power: np.ndarray) -> np.ndarray:
    """Return the positive components of a color to a power."""
    return np.where(color > 0, np.power(np.maximum(color, np.finfo(float).tiny), power), color)


def bright_contrast(color: np.ndarray, bright: np.ndarray, contrast: np.ndarray) -> np.ndarray:
    """Return what a Brightness/Contrast node makes of a color."""
    return np.maximum((1 + contrast) * color + bright - contrast * 0.5, 0)


def hue_saturation(color, hue, saturation, value, factor) -> np.ndarray:
    """Return what a Hue/Saturation/Value node makes of a color; a hue of 0.5 changes nothing."""
    h, s, v = hsv_of(np.broadcast_to(color, (3, *np.shape(color)[1:])))
    turned = rgb_of(np.mod(h + hue[0] + 0.5, 1.0), np.clip(s * saturation[0], 0, 1), v * value[0])
    return np.maximum(mix(factor, color, turned), 0)


def hsv_of(color: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return hue, saturation and value, (m,) each, of a color."""
    largest, least = color.max(axis=0), color.min(axis=0)
    span = largest - least
    red, green, blue = (largest - color) / np.where(span > 0, span, 1.0)
    hue = np.where(color[0] == largest, blue - green, np.where(color[1] == largest, 2 + red - blue, 4 + green - red))
    hue = np.where(span > 0, np.mod(hue / 6, 1.0), 0.0)
    return hue, np.where(largest != 0, span / np.where(largest != 0, largest, 1.0), 0.0), largest


def rgb_of(hue: np.ndarray, saturation: np.ndarray, value: np.ndarray) -> np.ndarray:
    """Return the color of hue, saturation and value."""
    ramps = [np.abs(hue * 6 - 3) - 1, 2 - np.abs(hue * 6 - 2), 2 - np.abs(hue * 6 - 4)]
    return np.array([((np.clip(ramp, 0, 1) - 1) * saturation + 1) * value for ramp in ramps])


def rotated(vector: np.ndarray, angles: np.ndarray, inverse: bool = False) -> np.ndarray:
    """Return a vector turned by Euler angles, x first (Blender's XYZ), or turned back."""
    order = (0, 1, 2)
    result = np.array(np.broadcast_arrays(*vector))
    for axis in reversed(order) if inverse else order:
        cosine, sine = np.cos(angles[axis]), np.sin(-angles[axis] if inverse else angles[axis])
        i, j = (axis + 1) % 3, (axis + 2) % 3
        a, b = result[i], result[j]
        turned = list(result)
        turned[i], turned[j] = cosine * a - sine * b, sine * a + cosine * b
        result = np.array(np.broadcast_arrays(*turned))
    return result


def mapped(kind: str, vector, location, rotation, scale) -> np.ndarray:
    """Return what a Mapping node of a type makes of a vector."""
    if kind == "TEXTURE":
        return _safe(rotated(vector - location, rotation, inverse=True), scale + 0 * vector)
    if kind == "NORMAL":
        turned = rotated(_safe(vector, scale + 0 * vector), rotation)
        length = np.sqrt((turned * turned).sum(axis=0))
        return _safe(turned, length + 0 * turned)
    turned = rotated(vector * scale, rotation)
    return turned + location if kind == "POINT" else turned


def checker(point: np.ndarray, scale: np.ndarray) -> np.ndarray:
    """Return where a Checker Texture has its first color, 1, and its second, 0."""
    cell = np.floor((point * scale + 1e-6) * 0.999999) % 2
    return (((cell[0] == cell[1]) == (cell[2] == 1)) * 1.0)[None]


def looked_up(table: np.ndarray, is_smooth: bool, position: np.ndarray, goes_on: bool = False) -> np.ndarray:
    """Return the entries of a table (channels, n) at positions 0 .. 1, (1, m), interpolated or the one before. Beyond
    its ends the table is constant, or ``goes_on`` as the line through the two last entries.
    """
    entry = np.nan_to_num(position[0]) * (table.shape[1] - 1)
    within = np.clip(entry, 0, table.shape[1] - 1)
    before = np.floor(within).astype(np.intp)
    if not is_smooth:
        return table[:, before]
    first = np.minimum(before, table.shape[1] - 2)
    slope = table[:, first + 1] - table[:, first]
    return table[:, before] + ((entry if goes_on else within) - before) * slope
