"""The intrinsics and poses of Meshroom's and AliceVision's .sfm files, as JSON.

Lengths are in pixels (pxFocalLength), or the focal length and the sensor's width in millimeters. The principal point is
measured from the corner of the picture, and from version 1.2.1 on from its middle. The center of the first pixel is
(0, 0). Numbers may be text. A pose is the center, and by columns the rotation from the world to the camera, or of a rig
to the rig, whose cameras have poses in it. Views without a pose are left out: they were not reconstructed.
References: AliceVision, sfmDataIO: the changes of its file format; its camera models, Pose3 and SfMData::getPose.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .parts.document import Document
from .parts.lens import Lens, mapping, one_of_several
from .parts.placed import Placed, checked

MODELS = {
    "pinhole": ("OPENCV_PINHOLE", ()),
    "none": ("OPENCV_PINHOLE", ()),
    "radial1": ("OPENCV_PINHOLE", ("k1",)),
    "radialk1": ("OPENCV_PINHOLE", ("k1",)),
    "radial3": ("OPENCV_PINHOLE", ("k1", "k2", "k3")),
    "radialk3": ("OPENCV_PINHOLE", ("k1", "k2", "k3")),
    "brown": ("OPENCV_PINHOLE", ("k1", "k2", "k3", "p1", "p2")),
    "fisheye4": ("OPENCV_FISHEYE", ("k1", "k2", "k3", "k4")),
    "fisheye": ("OPENCV_FISHEYE", ("k1", "k2", "k3", "k4")),
    "fisheye1": ("FOV", ("fov_omega",)),
}
"""Our model for a type, or for the distortionType of a pinhole, and its coefficients."""

CENTERED = 1, 2, 1
"""The version of files from which on principal points are measured from the middle."""


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lenses of a document; see the package."""
    entries = document.raw
    intrinsics = entries.get("intrinsics")
    if not isinstance(intrinsics, list) or not all("intrinsicId" in mapping(one) for one in intrinsics):
        return None
    version = tuple(document.numbers(entries.get("version", [1, 2, 1]), "version"))
    return [one_of_several(str(one["intrinsicId"]), _lens, document, one, version) for one in intrinsics]


def _lens(document: Document, camera: dict, version: tuple[float, ...]) -> Lens:
    name = str(camera["intrinsicId"])
    kind = str(camera.get("type", "pinhole")).lower()
    kind = str(camera.get("distortionType") or kind).lower() if kind == "pinhole" else kind
    model, terms = MODELS[document.one_of(kind, f"type of {name}", MODELS)]
    width, height = document.number(camera, "width"), document.number(camera, "height")
    if document.number(camera, "pixelRatio", 1.0) != 1:
        raise document.refusal(f"pixelRatio of {name} is {camera['pixelRatio']}: only square pixels are read")
    if "pxFocalLength" in camera:
        focal = document.numbers(camera["pxFocalLength"], f"pxFocalLength of {name}")
    else:
        focal = [document.number(camera, "focalLength") / document.number(camera, "sensorWidth") * width]
    center = document.numbers(camera.get("principalPoint"), f"principalPoint of {name}", 2)
    if version >= CENTERED:
        center = [center[0] + width / 2, center[1] + height / 2]
    given = camera.get("distortionParams")
    rest = [0.0] * len(terms) if given in (None, "", []) else document.numbers(given, f"distortionParams of {name}")
    if len(rest) != len(terms) and any(rest):
        raise document.refusal(f"distortionParams of {name} has {len(rest)} numbers: {kind} has {len(terms)}")
    settings = {"fx": focal[0], "fy": focal[-1], "cx": center[0], "cy": center[1]}
    return Lens(name, model, document.size(width, height) | settings | dict(zip(terms, rest, strict=False)))


def poses(document: Document) -> list[Placed] | None:
    """Return the poses of the views in the order of the file; None of any other file. Raises InputError."""
    entries = document.raw
    views = entries.get("views")
    if not isinstance(views, list) or not isinstance(entries.get("intrinsics"), list):
        return None
    own = {str(one.get("poseId")): mapping(one.get("pose")).get("transform") for one in _mappings(entries, "poses")}
    rigs = {str(one.get("rigId")): _mappings(one, "subPoses") for one in _mappings(entries, "rigs")}
    placed = []
    for view in map(mapping, views):
        document.check()
        name = str(view.get("path") or view.get("viewId", ""))
        transform = own.get(str(view.get("poseId")))
        if transform is None:
            continue
        pose = _pose(document, transform, name)
        independent = str(view.get("isPoseIndependant", "true")).lower() in ("true", "1")
        if str(view.get("rigId")) in rigs and not independent:
            cameras, number = rigs[str(view["rigId"])], document.number(view, "subPoseId")
            if not 0 <= number < len(cameras) or number % 1:
                raise document.refusal(f"subPoseId of {name} is {number:g}: its rig has {len(cameras)} cameras")
            pose = pose @ _pose(document, cameras[int(number)].get("pose"), f"camera {number:g} of a rig")
        placed.append(Placed(str(view.get("intrinsicId", "")), name, None, pose))
    if not placed:
        raise document.refusal("it has no poses of its views: give the file of StructureFromMotion, not of CameraInit")
    return placed


def _mappings(owner: dict, name: str) -> list[dict]:
    found = owner.get(name)
    return list(map(mapping, found)) if isinstance(found, list) else []


def _pose(document: Document, transform: Any, name: str) -> np.ndarray:
    pose = np.eye(4)  # the transposed of a rotation by columns is it by rows: from the camera
    given = mapping(transform)
    pose[:3, :3] = np.reshape(document.numbers(given.get("rotation"), f"rotation of {name}", 9), (3, 3))
    pose[:3, 3] = document.numbers(given.get("center"), f"center of {name}", 3)
    return checked(document, pose, f"rotation of {name}")
