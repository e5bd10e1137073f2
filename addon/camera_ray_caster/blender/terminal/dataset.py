"""The command that makes a data set: pictures of cameras and frames in one folder, made by one or more processes.

Each camera and frame has the passes CAMERA_FRAME.npz (or .exr), the report CAMERA_FRAME.json, from which
``camera_from_json`` makes the camera, and CAMERA_FRAME.png if the combined pass is requested. The ray passes of a
camera that stands still are written once, to CAMERA_rays.npz; reports list it among a frame's files. dataset.json
records the inputs and settings; reader.py reads the set, and preview.png shows the first picture of each camera. A
second run makes only the missing pictures.
"""

from __future__ import annotations

import json
from argparse import Namespace
from collections.abc import Sequence
from contextlib import suppress
from itertools import chain
from pathlib import Path
from typing import Any

import bpy

from ...core.exports.writing import write
from ...core.file_set import Taken, atomic_folder, clear_up
from ...core.records import InputError
from ...core.report.notes import sentences
from ...core.sets import companions
from ..output.annotations import collect
from ..output.stamps import differing
from ..read.camera import check_camera, check_markers
from ..read.unique import unique_name
from . import farm, files
from .options import command_parser, warn
from .pictures import Pictures, add_words, follow, parsed, summary
from .ray_maps import made_map
from .words import add_frames, count, scheduler_address

NAME = "dataset.json"


def run(arguments: Sequence[str], prog: str) -> int:
    """Make the missing pictures of a data set; return the exit status."""
    parser = command_parser(
        prog,
        "Make a data set of cameras and frames of a Blender file; a second run makes the missing pictures.",
        f"{prog} blend_scenes/toys.blend --cameras ALL --frames 1:100 --passes combined,depth,normal --workers 4",
        "writes out/CAMERA_FRAME.png, .npz and .json in four processes; out/dataset.json lists the settings and "
        "files that they are made from.",
    )
    add_frames(parser)
    add_words(parser)
    parser.set_defaults(format=files.NPZ, skip_existing=True, file_output=False, shard=None, frame=None)
    where = parser.add_mutually_exclusive_group()
    where.add_argument(
        "--workers",
        type=count,
        metavar="N",
        help="number of Dask processes on this machine; default: no Dask, only this process",
    )
    where.add_argument("--scheduler", type=scheduler_address, metavar="tcp://HOST:PORT",
                       help="address of the scheduler of a Dask cluster; its workers need this package, "
                            "bpy, the file and the folder")  # fmt: skip
    options = parsed(parser, arguments)
    pictures = Pictures(options)
    for line in pictures.warnings:
        warn(prog, line)
    _complete(options, pictures)
    jobs, stamp = pictures.jobs(), pictures.stamp()
    first = {job.camera: job for job in reversed(jobs)}
    for job in first.values():
        pictures.camera_at(job)  # refuse bad input before anything is made
        files.check(pictures.scene)
    passed, made = True, 0
    notes: dict[tuple[str, str], None] = {}
    exact: dict[tuple[str, float], None] = {}
    try:
        with farm.cluster(options) as client:
            _claim(options.output, stamp)
            maps = {job.camera: made_map(pictures, job, stamp) for job in first.values()}
            taken = {job: pictures.finished(job, stamp, maps[job.camera]) for job in jobs}
            missing = [job for job in jobs if taken[job] is None]
            if client is None:
                making = (pictures.make(job, stamp, prog, maps[job.camera]) for job in missing)
            else:
                making = farm.outcomes(client, options, stamp, maps, missing)
            for outcome in follow(chain(filter(None, taken.values()), making), len(jobs), prog):
                passed &= outcome.passed
                made += outcome.made
                notes |= dict.fromkeys(outcome.notes)
                exact |= dict.fromkeys(outcome.exact)
        if pictures.keypoints is not None:
            collect(options.output, [job.name for job in jobs])
        if options.format == files.NPZ:
            write(companions(options.output, [job.name for job in first.values()]), options.output)
    finally:
        clear_up(options.output)  # files left behind by killed workers
    print(summary(made, len(jobs), options.output), *sentences([*notes], [*exact]), sep="\n", flush=True)
    return int(not passed)


def _complete(options: Namespace, pictures: Pictures) -> None:
    """Fill in missing options from the file, and make all paths absolute, so that they hold in every process."""
    scene = pictures.scene
    if options.cameras is None:
        check_camera(scene, scene.camera)
        check_markers(scene)
        options.cameras = [unique_name(scene.camera, bpy.data.objects)]
    options.frames = options.frames or range(scene.frame_start, scene.frame_end + 1, scene.frame_step)
    options.pictures = any("combined" in keys for keys in pictures.passes.values())
    options.file, options.output = Path(bpy.data.filepath).absolute(), options.output.absolute()
    options.calibration = options.calibration and options.calibration.absolute()
    options.rig = options.rig and [str(Path(path).absolute()) for path in options.rig]


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
