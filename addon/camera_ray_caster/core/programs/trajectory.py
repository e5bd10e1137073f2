"""Trajectories: lines of a time and a pose, as the TUM benchmarks, EuRoC's ground truth and ARKitScenes write them.

TUM: seconds, x, y, z and the quaternion x, y, z, w, apart by spaces. EuRoC: nanoseconds, x, y, z and the quaternion w,
x, y, z, apart by commas; what follows is not read. A pose is from the moving frame to the world. ARKitScenes (.traj):
seconds, axis times angle, and x, y, z, from the world to the camera.
References: TUM RGB-D benchmark, File Formats; The EuRoC MAV dataset, Data format; ARKitScenes, tenFpsDataLoader.
"""

from __future__ import annotations

import re
from reprlib import repr as shortened

import numpy as np

from ..maths.rotations import rotation
from .parts.document import Document
from .parts.placed import Placed, inverted, of_quaternion

LINE = re.compile(r"\d[\d.eE+-]*([\s,]+[-+.\d]\S*){6,}")
NANOSECONDS = 1e12
"""Times above it are in nanoseconds: as seconds it would be 30,000 years."""


def poses(document: Document) -> list[Placed] | None:
    """Return the poses of a trajectory in the order of the file, None of any other file. Raises InputError."""
    lines = [line.strip() for line in document.text.splitlines()]
    lines = [line for line in lines if line and not line.startswith("#")]
    if not lines or not LINE.match(lines[0]):
        return None
    words = [re.split(r"[\s,]+", line) for line in lines]
    if "," not in lines[0] and len(words[0]) > 8:
        raise document.refusal(f"its lines have {len(words[0])} numbers: those of TUM's trajectories have 8, of "
                               "ARKitScenes 7, of KITTI 12, of EuRoC at least 8 apart by commas")  # fmt: skip
    if len(words[0]) == 7:
        return [_of_arkit(document, number, line) for number, line in enumerate(words, 1)]
    placed, is_euroc = [], "," in lines[0]
    for number, (line, word) in enumerate(zip(lines, words, strict=True), 1):
        document.check()
        if is_euroc != ("," in line):
            raise document.refusal(f"pose {number} is {shortened(line)}: all lines must have commas, or none")
        numbers = document.numbers(word[:8] if is_euroc else word, f"pose {number}", 8)
        time, place, turn = numbers[0], numbers[1:4], numbers[4:]
        time = time / 1e9 if is_euroc or time > NANOSECONDS else time
        turn = turn if is_euroc else [turn[3], *turn[:3]]
        placed.append(Placed("", "", None, of_quaternion(document, turn, place, f"pose {number}"), time))
    return placed


def _of_arkit(document: Document, number: int, words: list[str]) -> Placed:
    document.check()
    time, *rest = document.numbers(words, f"pose {number}", 7)
    to_camera = np.eye(4)
    to_camera[:3, :3] = rotation(np.array([rest[:3]]))[0]
    to_camera[:3, 3] = rest[3:]
    return Placed("", "", None, inverted(to_camera), time)
