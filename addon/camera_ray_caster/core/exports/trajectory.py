"""Trajectories: the poses of each camera by frame, from its frame, x right, y down, z ahead, to the world, in meters.

TUM: seconds, x, y, z and the quaternion x, y, z, w. KITTI: the first three rows of the matrix. EuRoC: nanoseconds, x,
y, z and the quaternion w, x, y, z, as its ground truth has them. Frame 0 is at 0 seconds.
References: TUM RGB-D benchmark, File Formats; KITTI odometry, devkit; The EuRoC MAV dataset, Data format.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..maths.rotations import quaternion
from ..units import METERS
from .format import OWN_TIMES, Format, Shot


class Trajectory(Format):
    """One file per camera."""

    rigid = True
    unit = METERS
    formula = False

    def __init__(self, key: str, label: str, description: str, ending: str, line: Callable[[Shot, np.ndarray], str],
                 head: str = ""):  # fmt: skip
        self.key, self.label, self.description = key, label, description  # type: ignore[misc]
        self.ending, self.line, self.head = ending, line, head

    def refusal(self, shot):
        """See Format."""
        return None if shot.camera.pixel_time is None else OWN_TIMES

    def omissions(self, shot):
        """See Format."""
        return []

    def files(self, shots):
        """See Format."""
        for name in dict.fromkeys(shot.name for shot in shots):
            own = [(shot, _pose(shot)) for shot in shots if shot.name == name]
            yield f"{name}{self.ending}", self.head + "".join(f"{self.line(shot, pose)}\n" for shot, pose in own)


def _pose(shot: Shot) -> np.ndarray:
    """Return the matrix (3, 4) from a camera's frame to the world."""
    pose = shot.camera.pose
    return np.column_stack((pose.basis * (1, -1, -1), pose.eye))


def _tum(shot: Shot, pose: np.ndarray) -> str:
    w, *rest = quaternion(pose[:, :3]).tolist()
    return " ".join(map(repr, (shot.seconds, *pose[:, 3].tolist(), *rest, w)))


def _kitti(shot: Shot, pose: np.ndarray) -> str:
    return " ".join(map(repr, pose.ravel().tolist()))


def _euroc(shot: Shot, pose: np.ndarray) -> str:
    numbers = (*pose[:, 3].tolist(), *quaternion(pose[:, :3]).tolist())
    return ",".join((str(round(shot.seconds * 1e9)), *map(repr, numbers)))


TUM = Trajectory("tum", "TUM Trajectory", "<camera>_tum.txt: seconds, places and quaternions of any camera",
                 "_tum.txt", _tum, "# timestamp tx ty tz qx qy qz qw\n")  # fmt: skip
KITTI = Trajectory("kitti", "KITTI Poses", "<camera>_kitti.txt: a matrix for each frame, of any camera",
                   "_kitti.txt", _kitti)  # fmt: skip
EUROC = Trajectory("euroc", "EuRoC Trajectory", "<camera>_euroc.csv: nanoseconds, places and quaternions of any camera",
                   "_euroc.csv", _euroc, "#timestamp [ns],p_x,p_y,p_z,q_w,q_x,q_y,q_z\n")  # fmt: skip
