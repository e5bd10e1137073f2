"""Basalt's calibration, as JSON: value0 with a list of intrinsics and a list of resolutions, by the cameras' numbers.

The center of the first pixel is (0, 0). Basalt's unified camera, ucm, is the enhanced one with beta = 1. T_imu_cam
leads from the camera to the IMU.
References: V. Usenko, N. Demmel and D. Cremers, The Double Sphere Camera Model (2018); Basalt documentation,
Calibration.
"""

from ..units import METERS
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens, matrix, one_of_several
from .parts.placed import Placed, of_quaternion
from .parts.program import ProgramFiles

MODELS = {
    "ds": ("DOUBLE_SPHERE", {"xi": "unified_xi", "alpha": "unified_alpha"}),
    "eucm": ("EUCM", {"alpha": "unified_alpha", "beta": "unified_beta"}),
    "ucm": ("EUCM", {"alpha": "unified_alpha"}),
    "kb4": ("OPENCV_FISHEYE", {name: name for name in ("k1", "k2", "k3", "k4")}),
    "pinhole": ("OPENCV_PINHOLE", {}),
    "pinhole-radtan8": (
        "OPENCV_PINHOLE", {name: name for name in ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6")}
    ),
    "fov": ("FOV", {"w": "fov_omega"}),
}  # fmt: skip
"""Our model for a camera type, and our settings for its parameters beside the focal lengths and the center."""


def looks(document: Document) -> bool:
    return bool(document.entries.part("value0").parts("intrinsics"))


def read(document: Document) -> list[Lens]:
    calibration = document.entries.part("value0")
    cameras, sizes = calibration.parts("intrinsics"), calibration.each("resolution")
    if calibration.has("resolution") and len(sizes) != len(cameras):
        raise document.refusal(f"it has {len(cameras)} intrinsics and not as many resolutions")
    pairs = zip(cameras, sizes or cameras, strict=True)
    named = [(f"cam{number}", camera.merged(size)) for number, (camera, size) in enumerate(pairs)]
    return [one_of_several(name, _lens, camera.labeled(name)) for name, camera in named]


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles: in the IMU's frame."""
    placed = []
    for number, pose in enumerate(document.entries.part("value0").parts("T_imu_cam")):
        turn, position = ([pose.number(name) for name in names] for names in
                       (("qw", "qx", "qy", "qz"), ("px", "py", "pz")))  # fmt: skip
        name = f"cam{number}"
        placed.append(Placed(name, "", None, of_quaternion(document, turn, position, name)))
    return placed


def _lens(camera: Fields) -> Lens:
    kind = camera.word("camera_type", MODELS)
    model, terms = MODELS[kind]
    intrinsics = camera.part("intrinsics")
    numbers = {name: intrinsics.number(name) for name in ("fx", "fy", "cx", "cy", *terms)}
    settings = {setting: numbers[name] for name, setting in terms.items()}
    settings |= {"unified_beta": 1.0} if kind == "ucm" else {}
    camera_matrix = matrix(*(numbers[name] for name in ("fx", "fy", "cx", "cy")))
    return Lens(camera.label, model, camera.size("resolution") | camera_matrix | settings)


PROGRAM = ProgramFiles(
    "Basalt", "calibration .json", looks, marks="value0 intrinsics camera_type resolution T_imu_cam",
    reads="ds, eucm, ucm, kb4, fov, pinhole, pinhole-radtan8", read=read, poses=poses, unit=METERS,
)  # fmt: skip
