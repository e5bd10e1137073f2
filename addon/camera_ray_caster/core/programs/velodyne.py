"""Velodyne's calibration of a unit, as the YAML of its driver: a mapping for each laser.

Angles are in radians; rot_correction is subtracted from the azimuth. The origin of a laser lies vert_offset_correction
above and horiz_offset_correction to the left of the center: the point of a range R is origin + R direction. The files
do not tell when lasers fire: it is that of the device with as many lasers, of 64 that of the S3. What corrects measured
ranges is not needed for true ones: dist_correction, and dist_correction_x and _y, which bend rays below 25 m, are not
read.
References: velodyne_pointcloud, gen_calibration; Velodyne, HDL-64E S3 User Manual, appendix F.
"""

from math import degrees
from typing import Any

from ..cameras.parts.devices import HDL_32E, VLP_16, VLP_32C, numbers_as_text
from ..cameras.parts.scanners import AZIMUTHS, DELAYS, ELEVATIONS, PERIOD, RIGHT, UP
from .parts.document import Document
from .parts.lens import Lens
from .parts.program import ProgramFiles

S3 = {
    DELAYS.name: numbers_as_text([7.2 * (k % 32 // 4) + (0, 1.3, 2.5, 3.7)[k % 4] for k in range(64)]),
    PERIOD.name: 57.6,
}  # fmt: skip
VLS_128 = {DELAYS.name: numbers_as_text([2.665 * (k // 8) for k in range(128)]), PERIOD.name: 53.3}
TIMING = {16: VLP_16, 32: HDL_32E, 64: S3, 128: VLS_128}


def looks(document: Document) -> bool:
    lasers = document.entries.parts("lasers")
    return bool(lasers) and lasers[0].has("vert_correction")


def read(document: Document) -> list[Lens]:
    entries = document.entries
    numbered = [(laser.number("laser_id"), laser) for laser in entries.parts("lasers")]
    numbered.sort(key=lambda pair: pair[0])
    count = len(numbered)
    if [number for number, _ in numbered] != list(range(count)):
        raise document.refusal(f"the laser_id of its {count} lasers are not 0 to {count - 1}, each once")

    def each(name: str, default: float | None = None) -> list[float]:
        return [laser.number(name, default) for _, laser in numbered]

    turned = each("rot_correction")
    if entries.number("num_lasers", count) != count:
        raise document.refusal(f"num_lasers is {entries.text('num_lasers')}, and it has {count} lasers")
    timing: dict[str, Any] = VLP_32C if count == 32 and any(turned) else TIMING.get(count, {})
    return [Lens("", "SCANNER", {name: timing[name] for name in (DELAYS.name, PERIOD.name) if name in timing} | {
        ELEVATIONS.name: numbers_as_text([degrees(angle) for angle in each("vert_correction")]),
        AZIMUTHS.name: numbers_as_text([-degrees(angle) for angle in turned]),
        RIGHT.name: numbers_as_text([-length for length in each("horiz_offset_correction", 0.0)]),
        UP.name: numbers_as_text(each("vert_offset_correction", 0.0)),
    })]  # fmt: skip


PROGRAM = ProgramFiles(
    "Velodyne", "calibrations of velodyne_pointcloud as .yaml", looks,
    marks="lasers laser_id rot_correction vert_correction num_lasers",
    reads="lasers, with angles and offsets, as scanners",
    lost="when lasers fire, which is that of the device; corrections of ranges", read=read,
)  # fmt: skip
