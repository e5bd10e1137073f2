"""The cameras of NVIDIA NCore and 3DGUT, as JSON: sensors by name, with a camera_model_type and T_sensor_rig.

What a lens has stands in ``intrinsics``, or in ``camera_model_parameters`` with its resolution. Pixels of OpenCV's
models count from the picture's corner, so that half the width is the middle; those of ftheta as in ``nvidia``.
Reference: NVIDIA NCore documentation, Sensor Models.
"""

from ..units import METERS
from . import nvidia
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens, matrix, one_of_several
from .parts.placed import Placed, pose_in
from .parts.program import ProgramFiles

KIND, POSE = "camera_model_type", "T_sensor_rig"
PINHOLE = {
    "radial_coeffs": ("k1", "k2", "k3", "k4", "k5", "k6"), "tangential_coeffs": ("p1", "p2"),
    "thin_prism_coeffs": ("s1", "s2", "s3", "s4"),
}  # fmt: skip
MODELS: dict[str, tuple[str, dict[str, tuple[str, ...]]]] = {
    "opencv-pinhole": ("OPENCV_PINHOLE", PINHOLE),
    "opencv-fisheye": ("OPENCV_FISHEYE", {"radial_coeffs": ("k1", "k2", "k3", "k4")}),
}
"""Our model, and the settings that the numbers of each entry are."""


def looks(document: Document) -> bool:
    return any(sensor.has(KIND) for sensor in _sensors(document).values())


def _sensors(document: Document) -> dict[str, Fields]:
    return {"": document.entries} if document.entries.has(KIND) else document.entries.named()


def read(document: Document) -> list[Lens]:
    sensors = {name: sensor for name, sensor in _sensors(document).items() if sensor.has(KIND)}
    return [one_of_several(name, _lens, sensor.labeled(name)) for name, sensor in sensors.items()]


def _lens(sensor: Fields) -> Lens:
    kind = sensor.word(KIND, ("ftheta", *MODELS))
    inside = sensor.merged(sensor.part("camera_model_parameters")).merged(sensor.part("intrinsics"))
    if kind == "ftheta":
        return nvidia.of_parameters(inside)
    model, terms = MODELS[kind]
    fx, fy, cx, cy = *inside.numbers("focal_length", 2), *inside.numbers("principal_point", 2)
    settings = inside.size("resolution") | matrix(fx, fy, cx, cy, 0.5)
    for entry, names in terms.items():
        settings |= dict(zip(names, inside.numbers(entry, len(names), [0.0] * len(names)), strict=True))
    return Lens(sensor.label, model, settings)


def poses(document: Document) -> list[Placed]:
    sensors = _sensors(document).items()
    return [Placed(name, "", None, pose_in(sensor.labeled(name), POSE)) for name, sensor in sensors if sensor.has(POSE)]


PROGRAM = ProgramFiles(
    "NVIDIA NCore", "sensors as .json", looks,
    marks="camera_model_type resolution T_sensor_rig intrinsics principal_point focal_length radial_coeffs",
    reads="f-theta, opencv-pinhole, opencv-fisheye", lost="windshields are refused", read=read, poses=poses,
    unit=METERS,
)  # fmt: skip
