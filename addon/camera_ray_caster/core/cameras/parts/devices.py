"""Scanners by name, and the tables of their beams.

They are nominal, by the manuals: the file of a unit is more exact. VLP-16 has the vertical offsets of its manual. Their
lengths are in meters, and count as Blender units at any Unit Scale, as those of calibration files do.
References: Velodyne, VLP-16, HDL-32E and VLP-32C User Manuals; Ouster, OS1 data sheet and Software User Manual.
"""

from collections.abc import Sequence
from math import cos, pi, radians, sin
from typing import Any, NamedTuple

from .scanners import (
    AHEAD,
    AZIMUTHS,
    COLUMNS,
    DELAYS,
    ELEVATIONS,
    FARTHEST,
    HIGH,
    LOW,
    NEAREST,
    PERIOD,
    RIGHT,
    ROW_SHARE,
    SWEEP,
    UP,
)
from .settings import Choice, Item

CUSTOM = "CUSTOM"


class Device(NamedTuple):
    """A scanner: its name in menus, a line about it, the settings that it determines, and the rows of its sweep."""

    label: str
    text: str
    settings: dict[str, Any]
    rows: int = 0
    """Of a device without a table of beams; its table tells it otherwise."""
    quantum: float = 0.0
    """Step of the ranges that it stores, meters; 0: not known."""
    behind: float = 0.0
    """Distance by which these ranges begin behind the origins of beams, meters."""


def numbers_as_text(values: Sequence[float]) -> str:
    """Return the text of a table, with all digits."""
    return " ".join(map(repr, map(float, values)))


def ouster(altitudes: Sequence[float], azimuths: Sequence[float], radius: float, up: float) -> dict[str, Any]:
    """Return the tables of an Ouster, given angles in degrees from the top row down, the distance of the beams' origins
    from the axis, and their height in the sensor's frame.

    The sensor's frame is half a turn from the lidar's, in which beams have the azimuth -(column + beam_azimuth). A
    beam's origin lies ahead in the azimuth of the encoder, which is not that of the beam.
    """
    return {
        ELEVATIONS.name: numbers_as_text(altitudes),
        AZIMUTHS.name: numbers_as_text([180.0 + angle for angle in azimuths]),
        AHEAD.name: numbers_as_text([radius * cos(radians(angle)) for angle in azimuths]),
        RIGHT.name: numbers_as_text([-radius * sin(radians(angle)) for angle in azimuths]),
        UP.name: repr(float(up)),
    }


def _pairs(first: Sequence[float], second: Sequence[float]) -> list[float]:
    return [value for pair in zip(first, second, strict=True) for value in pair]


LOWER_16, UPPER_16 = range(-15, 0, 2), range(1, 16, 2)
OFFSETS_16 = (11.2, 9.7, 8.1, 6.6, 5.1, 3.7, 2.2, 0.7)
"""Millimeters above the center, of the lower half from the lowest beam up; the upper half mirrors it."""
VLP_16 = {
    ELEVATIONS.name: numbers_as_text(_pairs(LOWER_16, UPPER_16)),
    UP.name: numbers_as_text([mm / 1000 for mm in _pairs(OFFSETS_16, [-mm for mm in OFFSETS_16[::-1]])]),
    DELAYS.name: numbers_as_text([2.304 * k for k in range(16)]),
    PERIOD.name: 55.296, NEAREST.name: 0.5, FARTHEST.name: 100.0,
}  # fmt: skip
HI_RES = {ELEVATIONS.name: numbers_as_text([angle * 2 / 3 for angle in _pairs(LOWER_16, UPPER_16)])}
HDL_32E = {
    ELEVATIONS.name: numbers_as_text(
        _pairs([round(-30.67 + k * 4 / 3, 2) for k in range(16)], [round(-9.33 + k * 4 / 3, 2) for k in range(16)])
    ),
    DELAYS.name: numbers_as_text([1.152 * k for k in range(32)]),
    PERIOD.name: 46.08, NEAREST.name: 1.0, FARTHEST.name: 100.0,
}  # fmt: skip
VLP_32C = {
    ELEVATIONS.name: "-25 -1 -1.667 -15.639 -11.31 0 -0.667 -8.843 -7.254 0.333 -0.333 -6.148 -5.333 1.333 0.667 -4 "
                     "-4.667 1.667 1 -3.667 -3.333 3.333 2.333 -2.667 -3 7 4.667 -2.333 -2 15 10.333 -1.333",
    AZIMUTHS.name: "1.4 -4.2 1.4 -1.4 1.4 -1.4 4.2 -1.4 1.4 -4.2 1.4 -1.4 4.2 -1.4 4.2 -1.4 "
                   "1.4 -4.2 1.4 -4.2 4.2 -1.4 1.4 -1.4 1.4 -1.4 1.4 -4.2 4.2 -1.4 1.4 -1.4",
    DELAYS.name: numbers_as_text([2.304 * (k // 2) for k in range(32)]),
    PERIOD.name: 55.296, NEAREST.name: 1.0, FARTHEST.name: 200.0,
}  # fmt: skip


RADIUS_64, RADIUS_128 = 0.012163, 0.015806
"""Distances of the beams' origins from the axis, by which an Ouster's ranges begin behind them."""


def _os1(beams: int, highest: float, azimuth: float, radius: float, farthest: float) -> dict[str, Any]:
    even = [highest * (1 - 2 * row / (beams - 1)) for row in range(beams)]
    four = [azimuth, azimuth / 3, -azimuth / 3, -azimuth]
    limits = {COLUMNS.name: 1024, NEAREST.name: 0.5, FARTHEST.name: farthest}
    return ouster(even, four * (beams // 4), radius, 0.03618) | limits


DEVICES = {
    "VLP_16": Device("VLP-16", "Velodyne Puck, 16 beams", VLP_16, quantum=0.002),
    "PUCK_HI_RES": Device("Puck Hi-Res", "Velodyne Puck Hi-Res, 16 beams", VLP_16 | HI_RES, quantum=0.002),
    "HDL_32E": Device("HDL-32E", "Velodyne, 32 beams", HDL_32E, quantum=0.002),
    "VLP_32C": Device("VLP-32C", "Velodyne Ultra Puck, 32 beams", VLP_32C, quantum=0.004),
    "OS1_64": Device(
        "OS1-64", "Ouster, 64 even beams", _os1(64, 16.6, 3.164, RADIUS_64, 120.0), quantum=0.001, behind=RADIUS_64
    ),
    "OS1_128": Device(
        "OS1-128", "Ouster, 128 even beams", _os1(128, 21.2, 4.2, RADIUS_128, 200.0), quantum=0.001, behind=RADIUS_128
    ),
    "TERRESTRIAL": Device(
        "Terrestrial", "A head that turns slowly under a mirror: rows are mirror steps, one after the other",
        {LOW.name: radians(-40), HIGH.name: radians(60), ROW_SHARE.name: 1.0, COLUMNS.name: 3600, FARTHEST.name: 600.0},
        1000,
    ),
    "SOLID_STATE": Device(
        "Solid State", "An even grid, 120 by 25 degrees, of a sensor without a head",
        {
            LOW.name: radians(-12.5), HIGH.name: radians(12.5), SWEEP.name: 2 * pi / 3, AZIMUTHS.name: "-60",
            COLUMNS.name: 600, FARTHEST.name: 200.0,
        },
        125,
    ),
}  # fmt: skip
"""The devices by their keys, in the order of the menu."""

DEVICE = Choice(
    "scanner_device", "Device", "A scanner whose beams, timing and range are known",
    CUSTOM,
    (
        Item(CUSTOM, "Custom", "By the settings, or by a calibration file", 0),
        *(Item(key, device.label, device.text, number) for number, (key, device) in enumerate(DEVICES.items(), 1)),
    ),
)  # fmt: skip
