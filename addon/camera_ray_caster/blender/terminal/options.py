"""Shared parts of the terminal commands: the parser, opening the file, and printing."""

import argparse
import math
import sys
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from textwrap import fill

import bpy

from ...core.camera.calibration_file import FRAMES_SIZE
from ...core.programs import READ
from ...core.records import InputError
from ...core.report.report import WIDTH, Report, as_json, as_lines
from ..process import signals
from ..process.opening import open_file, withhold_style_modules
from ..properties.calibration_choice import READING, set_calibration
from ..properties.declared import ENGINE
from ..read import frames
from ..read.camera_fields import ALL, check_camera, eye_object, find_camera, find_cameras, has_pixel_times, view_names
from ..read.evaluated import camera_at
from ..read.frames import frame_of, layer_of
from ..read.physics import simulate
from ..read.size import set_size, size_of
from ..read.unique import find_unique, unique_name
from ..rig import add_rig, frames_of, shows
from .words import Parser, frame_number, picture_size, unstamped

ENDS = "exit status: 0 done; 1 done, but a reference check of the camera's rays failed; 2 bad input; 130 interrupted."


def command_parser(prog: str, purpose: str, example: str, result: str, ends: str = ENDS) -> Parser:
    """Return a parser with the options that all commands share; ``result`` says what the example does."""
    parser = Parser(
        prog=prog,
        description=purpose,
        epilog=f"example:\n  {example}\n{fill(result, WIDTH)}\n\n{fill(ends, WIDTH)}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    unstamped(parser.add_argument("file", nargs="?", type=Path, metavar="FILE.blend", help=
        "Blender file to open; default: the file that is open"))  # fmt: skip
    parser.add_argument("--scene", metavar="NAME", help="name of the scene; default: the scene that the file opens")
    unstamped(parser.add_argument("--camera", metavar="NAME", help=
        "name of the camera; default: the scene's active camera"))  # fmt: skip
    unstamped(parser.add_argument("--calibration", type=Path, metavar="FILE", help=
        f"calibration file of {READ}; it determines the camera's model"))  # fmt: skip
    parser.add_argument(
        "--calibration-camera",
        default="",
        metavar="NAME",
        help="name of the camera in a calibration file that has several cameras",
    )
    parser.add_argument(
        "--model",
        type=str.upper,
        choices=READING,
        help="model of the calibration file; needed if an OpenCV file has four coefficients and no model name",
    )
    parser.add_argument("--resolution", type=picture_size, metavar="WxH", help="size of pictures; default: the file's")
    parser.set_defaults(prog=prog)
    parser.add_argument("--enable-autoexec", action="store_true",
                        help="run the Python scripts and drivers of FILE.blend; default: they do not run")  # fmt: skip
    return parser


def add_json(parser) -> None:
    """Add --json."""
    unstamped(parser.add_argument("--json", action="store_true", help="print the report as JSON instead of a table"))


def add_frame(parser) -> None:
    """Add --frame."""
    unstamped(parser.add_argument("--frame", type=frame_number, help=
        "frame, which may have a fraction; default: the current frame of the file"))  # fmt: skip


def open_scene(options, say: Callable[[str], object] | None = None):
    """Open the file that the options name; return its scene, set to this engine, resolution and the chosen camera.

    ``say`` is called with lines of warning; by default they are printed.
    """
    path = options.file
    if path is not None:
        open_file(path, options.enable_autoexec)
    elif not bpy.app.binary_path:
        raise InputError("no file is open: give the path of a .blend")
    elif not options.enable_autoexec:
        withhold_style_modules()
    signals.raise_if_stopping()
    scene = scene_of(options)
    scene.render.engine = ENGINE
    if options.resolution:
        set_size(scene, options.resolution)
    if options.camera is not None:
        use_camera(scene, find_camera(scene, options.camera))
    say = say or partial(warn, options.prog)
    if options.calibration is not None:
        _calibrate(scene, options, say)
    rig = getattr(options, "rig", None)
    for option in ("calibration_camera", "model"):
        if options.calibration is None and not (rig and option == "model") and getattr(options, option):
            raise InputError(f"--{option.replace('_', '-')} needs a calibration file: add --calibration FILE")
    if rig:
        _mount(scene, options, rig, say)
    elif getattr(options, "own_frames", False):
        _take_poses(scene, options)
    return scene


def scene_of(options):
    """Return the scene that the options name, which becomes the open file's scene; by default it is as it was."""
    if options.scene is not None:
        scene = find_unique(options.scene, bpy.data.scenes)
        if scene is None:
            known = ", ".join(repr(unique_name(item, bpy.data.scenes)) for item in bpy.data.scenes)
            raise InputError(f"the file has no scene {options.scene!r}; its scenes are: {known}")
        bpy.context.window.scene = scene
    return bpy.context.scene


def _mount(scene, options, paths: Sequence[str], say: Callable[[str], object]) -> None:
    """Add the cameras of files, and let the options name them and the frames of their poses if they name none; see
    ``shown_at``.
    """
    parent = options.rig_parent
    if parent is not None and parent not in scene.objects:
        raise InputError(f"scene {scene.name!r} has no object {parent!r}: give --rig-parent an object of the scene")
    mounted = add_rig(scene, paths, parent and scene.objects[parent], options.model or "", say)
    options.cameras = options.cameras or [item.name for item in mounted]
    if options.frames is None and getattr(options, "frame", None) is None:
        options.frames, options.own_frames = frames_of(mounted) or None, True


def _take_poses(scene, options) -> None:
    """Let the options name the frames of the poses of their cameras. Raises InputError if there are none."""
    if options.frames is not None or getattr(options, "frame", None) is not None:
        raise InputError("--poses sets the frames: leave out --frame and --frames")
    options.cameras = options.cameras or ([ALL] if options.camera is None else [options.camera])
    options.frames = frames_of(find_cameras(scene, options.cameras))
    if not options.frames:
        raise InputError("no camera has poses from a file: give --frames in place of --poses")


def shown_at(options, camera, frame: float) -> bool:
    """Whether a camera is asked for in one of the frames: with ``own_frames``, in those of its poses only."""
    return not options.own_frames or shows(camera, frame)


def _calibrate(scene, options, say: Callable[[str], object]) -> None:
    """Set the calibration of the scene's camera, or of the cameras of its views."""
    path, frame = str(options.calibration.absolute()), size_of(scene)
    for camera in [eye_object(scene, view) for view in view_names(scene)]:
        check_camera(scene, camera)
        summary = set_calibration(camera.data, path, options.calibration_camera, frame, options.model or "")
        if summary.endswith(FRAMES_SIZE):
            say(f"{FRAMES_SIZE}, {frame[0]} x {frame[1]} ({options.calibration})")


def use_camera(scene, camera) -> None:
    """Make a camera the scene's active camera at every frame."""
    for marker in scene.timeline_markers:
        marker.camera = None  # a marker's camera would become active at its frame
    scene.camera = camera


def go_to(scene, frame: float | None, last: float = -math.inf) -> None:
    """Set the scene's frame, unless ``frame`` is None.

    Physics that are not baked are simulated, to the frame after it, after ``last`` and after the last frame that pixels
    show. Raises InputError if that is not possible.
    """
    here = frame_of(scene) if frame is None else frame
    depsgraph = layer_of(scene).depsgraph
    simulate(depsgraph, max(here, last) + 1)
    if frame_of(scene) != here or frame is not None:
        frames.go_to(scene, here)
    if has_pixel_times(scene.camera, depsgraph):
        _, camera = camera_at(scene.camera, depsgraph)
        simulate(depsgraph, max(0, last - here) + camera.pixel_time.last + 1)
        frames.go_to(scene, here)


def warn(prog: str, line: str) -> None:
    """Print a warning."""
    print(f"{prog}: warning: {line}", file=sys.stderr)


def stem() -> str:
    """Return the base name of the open file's outputs."""
    return Path(bpy.data.filepath).stem or "untitled"


def show(report: Report, json: bool, last_line: str) -> None:
    """Print a report, as JSON or as a table with a last line."""
    print(as_json(report) if json else "\n".join((*as_lines(report), "", last_line)), flush=True)
