"""Patterns of Livox's scanners, .csv of its simulators: a ray a line, with its time in seconds, its azimuth to the left
and its angle from the zenith, in degrees. The first line names the columns: Time/s, Azimuth/deg, Zenith/deg.

Reference: Livox, livox_laser_simulation, its scan_mode.
"""

import numpy as np

from .parts.document import Document
from .parts.program import ProgramFiles, ScanPattern

NAMES = "time", "azimuth", "zenith"


def looks(document: Document) -> bool:
    return not document.is_binary and set(NAMES) <= set(_head(document))


def _head(document: Document) -> list[str]:
    """Return the names of the columns without their units."""
    line = document.data[:200].decode("utf-8", "replace").lstrip("\ufeff# ").split("\n", 1)[0]
    return [word.split("/")[0].split("(")[0].strip().lower() for word in line.split(",")]


def rays(document: Document) -> ScanPattern:
    columns = [_head(document).index(name) for name in NAMES]
    lines = [line for line in document.text.splitlines()[1:] if line.strip() and not line.lstrip().startswith("#")]
    if not lines:
        raise document.refusal("it has no rays")
    try:
        table = np.loadtxt(lines, delimiter=",", usecols=columns, ndmin=2)
    except ValueError as error:
        raise document.refusal(f"its lines must have {len(_head(document))} numbers: {error}") from error
    if not np.isfinite(table).all():
        raise document.refusal("it has numbers that are not finite")
    seconds, azimuth, zenith = table.T
    return ScanPattern(azimuth, 90 - zenith, seconds)


PROGRAM = ProgramFiles(
    "Livox", "patterns of livox_laser_simulation as .csv", looks, marks="Time/s Azimuth/deg Zenith/deg",
    reads="rays with times, for scan", lost="the number of each ray's line", rays=rays, endings=(".csv",),
)  # fmt: skip
