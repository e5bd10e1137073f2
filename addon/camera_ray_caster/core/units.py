"""Lengths in files: the one place where they are converted from Blender units and back.

A format that writes or reads lengths states its unit as a length in meters, METERS, CENTIMETERS or MILLIMETERS, or
BLENDER_UNITS for lengths that it leaves as they are. A scene's Unit Scale is the length of its Blender unit in meters.
"""

from __future__ import annotations

METERS, CENTIMETERS, MILLIMETERS = 1.0, 1e-2, 1e-3
BLENDER_UNITS = None

UNIT_SCALE = "unit_scale"
"""Name of the Unit Scale among the settings of a camera's record; cameras made in Python have none, which is 1."""

Unit = float | None
"""Length of a format's unit in meters; None: Blender units, or those of the file."""


def factor(unit: Unit, meters: float) -> float:
    """Return a Blender unit of ``meters`` in a format's unit: what is written is multiplied by it, what is read is
    divided.
    """
    return 1.0 if unit is None else meters / unit


def unit_name(unit: Unit) -> str:
    """Return a unit in words."""
    return {None: "Blender units", METERS: "meters", CENTIMETERS: "centimeters", MILLIMETERS: "millimeters"}[unit]
