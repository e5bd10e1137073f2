"""What the commands for a terminal share: their parser, the file that they open, and what they print."""

import argparse
import math
import sys
from pathlib import Path
from textwrap import fill

import bpy

from ...core.cameras.parts.calibration import FILE_WRITERS
from ...core.records import InputError
from ...core.report.report import WIDTH, Report, as_json, as_lines
from ..engine.engine import CameraRayCaster
from ..properties.calibration import set_calibration
from ..read.camera import check_camera, find_camera
from . import signals
from .opening import open_file
from .words import Parser, frame_number

ENDS = "exit status: 0 done; 1 done, but the camera's rays disagree with a witness; 2 bad input."


def command_parser(prog: str, purpose: str, example: str, result: str, ends: str = ENDS) -> Parser:
    """Return a parser with the words that every command has; ``result`` says what the example does."""
    parser = Parser(
        prog=prog,
        description=purpose,
        epilog=f"example:\n  {example}\n{fill(result, WIDTH)}\n\n{fill(ends, WIDTH)}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("file", nargs="?", type=Path, metavar="FILE.blend", help="default: the file that is open")
    parser.add_argument("--camera", metavar="NAME", help="default: the scene's active camera")
    parser.add_argument("--calibration", type=Path, metavar="FILE",
                        help=f"of {FILE_WRITERS}: the camera's model follows from it")  # fmt: skip
    parser.add_argument("--calibration-camera", default="", metavar="NAME", help="of a file with several cameras")
    parser.add_argument("--enable-autoexec", action="store_true",
                        help="run the Python scripts and drivers of FILE.blend; default: they do not run")  # fmt: skip
    return parser


def add_json(parser) -> None:
    """Add --json."""
    parser.add_argument("--json", action="store_true", help="print the report as JSON in place of the table")


def add_frame(parser) -> None:
    """Add --frame."""
    parser.add_argument("--frame", type=frame_number, help="default: the file's; a fraction is between frames")


def open_scene(options):
    """Open the file that the options name, and return its scene with our engine and the camera that they ask for."""
    path = options.file
    if path is not None:
        open_file(path, options.enable_autoexec)
    elif not bpy.app.binary_path:
        raise InputError("no file is open: give the path of a .blend")
    signals.raise_if_stopping()
    scene = bpy.context.scene
    scene.render.engine = CameraRayCaster.bl_idname
    if options.camera is not None:
        use_camera(scene, find_camera(scene, options.camera))
    if options.calibration is not None:
        check_camera(scene, scene.camera)
        set_calibration(scene.camera.data, str(options.calibration.absolute()), options.calibration_camera)
    elif options.calibration_camera:
        raise InputError("--calibration-camera names one of --calibration FILE: give that, too")
    return scene


def use_camera(scene, camera) -> None:
    """Make a camera the scene's own at every frame."""
    for marker in scene.timeline_markers:
        marker.camera = None  # it would take the camera's place at its frame
    scene.camera = camera


def go_to(scene, frame: float | None) -> None:
    """Set the scene's frame, if one is asked for."""
    if frame is not None:
        scene.frame_set(math.floor(frame), subframe=frame - math.floor(frame))


def warn(prog: str, line: str) -> None:
    """Print a warning."""
    print(f"{prog}: warning: {line}", file=sys.stderr)


def stem() -> str:
    """Return what the open file's outputs are called."""
    return Path(bpy.data.filepath).stem or "untitled"


def show(report: Report, json: bool, last_line: str) -> None:
    """Print a report."""
    print(as_json(report) if json else "\n".join((*as_lines(report), "", last_line)), flush=True)
