"""Data sets: pictures of cameras and frames in one folder, ``cast --dataset``, and the other files of every set.

Each camera and frame has the passes CAMERA_FRAME.npz (or .exr), the report CAMERA_FRAME.json, from which
``camera_from_json`` makes the camera, and CAMERA_FRAME.png if the combined pass is requested. The ray passes of a
camera that stands still are written once, to CAMERA_rays.npz; reports list it among a frame's files. dataset.json
records the inputs and settings; reader.py reads the set, and preview.png shows the first picture of each camera. A
second run makes only the missing pictures.
"""

from __future__ import annotations

import json
from argparse import Namespace
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

import bpy

from ...core.exports.writing import write
from ...core.file_set import Taken, atomic_folder
from ...core.records import InputError
from ...core.sets import companions
from ..output.stamps import differing
from ..read.camera import check_camera, check_markers
from ..read.unique import unique_name
from .jobs import PictureJob, RayMap
from .pictures import Pictures
from .ray_maps import made_map

NAME = "dataset.json"


def complete(options: Namespace, pictures: Pictures) -> None:
    """Fill in missing options from the file: the active camera, all frames, and whether there are pictures to show."""
    scene = pictures.scene
    if options.cameras is None and options.camera is None:
        check_camera(scene, scene.camera)
        check_markers(scene)
    options.cameras = options.cameras or [unique_name(scene.camera, bpy.data.objects)]
    if options.frames is None and options.frame is None:
        options.frames = range(scene.frame_start, scene.frame_end + 1, scene.frame_step)
    options.pictures = any("combined" in keys for keys in pictures.passes.values())


def begin(
    pictures: Pictures, first: Mapping[str | None, PictureJob], stamp: dict[str, Any]
) -> dict[str | None, RayMap | None]:
    """Claim the folder and write the ray maps, which are returned by camera; ``first`` has each camera's first job."""
    _claim(pictures.options.output, stamp)
    return {camera: made_map(pictures, job, stamp) for camera, job in first.items()}


def end(options: Namespace, first: Mapping[str | None, PictureJob]) -> None:
    """Write the reader and the preview of a set, also of one that is none of ``--dataset``."""
    write(companions(options.output, [job.report for job in first.values()]), options.output)


def _claim(folder: Path, stamp: dict[str, Any]) -> None:
    """Mark a folder as that of a data set. Raises InputError if it belongs to another data set."""
    with suppress(Taken), atomic_folder(folder, replacing=False) as new:
        (new / NAME).write_text(json.dumps(stamp, indent=2) + "\n", encoding="utf-8")
    path = folder / NAME
    try:
        others = differing(stamp, json.loads(path.read_text(encoding="utf-8")))
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InputError(
            f"{str(path)!r} is not the file of a data set made by this version: choose another folder"
        ) from error
    if others:
        raise InputError(f"{str(folder)!r} has a data set that differs in {', '.join(others)}: choose another folder")
