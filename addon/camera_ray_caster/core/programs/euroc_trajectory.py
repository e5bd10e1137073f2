"""Trajectories of EuRoC's ground truth: lines of nanoseconds, x, y, z and the quaternion w, x, y, z, apart by commas.

What follows in a line is not read. Names of the columns in the first line count: see ``parts.trajectory``. A pose leads
from the moving frame to the world; written, from the camera, x right, y down, z ahead. Frame 0 is at 0 seconds.
Reference: The EuRoC MAV dataset, Data format.
"""

from ..maths.rotations import quaternion
from ..units import METERS
from .parts.document import Document
from .parts.program import CameraRecord, FileWriter, ProgramFiles, line_by_line
from .parts.trajectory import columns_of, has_commas_in, placed_in_lines

ENDING = "_euroc.csv"
HEAD = "#timestamp [ns],p_x,p_y,p_z,q_w,q_x,q_y,q_z\n"


def looks(document: Document) -> bool:
    return has_commas_in(document) and columns_of(document) is not None


def _line(record: CameraRecord) -> str:
    numbers = (*record.pose[:3, 3].tolist(), *quaternion(record.pose[:3, :3]).tolist())
    return ",".join((str(round(record.seconds * 1e9)), *map(repr, numbers)))


PROGRAM = ProgramFiles(
    "EuRoC trajectories", ".csv", looks, lost="lenses", poses=placed_in_lines, unit=METERS,
    columns="at least 8 apart by commas",
    export=FileWriter(
        "euroc", "EuRoC Trajectory", "<camera>_euroc.csv: nanoseconds, places and quaternions of any camera",
        line_by_line(ENDING, _line, HEAD), ending=ENDING,
    ),
)  # fmt: skip
