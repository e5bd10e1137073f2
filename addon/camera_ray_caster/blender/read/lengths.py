"""The scene's units, and lengths as text in them."""

import bpy
import numpy as np

DIGITS = 6
"""Significant digits of lengths, and digits after the point."""
UNITS = {
    "KILOMETERS": (1e3, " km"), "METERS": (1.0, " m"), "CENTIMETERS": (1e-2, " cm"), "MILLIMETERS": (1e-3, " mm"),
    "MICROMETERS": (1e-6, " µm"), "MILES": (1609.344, " mi"), "FEET": (0.3048, "'"), "INCHES": (0.0254, '"'),
    "THOU": (2.54e-5, " thou"),
}  # fmt: skip
"""Meters and sign of Blender's units of length, by key; the unit ADAPTIVE depends on the length."""


def meters_of(scene) -> float:
    """Return the length of a Blender unit in meters: the Unit Scale, which Blender ignores without a system of units.
    """
    units = scene.unit_settings
    return 1.0 if units.system == "NONE" else units.scale_length


def length(context, value: float) -> str:
    """Return a length as text in the scene's unit."""
    units = context.scene.unit_settings
    meters = value * meters_of(context.scene)
    if units.system == "NONE":
        text = f"{value:.{DIGITS}g}"
    elif units.length_unit in UNITS:
        size, sign = UNITS[units.length_unit]
        text = np.format_float_positional(round(meters / size, DIGITS), DIGITS, fractional=False, trim="-") + sign
    else:
        text = bpy.utils.units.to_string(units.system, "LENGTH", meters, precision=DIGITS)
    return text if set(text) & set("123456789") else text.lstrip("-")  # no -0
