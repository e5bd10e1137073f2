"""nuScenes' calibrated_sensor.json: a list of sensors with pose and, of cameras, a matrix; pictures are undistorted.

The pose leads from the camera, x right, y down, z ahead, to the vehicle: rotation is w, x, y, z. Cameras are named by
their token; other sensors are left out. The center of the first pixel is (0, 0).
Reference: nuScenes documentation, Schema: calibrated_sensor.
"""

import numpy as np

from ..units import METERS
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import FRAME_SIZE, Lens
from .parts.placed import of_quaternion
from .parts.plain import of_matrix
from .parts.program import ProgramFiles, of_cameras


def looks(document: Document) -> bool:
    sensors = document.entries.named().values()
    return bool(sensors) and all(sensor.has("sensor_token", "camera_intrinsic", "rotation") for sensor in sensors)


def _cameras(document: Document) -> list[Fields]:
    sensors = document.entries.named().values()
    return [sensor.labeled(sensor.text("token")) for sensor in sensors if sensor.count_of("camera_intrinsic")]


def _lens(camera: Fields) -> Lens:
    return of_matrix(camera, "camera_intrinsic", "camera_distortion", dict(FRAME_SIZE))


def _pose(camera: Fields) -> np.ndarray:
    turn, translation = camera.numbers("rotation", 4), camera.numbers("translation", 3)
    return of_quaternion(camera.document, turn, translation, camera.label)


PROGRAM = ProgramFiles(
    "nuScenes", "calibrated_sensor.json", looks, marks="token sensor_token translation rotation camera_intrinsic",
    reads="pinhole", lost="the size of the pictures, 1600 x 900", unit=METERS,
    **of_cameras(_cameras, _lens, _pose),
)  # fmt: skip
