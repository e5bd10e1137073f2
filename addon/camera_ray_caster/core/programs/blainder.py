"""Presets of BLAINDER's range scanner, .yaml: a list of scanners by name, angles in degrees.

A rotating scanner has the rays of a grid with both ends of each field of view. Pixels of a static one are even on a
plane, the outermost at the ends of fovX, and as far along y as fovY is of fovX.
Reference: S. Reitmann et al., BLAINDER: A Blender AI Add-On for Generation of Semantically Labeled Depth-Sensing Data
(2021), and its presets.
"""

from math import radians, tan

import numpy as np

from ..cameras.parts.devices import numbers_as_text
from ..cameras.parts.scanners import AZIMUTHS, COLUMNS, ELEVATIONS, FARTHEST, RATE, SWEEP
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens, matrix
from .parts.program import ProgramFiles, of_cameras

MOST_BEAMS = 4096
"""Beams of a scanner."""


def looks(document: Document) -> bool:
    presets = document.entries.named().values()
    return any(preset.has("name", "category", "type", "distanceUpper") for preset in presets)


def _presets(document: Document) -> list[Fields]:
    return [preset.labeled(preset.text("name")) for preset in document.entries.named().values()]


def _lens(preset: Fields) -> Lens:
    document, kind = preset.document, preset.word("type", ("rotating", "static"))
    across, up = preset.number("fovX"), preset.number("fovY")
    if not (0 < across <= 360 and 0 < up <= 180) or (kind == "static" and max(across, up) >= 180):
        raise document.refusal(f"fovX and fovY of {preset.label} must be above 0, up to 360 and 180 degrees")
    if kind == "static":
        width, height = (int(preset.number(f"resolution{axis}") * preset.number("resolutionPercentage", 100.0) / 100)
                         for axis in "XY")  # fmt: skip
        if min(width, height) < 2:
            raise document.refusal(f"resolutionX and resolutionY of {preset.label} must be 2 or more")
        half = tan(radians(max(across, up) / 2)) / max(across, up)
        focal = ((width - 1) / (2 * half * across), (height - 1) / (2 * half * up))
        middle = matrix(*focal, (width - 1) / 2, (height - 1) / 2)
        return Lens(preset.label, "OPENCV_PINHOLE", document.size(width, height) | middle)
    steps = preset.number("xStepDegree"), preset.number("yStepDegree")
    if min(steps) <= 0 or up / steps[1] > MOST_BEAMS or across / steps[0] > 1 << 20:
        raise document.refusal(f"xStepDegree and yStepDegree of {preset.label} must be above 0, and not so small")
    columns, rows = int(across / steps[0] + 1), int(up / steps[1] + 1)
    sweep = radians(across * columns / max(1, columns - 1))
    return Lens(preset.label, "SCANNER", {
        ELEVATIONS.name: numbers_as_text(np.linspace(-up / 2, up / 2, rows).tolist()), SWEEP.name: sweep,
        AZIMUTHS.name: repr(-across / 2), COLUMNS.name: columns, RATE.name: preset.number("rotationsPerSecond", 10.0),
        FARTHEST.name: preset.number("distanceUpper", 0.0),
    })  # fmt: skip


PROGRAM = ProgramFiles(
    "BLAINDER", "presets.yaml of its range scanner", looks,
    marks="category fovX fovY xStepDegree yStepDegree rotationsPerSecond distanceUpper",
    reads="rotating scanners; static ones as pinholes", lost="reflectivities; side-scan sonars are refused",
    **of_cameras(_presets, _lens),
)  # fmt: skip
