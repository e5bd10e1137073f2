"""The command that exports cameras, by frame, to files of other programs."""

import sys
from argparse import ArgumentTypeError
from collections.abc import Callable, Sequence
from functools import lru_cache, partial
from math import pi
from operator import attrgetter
from pathlib import Path
from typing import Any

from ...core.exports import EXPORT_FORMATS, export_files
from ...core.exports.file_writer import write
from ...core.exports.format import Each
from ...core.records import InputError, Shapes
from ...core.sets import SET_FORMATS, chosen, read_set, sparse, with_splits
from ...core.sets.recast import MeshView, with_meshes
from ..output import exports
from ..process.opening import not_run, open_file
from ..read.camera_fields import ALL, check_camera, check_markers, find_camera, find_cameras
from ..read.frames import frame_of
from ..read.scene_reader import read_shapes
from .options import command_parser, go_to, open_scene, scene_of, shown_at, warn
from .words import add_cameras, add_frames, add_progress, check_cameras, count, degrees

OF_SCENES = "calibration", "rig", "resolution", "to"
"""Options that change what a .blend has."""

RECAST = "depths, masks, boxes and poses are cast anew, with meshes as meshes; pictures still show the exact shapes"
"""Remark on sets with models."""

WITH_OPTION = {set_format.option: key for key, set_format in SET_FORMATS.items() if set_format.option}
"""The only format that has an option, by the option."""

PRINTED_FILES = 8
"""Files whose names are printed."""


def run(arguments: Sequence[str], prog: str) -> int:
    """Export cameras of a file; return the exit status."""
    parser = command_parser(
        prog,
        "Write the cameras of a Blender file, at one or more frames, or a finished data set, for other programs.",
        f"{prog} blend_scenes/toys.blend --format npz --cameras ALL --frames 1:100:10 --output out",
        "writes a ray map for each camera and frame; cameras that a format cannot represent are refused.",
        ends="exit status: 0 done; 2 bad input.",
    )
    formats = {export_format.key: export_format for export_format in EXPORT_FORMATS} | SET_FORMATS
    parser.add_argument("--format", type=str.lower, choices=formats, required=True, help=
        "; ".join(f"{key}: {export_format.description}" for key, export_format in formats.items())
        + f". For the folder of a finished data set only: {', '.join(SET_FORMATS)}")  # fmt: skip
    parser.add_argument("--points", type=count, metavar="N", help=
        f"number of seed points, for {WITH_OPTION['points']} only; default: {sparse.POINT_COUNT}")  # fmt: skip
    parser.add_argument("--models", type=Path, metavar="FILE.blend", help=
        "Blender file of the data set, from which its objects' models are written, for "
        f"{WITH_OPTION['models']} only")  # fmt: skip
    parser.add_argument("--validation", type=_part, metavar="PART", help=
        f"part of the pictures of a data set for validation, such as 0.2: a split in the files of "
        f"{', '.join(key for key, set_format in SET_FORMATS.items() if set_format.splits)}; default: none")  # fmt: skip
    add_cameras(parser)
    add_frames(parser)
    add_progress(parser)
    parser.add_argument("--to", metavar="NAME", help="target camera of the maps, for stmap only; "
                                                     "default: a perspective camera with the same lens")  # fmt: skip
    parser.add_argument("--fit", nargs="?", type=degrees, const=pi, metavar="DEGREES", help=
        "if the format does not have a camera's lens, write the nearest one that it has, and report the error in "
        "pixels; it is fitted up to DEGREES from the viewing direction, default: everywhere")  # fmt: skip
    parser.add_argument("--output", type=Path, default=Path("out"), metavar="FOLDER", help="default: %(default)s")
    options = parser.parse_args(arguments)
    check_cameras(options)
    for name, key in WITH_OPTION.items():
        if getattr(options, name) and options.format != key:
            raise InputError(f"--{name} applies to --format {key} only")
    if options.scene and options.file is not None and options.file.is_dir() and not options.models:
        raise InputError("--scene names the scene of a .blend: add --models FILE.blend, or leave it out")
    if options.validation and not (options.format in SET_FORMATS and SET_FORMATS[options.format].splits):
        raise InputError(f"--validation does not apply to --format {options.format}: leave it out")
    if options.file is not None and options.file.is_dir():
        return _of_set(options)
    if options.format in SET_FORMATS:
        source = "a .blend" if options.file is None else repr(str(options.file))
        raise InputError(f"--format {options.format} needs a finished data set: give its folder in place of {source}")
    scene = open_scene(options)
    if not options.cameras:
        check_camera(scene, scene.camera)
        if options.frames:
            check_markers(scene)
    cameras = find_cameras(scene, options.cameras) if options.cameras else [scene.camera]
    target = find_camera(scene, options.to) if options.to is not None else None
    frames = options.frames or [frame_of(scene)]
    go_to(scene, None, max(frames))
    say = partial(_say, prog) if options.progress else None
    remarks, paths = exports.write(scene, options.format, cameras, frames, options.output, target,
                                   not options.resolution, options.fit, partial(shown_at, options), say)  # fmt: skip
    for line in not_run():
        warn(prog, line)
    _tell(remarks, paths, options.output)
    return 0


def _say(prog: str, line: str) -> None:
    """Print what is being done."""
    print(f"{prog}: {line}", file=sys.stderr, flush=True)


def _part(text: str) -> float:
    """Return a part between 0 and 1."""
    try:
        share = float(text)
    except ValueError:
        share = 0.0
    if not 0 < share < 1:
        raise ArgumentTypeError(f"{text!r} is not a part between 0 and 1, such as 0.2")
    return share


def _tell(remarks: Sequence[str], paths: Sequence[Path], folder: Path) -> None:
    """Print remarks, and in one line the files that were written."""
    names = ", ".join(map(str, paths)) if 0 < len(paths) <= PRINTED_FILES else f"{len(paths)} files into {folder}"
    print("\n".join((*remarks, f"Wrote {names}")), flush=True)


def _of_set(options) -> int:
    """Export a finished data set, with the names of its pictures' files; return the exit status."""
    if options.own_frames:
        raise InputError("--poses does not apply to a finished data set: leave it out")
    unused = [name for name in OF_SCENES if getattr(options, name)]
    if unused:
        raise InputError(f"--{unused[0].replace('_', '-')} does not apply to a finished data set: leave it out")
    cameras = options.cameras or ([options.camera] if options.camera else [])
    views = chosen(read_set(options.file), [] if ALL in cameras else cameras, options.frames or ())
    if options.validation:
        views = with_splits(views, options.validation)
    if options.format in SET_FORMATS:
        if options.fit:
            raise InputError(f"--fit does not apply to --format {options.format}: choose a format of cameras")
        arguments: dict[str, Any] = {"count": options.points} if options.points else {}
        remarks = []
        if options.models:
            arguments["shapes_at"] = _shapes_of(options, max(view.frame for view in views))
            views = with_meshes(views, arguments["shapes_at"])
            if any(isinstance(view, MeshView) for view in views):
                remarks = [RECAST]
        files = SET_FORMATS[options.format].files(views, **arguments)
    else:
        files, remarks = export_files(options.format, Each(views, attrgetter("shot")), options.fit)
    paths = write(files, options.output)
    _tell(remarks, paths, options.output)
    return 0


def _shapes_of(options, last: float) -> Callable[[float], Shapes]:
    """Open the file of the models; return a function that reads the shapes of its scene at a frame, up to ``last``:
    meshes as meshes.
    """
    open_file(options.models, options.enable_autoexec)
    scene = scene_of(options)
    scene.camera_ray_caster.exact_shapes = False

    @lru_cache(maxsize=1)
    def shapes_at(frame: float) -> Shapes:
        go_to(scene, frame, last)
        return read_shapes(scene)

    return shapes_at
