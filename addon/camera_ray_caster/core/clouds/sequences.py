"""The frames of a scanner as a sequence of odometry: poses.txt, calib.txt and times.txt beside the points.

poses.txt has the poses of a camera at the scanner, x right, y down, z ahead, relative to that of the first frame, in
meters.
calib.txt has Tr, the transformation from the scanner to that camera, and no lenses.
Reference: see ``programs.kitti``.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from ..camera.camera import Camera
from ..conventions import FROM_BLENDER
from ..units import METERS, UNIT_SCALE, factor
from .cloud_beams import FROM_CAMERA


def sequence(cameras: Sequence[Camera], seconds: Sequence[float]) -> Iterator[tuple[str, str]]:
    """Yield names and texts of the files of a sequence, given the camera and the time of each frame."""
    from_sensor = FROM_BLENDER.copy()
    from_sensor[:3, :3] = from_sensor[:3, :3] @ FROM_CAMERA.T
    poses = []
    for camera in cameras:
        pose = camera.world_from_camera
        pose[:3, 3] *= factor(METERS, camera.record.settings.get(UNIT_SCALE, 1.0))
        poses.append(pose @ FROM_BLENDER)
    first = np.linalg.inv(poses[0])
    yield "poses.txt", "".join(f"{_row(first @ pose)}\n" for pose in poses)
    yield "calib.txt", "".join(f"P{k}: {_row(np.eye(4))}\n" for k in range(4)) + f"Tr: {_row(from_sensor)}\n"
    yield "times.txt", "".join(f"{time - seconds[0]:.9e}\n" for time in seconds)


def _row(matrix: np.ndarray) -> str:
    return " ".join(f"{number:.12e}" for number in matrix[:3].ravel())
