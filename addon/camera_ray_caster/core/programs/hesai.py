"""Hesai's angle correction files, CSV: a channel, its elevation and its azimuth in a line, degrees.

The first line names the columns, after a line EEFF,1,1 in some files. Channels count from 1. The azimuth is added to
the head's. All beams leave the center. The files tell neither columns nor times: all beams of a column fire at once,
and columns are those of 10 sweeps a second, 2000 of up to 32 channels and 1800 of more.
Reference: Hesai, Pandar128 and PandarXT User Manuals, Channel Distribution.
"""

from ..cameras.parts.devices import numbers_as_text
from ..cameras.parts.scanners import AZIMUTHS, COLUMNS, ELEVATIONS
from .parts.document import Document
from .parts.lens import Lens, numbers_of
from .parts.program import ProgramFiles

HEADS = ["channel", "elevation", "azimuth"], ["laser id", "elevation", "azimuth"]
FEW = 32
"""Number of channels of the sensors with a step of 0.18 degrees, not 0.2."""


def looks(document: Document) -> bool:
    return b"levation" in document.data[:256] and _head(_lines(document)) is not None


def read(document: Document) -> list[Lens]:
    lines, rows = _lines(document), []
    for line in lines[(_head(lines) or 0) + 1 :]:
        document.check()
        numbers = numbers_of(line[:3])
        if len(numbers) != 3:
            raise document.refusal(f"line {', '.join(line)[:60]!r} is not a channel, an elevation and an azimuth")
        rows.append(numbers)
    if not rows:
        raise document.refusal("it has no channels")
    rows.sort()
    if [channel for channel, *_ in rows] != list(range(1, len(rows) + 1)):
        raise document.refusal(f"its {len(rows)} channels are not 1 to {len(rows)}, each once")
    _, elevations, azimuths = zip(*rows, strict=True)
    return [Lens("", "SCANNER", {
        ELEVATIONS.name: numbers_as_text(elevations), AZIMUTHS.name: numbers_as_text(azimuths),
        COLUMNS.name: 2000 if len(rows) <= FEW else 1800,
    })]  # fmt: skip


def _lines(document: Document) -> list[list[str]]:
    return [[cell.strip() for cell in line.split(",")] for line in document.text.splitlines() if line.strip(" ,")]


def _head(lines: list[list[str]]) -> int | None:
    return next((k for k, line in enumerate(lines[:2]) if [cell.lower() for cell in line[:3]] in HEADS), None)


PROGRAM = ProgramFiles(
    "Hesai", "angle corrections .csv", looks, marks="channel elevation azimuth", reads="channels, as scanners",
    lost="columns and times", read=read,
)  # fmt: skip
