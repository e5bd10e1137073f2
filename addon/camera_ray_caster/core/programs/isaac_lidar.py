"""Lidar profiles of Isaac Sim and Omniverse, .json: emitters with their angles, in degrees, and firing times.

Azimuths grow to the left, x ahead, z up. A rotary head fires its emitters reportRateBaseHz times a second: it is a
scanner. Emitters of a solid state are a list of rays; of several states each is that of a scan.
Reference: NVIDIA, Isaac Sim documentation, RTX Lidar: Sensor Profiles.
"""

from typing import Any

import numpy as np

from ..cameras.parts import scanners
from ..cameras.parts.devices import numbers_as_text
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens
from .parts.program import ProgramFiles, ScanPattern

ROTARY, SOLID = "rotary", "solidstate"
TURNS = {"cw": scanners.CLOCKWISE, "ccw": "COUNTERCLOCKWISE"}


def looks(document: Document) -> bool:
    return document.entries.part("profile").has("emitterStates", "scanType")


def _profile(document: Document, kind: str, instead: str) -> Fields:
    profile = document.entries.part("profile")
    scan_type = profile.text("scanType").lower().replace("_", "")
    if document.one_of(scan_type, "scanType", (ROTARY, SOLID)) != kind:
        raise document.refusal(f"its scanType is {profile.text('scanType')}: {instead}")
    return profile


def _state(state: Fields) -> tuple[list[float], ...]:
    """Return azimuths, elevations, nanoseconds, and heights of the emitters of a state."""
    azimuths = state.numbers("azimuthDeg")
    count = len(azimuths)
    zeros = [0.0] * count
    if any(state.numbers("horOffsetM", default=[0.0])):
        raise state.document.refusal("horOffsetM is not 0, which is not read")
    return (
        azimuths, state.numbers("elevationDeg", count), state.numbers("fireTimeNs", count, zeros),
        state.numbers("vertOffsetM", count, zeros),
    )  # fmt: skip


def read(document: Document) -> list[Lens]:
    profile = _profile(document, ROTARY, "its rays are read by scan(rays=FILE), in Python")
    states = profile.parts("emitterStates")
    if len(states) != 1:
        raise document.refusal(f"it has {len(states)} emitterStates: of a rotary head one is read")
    azimuths, elevations, times, heights = _state(states[0])
    rate, report = profile.number("scanRateBaseHz"), profile.number("reportRateBaseHz")
    angles = profile.number("startAzimuthDeg", 0.0), profile.number("endAzimuthDeg", 360.0)
    if rate <= 0 or report < rate or abs(angles[1] - angles[0]) != 360:
        raise document.refusal("it must report once a turn or more, of a whole turn: see scanRateBaseHz")
    turn = profile.text("rotationDirection", "CW").lower()
    tables: dict[str, Any] = {
        scanners.ELEVATIONS.name: numbers_as_text(elevations),
        scanners.AZIMUTHS.name: numbers_as_text([-angle for angle in azimuths]),
        scanners.DELAYS.name: numbers_as_text([time / 1000 for time in times]),
        scanners.UP.name: numbers_as_text(heights),
        scanners.RATE.name: rate,
        scanners.COLUMNS.name: round(report / rate),
        scanners.NEAREST.name: profile.number("nearRangeM", 0.0),
        scanners.FARTHEST.name: profile.number("farRangeM", 0.0),
        scanners.DIRECTION.name: TURNS[document.one_of(turn, "rotationDirection", TURNS)],
    }
    return [Lens(document.entries.text("name"), "SCANNER", tables)]


def rays(document: Document) -> ScanPattern:
    profile = _profile(document, SOLID, "load it as a calibration of a scanner")
    states, rate = profile.parts("emitterStates"), profile.number("scanRateBaseHz")
    if not states or rate <= 0:
        raise document.refusal("it has no emitterStates, or no scanRateBaseHz above 0")
    tables = [np.array(_state(state)) for state in states]
    rings = [state.numbers("channelId", len(table[0]), range(len(table[0])))
             for state, table in zip(states, tables, strict=True)]  # fmt: skip
    seconds = [number / rate + table[2] * 1e-9 for number, table in enumerate(tables)]
    azimuths, elevations, _, heights = np.concatenate(tables, axis=1)
    return ScanPattern(azimuths, elevations, np.concatenate(seconds), np.concatenate(rings), heights)


PROGRAM = ProgramFiles(
    "Isaac Sim lidars", "lidar profiles as .json", looks,
    marks="profile scanType emitterStates azimuthDeg elevationDeg fireTimeNs scanRateBaseHz",
    reads="rotary heads as scanners; emitters of solid states, for scan",
    lost="errors, powers and returns; several states of a rotary head are refused", read=read, rays=rays,
)  # fmt: skip
