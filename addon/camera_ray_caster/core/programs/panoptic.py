"""CMU Panoptic's calibration_*.json: cameras with K, distCoef, R and t.

R and t lead from the world, in centimeters, to the camera, x right, y down, z ahead. The center of the first pixel is
(0, 0), and coefficients are OpenCV's.
Reference: CMU Panoptic Studio toolbox.
"""

import numpy as np

from ..units import CENTIMETERS
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens
from .parts.placed import inverted, of_rotation
from .parts.plain import of_matrix
from .parts.program import ProgramFiles, of_cameras


def looks(document: Document) -> bool:
    cameras = document.entries.parts("cameras")
    return bool(cameras) and all(camera.has("K", "distCoef", "R", "t") for camera in cameras)


def _cameras(document: Document) -> list[Fields]:
    cameras = enumerate(document.entries.parts("cameras"))
    return [camera.labeled(camera.text("name", f"camera {i}")) for i, camera in cameras]


def _lens(camera: Fields) -> Lens:
    return of_matrix(camera, "K", "distCoef", camera.size("resolution"))


def _pose(camera: Fields) -> np.ndarray:
    turn, translation = camera.matrix("R", 9), camera.matrix("t", 3)
    return inverted(of_rotation(camera.document, turn, translation, camera.said("R")))


PROGRAM = ProgramFiles(
    "CMU Panoptic", "calibration_*.json", looks, marks="calibDataSource cameras panel node K distCoef R t resolution",
    reads="pinhole", unit=CENTIMETERS, **of_cameras(_cameras, _lens, _pose),
)  # fmt: skip
