"""Trajectories of the TUM benchmarks: lines of seconds, x, y, z and the quaternion x, y, z, w, apart by spaces.

A pose leads from the moving frame to the world; written, from the camera, x right, y down, z ahead. Frame 0 is at 0
seconds.
Reference: TUM RGB-D benchmark, File Formats.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..maths.rotations import quaternion
from ..units import METERS
from .parts.document import Document
from .parts.placed import Placed, of_quaternion
from .parts.program import CameraRecord, FileWriter, ProgramFiles
from .parts.trajectory import check_commas, rows_of

NANOSECONDS = 1e12
"""Times above it are in nanoseconds: as seconds it would be 30,000 years."""
HEAD = "# timestamp tx ty tz qx qy qz qw\n"


def looks(document: Document) -> bool:
    """See ProgramFiles."""
    return rows_of(document, 8, commas=False) is not None


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles."""
    check_commas(document)
    placed = []
    for number, row in enumerate(rows_of(document, 8, commas=False) or (), 1):
        document.check()
        time, x, y, z, *turn, w = document.numbers(row, f"pose {number}", 8)
        pose = of_quaternion(document, [w, *turn], [x, y, z], f"pose {number}")
        placed.append(Placed("", "", None, pose, time / 1e9 if time > NANOSECONDS else time))
    return placed


def write(records: Sequence[CameraRecord]) -> Iterator[tuple[str, str]]:
    """See FileWriter. One file per camera."""
    for name in dict.fromkeys(record.name for record in records):
        lines = [_line(record) for record in records if record.name == name]
        yield f"{name}_tum.txt", HEAD + "".join(lines)


def _line(record: CameraRecord) -> str:
    w, *rest = quaternion(record.pose[:3, :3]).tolist()
    return " ".join(map(repr, (record.seconds, *record.pose[:3, 3].tolist(), *rest, w))) + "\n"


PROGRAM = ProgramFiles(
    "TUM", "trajectories .txt", looks, lost="lenses", poses=poses, unit=METERS,
    export=FileWriter(
        "tum", "TUM Trajectory", "<camera>_tum.txt: seconds, places and quaternions of any camera", write
    ),
)  # fmt: skip
