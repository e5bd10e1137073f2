"""The sensor.yaml of EuRoC's and Kimera's data sets: one camera in the words of ``parts.camchain``.

T_BS leads from the camera to the body. The center of the first pixel is (0, 0).
References: The EuRoC MAV dataset, Data format. Kimera-VIO documentation.
"""

from ..units import METERS
from .parts.camchain import is_camera, lens_of
from .parts.document import Document
from .parts.lens import Lens
from .parts.placed import Placed, pose_in
from .parts.program import ProgramFiles


def looks(document: Document) -> bool:
    return is_camera(document.entries)


def read(document: Document) -> list[Lens]:
    return [lens_of(document.entries, "")]


def poses(document: Document) -> list[Placed]:
    return [Placed("", "", None, pose_in(document.entries, "T_BS"))]


PROGRAM = ProgramFiles(
    "EuRoC", "sensor.yaml, of Kimera, too", looks,
    marks="sensor_type T_BS rate_hz camera_model intrinsics distortion_coefficients",
    reads="pinhole with radial-tangential (4 or 5) or equidistant", read=read, poses=poses, unit=METERS,
)  # fmt: skip
