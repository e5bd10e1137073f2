"""Kalibr's camchain.yaml: cam0, cam1, ..., each a camera model, a distortion model and a pose.

A radial-tangential distortion of five coefficients has a k3, too. T_cam_imu leads from the IMU to a camera, T_imu_cam
of OpenVINS from a camera to the IMU, T_cn_cnm1 from the camera before to the camera, x right, y down, z ahead; lengths
are in meters. The center of the first pixel is (0, 0).
References: Kalibr wiki, Supported models; YAML formats.
"""

import json
import re
from collections.abc import Iterator, Sequence

import numpy as np

from ..records import InputError
from ..units import METERS
from .parts.camchain import DISTORTIONS, SHAPES, is_camera, lens_of
from .parts.document import Document
from .parts.lens import Lens, matrix_of, one_of_several, word_of
from .parts.placed import Placed, inverted, pose_in
from .parts.program import CameraRecord, FileWriter, ProgramFiles

MOVED = 1e-5
"""Largest change of a pose beside another camera that counts as rounding of float32 matrices, in radians and parts."""

POSE, POSES = re.compile("T_|R_|t_"), ("T_cam_imu", "T_imu_cam", "T_cn_cnm1")
"""How names of poses begin, and those that are read."""

MODELS = {
    f"{kind}-{bend}": (model, (*SHAPES[kind][1], *terms))
    for (kind, bend), (model, terms) in DISTORTIONS.items()
    if bend != "radialtangential8"  # a word of other programs only
} | {f"{kind}-none": SHAPES[kind] for kind in ("omni", "eucm", "ds")}


def looks(document: Document) -> bool:
    return not is_camera(document.entries) and bool(_chain(document))


def read(document: Document) -> list[Lens]:
    return [one_of_several(name, lens_of, camera, name) for name, camera in _chain(document).items()]


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles. The frame is the IMU's if each camera has a pose in it, else that of the first camera."""
    chain = _chain(document)
    by_imu = all(camera.has("T_cam_imu") or camera.has("T_imu_cam") for camera in chain.values())
    placed, pose = [], np.eye(4)
    for number, (name, camera) in enumerate(chain.items()):
        unread = [name for name in camera if POSE.match(name) and camera.has(name)]
        if unread and not any(map(camera.has, POSES)):
            raise document.refusal(f"{camera.said(unread[0])} is a pose that is not read: {', '.join(POSES)} are")
        if by_imu:
            pose = pose_in(camera, "T_imu_cam") if camera.has("T_imu_cam") else inverted(pose_in(camera, "T_cam_imu"))
        elif number and not camera.has("T_cn_cnm1"):
            raise document.refusal(f"it has no T_cn_cnm1 of {name}, which stands beside the camera before it")
        elif number:
            pose = pose @ inverted(pose_in(camera, "T_cn_cnm1"))
        placed.append(Placed(name, "", None, pose))
    return placed


def _chain(document: Document):
    return {name: camera for name, camera in document.entries.named().items() if camera.has("camera_model")}


def write(records: Sequence[CameraRecord]) -> Iterator[tuple[str, str]]:
    """See FileWriter. Raises InputError if a lens, or a camera's pose beside the first one, changes."""
    chain = "# Made by Camera Ray Caster\n"
    names = list(dict.fromkeys(record.name for record in records))
    before: dict[float, CameraRecord] = {}
    for number, name in enumerate(names):
        by_frame = {record.frame: record for record in records if record.name == name}
        lens_texts = {_text(record.lens) for record in by_frame.values()}
        beside = [_beside(before[frame], record) for frame, record in by_frame.items()] if before else []
        moved = any(np.abs(pose - beside[0]).max() > MOVED * (1 + np.abs(pose).max()) for pose in beside)
        if len(lens_texts) > 1 or moved:
            change = "its lens" if len(lens_texts) > 1 else f"it moves beside {names[number - 1]!r}"
            raise InputError(f"a camchain is a fixed rig, but camera {name!r} changes ({change}): export one frame")
        chain += f"cam{number}:\n{lens_texts.pop()}  rostopic: {json.dumps('/' + name, ensure_ascii=False)}\n"
        if beside:
            chain += "  T_cn_cnm1:\n" + "".join(f"  - {row}\n" for row in beside[0].tolist())
        before = by_frame
    yield "camchain.yaml", chain


def _beside(before: CameraRecord, record: CameraRecord) -> np.ndarray:
    """Return the matrix from one camera to another."""
    return record.world_to_camera @ before.pose


def _text(lens: Lens) -> str:
    kind, bend = str(word_of(MODELS, lens)).split("-")
    entries = {
        "camera_model": kind, "intrinsics": lens.values(SHAPES[kind][1]) + matrix_of(lens.settings),
        "distortion_model": bend, "distortion_coeffs": lens.values(DISTORTIONS.get((kind, bend), ("", ()))[1]),
        "resolution": list(lens.size),
    }  # fmt: skip
    return "".join(f"  {name}: {value}\n" for name, value in entries.items())


PROGRAM = ProgramFiles(
    "Kalibr", "camchain.yaml", looks,
    marks="camera_model distortion_model distortion_coeffs intrinsics resolution T_cn_cnm1",
    reads="pinhole with radtan, equidistant or fov, omni, eucm, ds", lost="skew; cameras that move against each other",
    read=read, poses=poses, unit=METERS,
    export=FileWriter(
        "kalibr", "Kalibr",
        "camchain.yaml: the lenses of a rig that does not change, and their poses beside each other",
        write, MODELS, ending="camchain.yaml",
    ),
)  # fmt: skip
