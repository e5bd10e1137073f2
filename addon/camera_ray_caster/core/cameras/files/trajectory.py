"""Trajectories: lines of a time and a pose, as the TUM benchmarks and EuRoC's ground truth write them.

TUM: seconds, x, y, z and the quaternion x, y, z, w, apart by spaces. EuRoC: nanoseconds, x, y, z and the quaternion w,
x, y, z, apart by commas; what follows is not read. A pose is from the moving frame to the world.
References: TUM RGB-D benchmark, File Formats; The EuRoC MAV dataset, Data format.
"""

from __future__ import annotations

import re

from .document import Document
from .placed import Placed, of_quaternion

LINE = re.compile(r"\d[\d.eE+-]*([\s,]+[-+.\d]\S*){7}")
NANOSECONDS = 1e12
"""Times above it are in nanoseconds: as seconds it would be 30,000 years."""


def poses(document: Document) -> list[Placed] | None:
    """Return the poses of a trajectory in the order of the file, None of any other file. Raises InputError."""
    lines = [line.strip() for line in document.text.splitlines()]
    lines = [line for line in lines if line and not line.startswith("#")]
    if not lines or not LINE.match(lines[0]):
        return None
    placed = []
    for number, line in enumerate(lines, 1):
        document.check()
        is_euroc = "," in line
        numbers = document.numbers(re.split(r"[\s,]+", line)[:8], f"pose {number}", 8)
        time, place, turn = numbers[0], numbers[1:4], numbers[4:]
        time = time / 1e9 if is_euroc or time > NANOSECONDS else time
        turn = turn if is_euroc else [turn[3], *turn[:3]]
        placed.append(Placed("", "", None, of_quaternion(document, turn, place, f"pose {number}"), time))
    return placed
