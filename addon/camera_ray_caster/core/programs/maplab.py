"""The camera rigs (ncamera) of maplab and SVO, in YAML: cameras with their type, intrinsics, distortion and pose.

The center of the first pixel is (0, 0). The distortion fisheye is the field-of-view model. T_B_C leads from the camera
to the rig's body; in maplab's files of all sensors, T_B_S from the rig to the body of all.
References: maplab documentation, Sensor calibration; SVO's rpg_svo_pro, calibration files.
"""

import numpy as np

from ..units import METERS
from .parts.camchain import DISTORTIONS, SHAPES, spelled
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens, matrix, one_of_several
from .parts.placed import Placed, pose_in
from .parts.program import ProgramFiles

OMNI = "omni"
"""SVO's type of OCam: its intrinsics are the polynomial, 5 terms, the center, c, d, e, the inverse and two radii."""
CAMERA_TYPES = {"pinhole": "pinhole", "unifiedprojection": "omni"}
BENDS = {"fisheye": "fov", "rationalradtan": "radialtangential8", "radtan": "radtan", "equidistant": "equidistant"}
"""The words of ``parts.camchain`` for a type of camera and of distortion, by their plain names."""


def looks(document: Document) -> bool:
    cameras = [camera for rig in _rigs(document) for camera in _cameras(rig)]
    return bool(cameras) and all(camera.has("type", "intrinsics") for camera in cameras)


def read(document: Document) -> list[Lens] | None:
    """See ProgramFiles. Rigs among other sensors are further inside."""
    if not document.entries.has("cameras"):
        return None
    return [one_of_several(camera.label, _lens, camera) for camera in _cameras(document.entries)]


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles: in the body."""
    entries = document.entries
    known = [extrinsics for extrinsics in entries.parts("extrinsics") if extrinsics.has("sensor_id")]
    bodies = {id_: extrinsics.labeled(id_) for extrinsics in known if (id_ := extrinsics.text("sensor_id"))}
    placed = []
    for rig in _rigs(document):
        id_ = rig.text("id")
        body = pose_in(bodies[id_], "T_B_S") if id_ in bodies else np.eye(4)
        for camera, owner in zip(_cameras(rig), rig.parts("cameras"), strict=True):
            pose = pose_in(owner.labeled(camera.label), "T_B_C")
            placed.append(Placed(camera.label, "", None, body @ pose))
    if len({pose.camera for pose in placed}) < len(placed):
        raise document.refusal("its rigs have cameras of one name: give each a label of its own")
    return placed


def _rigs(document: Document) -> list[Fields]:
    entries = document.entries
    rigs = [entries] if entries.has("cameras") else entries.parts("sensors")
    return [rig for rig in rigs if rig.has("cameras")]


def _cameras(rig: Fields) -> list[Fields]:
    cameras = [camera.part("camera") for camera in rig.parts("cameras")]
    return [camera.labeled(camera.text("label") or f"cam{number}") for number, camera in enumerate(cameras)]


def _lens(camera: Fields) -> Lens:
    size, camera_type = camera.sides("image_width", "image_height"), spelled(camera.text("type"))
    if camera_type == OMNI:
        numbers = camera.matrix("intrinsics", 24)
        affine = dict(zip(("cx", "cy", "ocam_c", "ocam_d", "ocam_e"), numbers[5:10], strict=True))
        return Lens(camera.label, "OCAM", size | affine | {"ocam_polynomial": " ".join(map(repr, numbers[:5]))})
    kind = CAMERA_TYPES[camera.document.one_of(camera_type, camera.said("type"), (*CAMERA_TYPES, OMNI))]
    model, shape = SHAPES[kind]
    distortion = camera.part("distortion")
    word = spelled(distortion.text("type", "none"))
    terms: tuple[str, ...] = ()
    if word not in ("none", ""):
        known = [name for name, bend in BENDS.items() if (kind, bend) in DISTORTIONS]
        bend = BENDS[camera.document.one_of(word, camera.said("distortion"), known)]
        model, terms = DISTORTIONS[kind, bend]
    first = camera.matrix("intrinsics", len(shape) + 4)
    coefficients = distortion.matrix("parameters", len(terms)) if terms else []
    settings = dict(zip((*shape, *terms), (*first[: len(shape)], *coefficients), strict=True))
    return Lens(camera.label, model, size | matrix(*first[len(shape) :]) | settings)


PROGRAM = ProgramFiles(
    "maplab", "ncamera .yaml of maplab and SVO", looks, marks="cameras camera label image_height type T_B_C",
    reads="pinhole, unified-projection, with radial-tangential, rational, equidistant or fisheye; omni",
    read=read, poses=poses, unit=METERS,
)  # fmt: skip
