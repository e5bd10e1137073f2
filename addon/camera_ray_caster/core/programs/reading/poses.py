"""The poses of the cameras of a file, or of one beside it, by format; see ``placed``.

COLMAP's, nerfstudio's, Metashape's and Meshroom's are of images, BOP's of frames; this add-on's camera.json has
frames; those of Kalibr, EuRoC, OKVIS, maplab, Basalt, KITTI and Project Aria are of cameras in a body, HOT3D's and
Polycam's of cameras at one time. Kalibr's cameras are placed in the IMU's frame if each has a T_cam_imu, else in that
of the first camera. Each reader has the unit of its format's lengths.
References: those of the formats' modules.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path, PurePath

import numpy as np

from ...conventions import LAST_FRAME
from ...records import InputError
from ...units import BLENDER_UNITS, METERS, MILLIMETERS, Unit, factor
from .. import (
    arkit,
    basalt,
    hot3d,
    kitti,
    meshroom,
    metashape_poses,
    nerfstudio,
    program_of,
    trajectory,
)
from ..parts.document import Document
from ..parts.lens import mapping
from ..parts.placed import FROM_BLENDER, Placed, checked, inverted, of_quaternion, pose_of
from ..recorded import FORMAT, RECORD
from .folders import files_in
from .nearest import by_name

ENDING = re.compile(r"(.*?)_(-?\d{4,}(?:\.\d+)?)")
"""The name of a picture of this add-on: CAMERA_FRAME."""


def beside(path: str) -> tuple[str, ...]:
    """Return the file of lenses and the file of poses that belong to a path: COLMAP has one of each, others have both
    in one. A folder stands for the COLMAP model in it, or its sparse/0; else for its files of pictures, with the
    trajectory of ARKitScenes last. Raises InputError for a folder without any.
    """
    file = Path(path)
    if file.is_dir():
        folders = file, file / "sparse" / "0", file / "sparse"
        found = [one for folder in folders for one in (folder / "images.bin", folder / "images.txt") if one.is_file()]
        if not found and (several := files_in(file)):
            return tuple(map(str, several))
        if not found:
            raise InputError(f"folder {path!r} has no images.bin or images.txt, nor its sparse/0, nor a file for each "
                             "picture as of Polycam, HOT3D or ARKitScenes: give a file")  # fmt: skip
        file = found[0]
    stem, kind = file.stem, file.suffix
    if stem not in ("images", "cameras") or kind not in (".bin", ".txt"):
        return str(file), str(file)
    lenses, poses = file.with_stem("cameras"), file.with_stem("images")
    return str(lenses), str(poses)


def placed_in(document: Document, meters: float) -> list[Placed]:
    """Return the poses of a document in its order, their places in Blender units of ``meters``. Raises InputError, in
    one line, for a document without poses.
    """
    try:
        program = program_of(document)
        if program is not None and program.poses is not None:
            return _in_units(program.poses(document), program.unit, meters)
        for read, unit in READERS:
            found = read(document)
            if found is not None:
                return _in_units(found, unit, meters)
    except InputError as refusal:
        raise by_name(document) or refusal from refusal
    raise document.refusal("it has no poses that are read: give a file of COLMAP, nerfstudio, Kalibr, EuRoC, OKVIS, "
                           "Basalt, BOP, Project Aria, HOT3D, maplab, Metashape, Meshroom, Polycam, ARKitScenes, "
                           "KITTI, this add-on, or a trajectory")  # fmt: skip


def _of_transforms(document: Document) -> list[Placed] | None:
    frames = document.raw.get("frames")
    if not isinstance(frames, list) or not all(isinstance(one, dict) for one in frames):
        return None
    if frames and not any("transform_matrix" in one for one in frames):
        return None
    placed = []
    for number, (frame, lens) in enumerate(zip(frames, nerfstudio.of_frames(document, frames), strict=True)):
        document.check()
        name = str(frame.get("file_path", number))
        if "transform_matrix" not in frame:
            raise document.refusal(f"it has no transform_matrix of {name}")
        pose = pose_of(document, frame["transform_matrix"], f"transform_matrix of {name}")
        placed.append(Placed(lens.name, name, None, pose @ FROM_BLENDER))
    return placed


def _of_basalt(document: Document) -> list[Placed] | None:
    poses = mapping(document.raw.get("value0")).get("T_imu_cam")
    if not isinstance(poses, list) or basalt.read(document, "") is None:
        return None
    placed = []
    for i, pose in enumerate(map(mapping, poses)):
        turn, place = ([document.number(pose, name) for name in names] for names in
                       (("qw", "qx", "qy", "qz"), ("px", "py", "pz")))  # fmt: skip
        placed.append(Placed(f"cam{i}", "", None, of_quaternion(document, turn, place, f"cam{i}")))
    return placed


def _of_bop(document: Document) -> list[Placed] | None:
    images = {key: mapping(one) for key, one in document.raw.items()}
    if not all(map(str.isdecimal, images)) or not any("cam_R_w2c" in one for one in images.values()):
        return None
    placed = []
    for key, image in images.items():
        document.check()
        pose = np.eye(4)
        pose[:3, :3] = np.reshape(document.numbers(image.get("cam_R_w2c"), f"cam_R_w2c of {key}", 9), (3, 3))
        pose[:3, 3] = np.array(document.numbers(image.get("cam_t_w2c"), f"cam_t_w2c of {key}", 3))
        placed.append(Placed(key, "", float(key), inverted(checked(document, pose, f"the pose of {key}"))))
    return placed


def _of_aria(document: Document) -> list[Placed] | None:
    first = next(iter(document.raw.values()))  # the first of several lines
    entries = document.raw if "CameraCalibrations" in document.raw else mapping(first)
    cameras = entries.get("CameraCalibrations")
    if not isinstance(cameras, list):
        return None
    placed = []
    for camera in map(mapping, cameras):
        name, pose = str(camera.get("Label", "")), mapping(camera.get("T_Device_Camera"))
        turn = pose.get("UnitQuaternion")
        turn = [turn[0], *turn[1]] if isinstance(turn, list) and len(turn) == 2 and isinstance(turn[1], list) else turn
        placed.append(Placed(name, "", None, of_quaternion(document, turn, pose.get("Translation"), name)))
    return placed


def _of_record(document: Document) -> list[Placed] | None:
    if document.raw.get("format") != FORMAT:
        return None
    placed = []
    for camera in map(mapping, document.raw.get("cameras") or ()):
        name, common = str(camera.get("name", "")), mapping(mapping(camera.get("all_frames")).get(RECORD))
        for frame in map(mapping, camera.get("frames") or ()):
            record = common | mapping(frame.get(RECORD))
            matrix = np.reshape(document.numbers(_flat(record.get("matrix_world")), "matrix_world", 16), (4, 4))
            matrix[:3, :3] /= np.linalg.norm(matrix[:3, :3], axis=0)
            pose = checked(document, matrix, f"matrix_world of {name}") @ FROM_BLENDER
            placed.append(Placed(name, name, document.number(frame, "frame"), pose))
    return placed


def _flat(rows) -> list:
    return [one for row in rows for one in (row if isinstance(row, list) else [row])] if isinstance(rows, list) else []


READERS: tuple[tuple[Callable[[Document], list[Placed] | None], Unit], ...] = (
    (kitti.poses, METERS), (trajectory.poses, METERS), (metashape_poses.poses, BLENDER_UNITS), (arkit.poses, METERS),
    (_of_record, BLENDER_UNITS), (_of_aria, METERS), (_of_transforms, BLENDER_UNITS), (meshroom.poses, BLENDER_UNITS),
    (_of_basalt, METERS), (_of_bop, MILLIMETERS), (hot3d.poses, METERS),
)  # fmt: skip
"""Readers of poses in the order in which they are tried, each with its unit of lengths."""


def _in_units(placed: list[Placed], unit: Unit, meters: float) -> list[Placed]:
    size = np.ones((4, 4))
    size[:3, 3] = factor(unit, meters)
    return [one._replace(pose=one.pose / size) for one in placed]


def object_and_frame(image: str) -> tuple[str, float | None]:
    """Return the camera's name and the frame in the name of a picture, which may have folders and an ending. A number
    beyond Blender's frames, such as a time in nanoseconds, is none.
    """
    stem = PurePath(image.replace("\\", "/")).name
    stem = stem.rsplit(".", 1)[0] if re.search(r"\.[A-Za-z]+\d?$", stem) else stem
    found = ENDING.fullmatch(stem)
    return (found[1], float(found[2])) if found and abs(float(found[2])) <= LAST_FRAME else (stem, None)
