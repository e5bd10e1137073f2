"""The cameras of OKVIS's settings, in YAML: a list with focal_length, principal_point and image_dimension.

The center of the first pixel is (0, 0). T_SC leads from the camera to the sensor.
Reference: OKVIS2 documentation, Configuration files and calibration.
"""

from ..units import METERS
from .parts.camchain import DISTORTIONS, bend_of
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens, matrix
from .parts.placed import pose_in
from .parts.program import ProgramFiles, of_cameras


def looks(document: Document) -> bool:
    cameras = document.entries.parts("cameras")
    return bool(cameras) and all(camera.has("focal_length") for camera in cameras)


def _cameras(document: Document) -> list[Fields]:
    return [camera.labeled(f"cam{number}") for number, camera in enumerate(document.entries.parts("cameras"))]


def _lens(camera: Fields) -> Lens:
    bend = bend_of(camera, "pinhole", "distortion_type")
    model, terms = DISTORTIONS["pinhole", bend] if bend != "none" else ("OPENCV_PINHOLE", ())
    focal, center = camera.numbers("focal_length", 2), camera.numbers("principal_point", 2)
    coefficients = camera.numbers("distortion_coefficients", len(terms)) if terms else []
    settings = matrix(*focal, *center) | dict(zip(terms, coefficients, strict=True))
    return Lens(camera.label, model, camera.size("image_dimension") | settings)


PROGRAM = ProgramFiles(
    "OKVIS", "its settings as .yaml", looks,
    marks="cameras T_SC image_dimension focal_length principal_point distortion_type",
    reads="pinhole with radialtangential, radialtangential8 or equidistant", unit=METERS,
    **of_cameras(_cameras, _lens, lambda camera: pose_in(camera, "T_SC")),
)  # fmt: skip
