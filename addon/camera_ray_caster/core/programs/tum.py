"""Trajectories of the TUM benchmarks: lines of seconds, x, y, z and the quaternion x, y, z, w, apart by spaces.

So are read those of TartanAir, without times, one for each frame. Names of the columns in a comment count: see
``parts.trajectory``. A pose leads from the moving frame to the world; written, from the camera, x right, y down, z
ahead. Frame 0 is at 0 seconds.
Reference: TUM RGB-D benchmark, File Formats.
"""

from ..maths.rotations import quaternion
from ..units import METERS
from .parts.document import Document
from .parts.program import CameraRecord, FileWriter, ProgramFiles, line_by_line
from .parts.trajectory import columns_of, has_commas_in, placed_in_lines

ENDING = "_tum.txt"
HEAD = "# timestamp tx ty tz qx qy qz qw\n"


def looks(document: Document) -> bool:
    return columns_of(document) is not None and not has_commas_in(document)


def _line(record: CameraRecord) -> str:
    w, *vector = quaternion(record.pose[:3, :3]).tolist()
    return " ".join(map(repr, (record.seconds, *record.pose[:3, 3].tolist(), *vector, w)))


PROGRAM = ProgramFiles(
    "TUM", "trajectories .txt", looks, lost="lenses", poses=placed_in_lines, unit=METERS,
    columns="8, the last 4 a quaternion (TartanAir 7)",
    export=FileWriter(
        "tum", "TUM Trajectory", "<camera>_tum.txt: seconds, places and quaternions of any camera",
        line_by_line(ENDING, _line, HEAD), ending=ENDING,
    ),
)  # fmt: skip
