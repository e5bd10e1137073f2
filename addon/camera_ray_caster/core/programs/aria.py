"""The calibration of Project Aria's glasses, as JSON: cameras by their labels, in a file or in each of its lines.

The center of the first pixel is (0, 0). The file does not give the size of the pictures: the frame must have that size.
T_Device_Camera leads from the camera to the device.
Reference: Project Aria documentation, Camera Intrinsic Models for Project Aria devices.
"""

from ..units import METERS
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import ARIA_TERMS, FRAME_SIZE, Lens, matrix, one_of_several
from .parts.placed import Placed, of_quaternion
from .parts.program import ProgramFiles

MODELS = {
    "FisheyeRadTanThinPrism": ("FISHEYE624", ARIA_TERMS),
    "KannalaBrandtK3": ("OPENCV_FISHEYE", ("k1", "k2", "k3", "k4")),
    "Linear": ("OPENCV_PINHOLE", ()),
}
"""Our model, and the settings that follow the center. Of a FISHEYE624 there is one focal length, else there are two."""


def looks(document: Document) -> bool:
    return document.entries.has("CameraCalibrations") or bool(_cameras(document))


def read(document: Document) -> list[Lens] | None:
    """See ProgramFiles. Lenses of several lines are further inside."""
    if not document.entries.has("CameraCalibrations"):
        return None
    return [one_of_several(camera.label, _lens, camera) for camera in _cameras(document)]


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles: in the device; of several lines the first."""
    placed = []
    for camera in _cameras(document):
        pose = camera.part("T_Device_Camera")
        turn, translation = pose.matrix("UnitQuaternion", 4), pose.numbers("Translation", 3)
        placed.append(Placed(camera.label, "", None, of_quaternion(document, turn, translation, camera.label)))
    return placed


def _cameras(document: Document) -> list[Fields]:
    entries = document.entries
    if not entries.has("CameraCalibrations"):
        entries = next(iter(entries.named().values()), entries)
    return [camera.labeled(camera.text("Label")) for camera in entries.parts("CameraCalibrations")]


def _lens(camera: Fields) -> Lens:
    projection = camera.part("Projection")
    kind = camera.document.one_of(projection.text("Name"), f"Projection of {camera.label!r}", MODELS)
    model, terms = MODELS[kind]
    count = 1 if model == "FISHEYE624" else 2
    numbers = projection.numbers("Params", count + 2 + len(terms))
    focal, center, coefficients = numbers[:count], numbers[count : count + 2], numbers[count + 2 :]
    settings = matrix(focal[0], focal[-1], *center) | dict(zip(terms, coefficients, strict=True))
    return Lens(camera.label, model, FRAME_SIZE | settings)


PROGRAM = ProgramFiles(
    "Project Aria", "calibration .json, online_calibration.jsonl", looks,
    marks="CameraCalibrations Label Projection Params", reads="FisheyeRadTanThinPrism, KannalaBrandtK3, Linear",
    lost="the size of the pictures", read=read, poses=poses, unit=METERS,
)  # fmt: skip
