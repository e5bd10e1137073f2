"""Ouster's sensor metadata, JSON: of firmware 1 flat ("legacy"), later in parts such as beam_intrinsics.

Angles are in degrees, from the top row down; lengths in millimeters. The frame is the sensor's. A row has its own
azimuth, and all beams of a column fire at once: row and column are those of the sensor's packets, not destaggered.
The range that the sensor reports begins behind the beam's origin, by the distance from the axis: ranges here begin at
the origin. Sensors without a turning head, of the DF series, are refused.
Reference: Ouster, Firmware User Manual, Sensor Metadata, and Sensor Coordinate Frames.
"""

import re
from math import hypot

from ..cameras.parts.devices import ouster
from ..cameras.parts.scanners import COLUMNS, RATE
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens
from .parts.program import ProgramFiles

MODE = re.compile(r"(512|1024|2048|4096)x(5|10|20)")
PARTS = "beam_intrinsics", "lidar_intrinsics", "lidar_data_format", "data_format", "config_params"
MILLIMETER = 1e-3


HALF_TURN = [-1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 36.18, 0.0, 0.0, 0.0, 1.0]
"""The lidar's frame in the sensor's, of files that do not tell it."""

OLDEST = 12.163
"""Distance of the beams' origins from the axis in sensors whose files do not tell it, millimeters."""


def looks(document: Document) -> bool:
    return _all(document).has("beam_altitude_angles", "beam_azimuth_angles")


def read(document: Document) -> list[Lens]:
    entries = _all(document)
    altitudes = entries.numbers("beam_altitude_angles")
    azimuths = entries.numbers("beam_azimuth_angles", len(altitudes))
    mode = entries.text("lidar_mode")
    if not MODE.fullmatch(mode):
        raise document.refusal(f"lidar_mode is {mode!r}: it must be like '1024x10'")
    columns, rate = map(float, mode.split("x"))
    columns = entries.number("columns_per_frame", columns)
    if entries.number("pixels_per_column", len(altitudes)) != len(altitudes):
        raise document.refusal(f"pixels_per_column is not the number of its beams, {len(altitudes)}")
    if entries.has("beam_to_lidar_transform"):
        matrix = entries.numbers("beam_to_lidar_transform", 16)
        radius, up = matrix[3], matrix[11]
    else:
        radius, up = entries.number("lidar_origin_to_beam_origin_mm", OLDEST), 0.0
    to_sensor = entries.numbers("lidar_to_sensor_transform", 16, HALF_TURN)
    if hypot(*(a - b for a, b in zip(to_sensor[:11], HALF_TURN[:11], strict=True))) > 1e-9:
        raise document.refusal("lidar_to_sensor_transform is not half a turn about z and a height, which is not read")
    tables = ouster(altitudes, azimuths, radius * MILLIMETER, (up + to_sensor[11]) * MILLIMETER)
    name = document.entries.part("sensor_info").text("prod_line") or document.entries.text("prod_line")
    return [Lens(name, "SCANNER", tables | {COLUMNS.name: columns, RATE.name: rate})]


def _all(document: Document) -> Fields:
    """Return the entries of a flat file, or of all parts of a file."""
    entries = document.entries
    for name in PARTS:
        entries = entries.merged(document.entries.part(name))
    return entries


PROGRAM = ProgramFiles(
    "Ouster", "metadata .json of all firmware", looks,
    marks="beam_altitude_angles beam_azimuth_angles lidar_mode beam_intrinsics lidar_intrinsics",
    reads="beams, their origins, columns and rate, as scanners", lost="sensors without a turning head are refused",
    read=read,
)  # fmt: skip
