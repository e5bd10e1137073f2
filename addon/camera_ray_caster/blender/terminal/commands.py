"""The commands for a terminal: arguments in, files and a table out, and an exit status.

Status 0: done; 1: done, but a witness disagrees with the camera's rays; 2: bad input, one line on standard error;
130: stopped by Ctrl C or another signal that ends a process.
"""

import argparse
import math
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from textwrap import fill

import bpy

from ...core.casting.passes import PASSES
from ...core.casting.request import PRECISIONS, SHADINGS
from ...core.records import Cancelled, InputError
from ...core.report.report import WIDTH, Report, as_json, as_lines
from ..cycles import to_cycles as make_custom
from ..cycles.device import said_of_device
from ..cycles.picture import Picture, picture_of
from ..cycles.shader import check_cycles
from ..engine.engine import CameraRayCaster
from ..engine.passes import tick, ticked
from ..output import files
from ..properties.calibration import set_calibration
from ..read.camera import check_camera, find_camera
from ..read.scene import read_camera
from ..verification.check import verified
from . import signals
from .opening import not_run, open_file, save_copy
from .standard_output import keep_output
from .words import Parser, add_frames, frame_number, joined, pass_names, sample_count

STOPPED = "stopped; what was under way has left nothing"

CYCLES = "CYCLES"
ENGINES = CameraRayCaster.bl_idname, CYCLES

DEFAULT_PASSES = ("combined", "depth", "normal", "position", "object_index")
"""What is cast of a view layer that ticks nothing beside combined."""


def main(command: str, arguments: Sequence[str], prog: str) -> int:
    """Run a command of COMMANDS and return its exit status."""
    try:
        if command not in COMMANDS:
            raise InputError(f"there is no command {command!r}: choose from {', '.join(COMMANDS)}")
        return COMMANDS[command](arguments, prog)
    except InputError as error:
        print(f"{prog}: {error}", file=sys.stderr)
        return 2
    except (Cancelled, KeyboardInterrupt):
        print(f"{prog}: {STOPPED}", file=sys.stderr)
        return 130
    finally:
        signals.reset()


def cast(arguments: Sequence[str], prog: str) -> int:
    """Render frames of a file to pictures, EXR files and reports."""
    parser = _parser(
        prog,
        "Cast the rays of a Blender file's camera at what it shows.",
        f"{prog} blend_scenes/spheres_and_planes.blend --output out --passes combined,depth",
        "writes out/spheres_and_planes.png, the 32-bit multilayer out/spheres_and_planes.exr with a layer a pass, and "
        "out/report.json; with --frames each name ends in its frame's number.",
    )
    frames = parser.add_mutually_exclusive_group()
    _add_frame(frames)
    add_frames(frames)
    parser.add_argument("--passes", type=pass_names, metavar="A,B,...", help=f"of {', '.join(PASSES)}; default: what "
                        f"the file ticks, or {', '.join(DEFAULT_PASSES)} where it ticks only combined")  # fmt: skip
    parser.add_argument("--shading", type=str.upper, choices=SHADINGS, help="of the combined pass; default: the file's")
    parser.add_argument("--precision", type=str.upper, choices=PRECISIONS,
                        help="what hits are searched with; default: the file's")  # fmt: skip
    parser.add_argument("--engine", type=str.upper, choices=ENGINES, default=ENGINES[0],
                        help="of the combined pass; our passes stand beside it; default: %(default)s")  # fmt: skip
    parser.add_argument("--samples", type=sample_count, metavar="N", help="of Cycles, a pixel; default: the file's")
    parser.add_argument("--output", type=Path, default=Path("out"), metavar="FOLDER", help="default: %(default)s")
    parser.add_argument("--file-output", action="store_true",
                        help="let the compositor's File Output nodes write; default: they do not")  # fmt: skip
    _add_json(parser)
    options = parser.parse_args(joined(arguments, "--frames"))
    by_cycles = options.engine == CYCLES
    if options.samples and not by_cycles:
        raise InputError(f"--samples is for --engine {CYCLES}: the file has our own samples")
    if by_cycles:
        check_cycles()
    scene = _open(options)
    if by_cycles:
        scene.cycles.samples = options.samples or scene.cycles.samples
        for line in said_of_device(scene):
            _warn(prog, line)
    for layer in scene.view_layers:
        if options.passes or [entry.key for entry in ticked(scene, layer)] == ["combined"]:
            tick(scene, layer, options.passes or DEFAULT_PASSES)
    for setting in ("shading", "precision"):
        if getattr(options, setting):
            setattr(scene.camera_ray_caster, setting, getattr(options, setting))
    passed, warned = True, set()
    for frame in options.frames or [options.frame]:
        _go_to(scene, frame)
        read_camera(scene)  # a camera that cannot be cast is refused before anything is made
        number = f"_{frame:04d}" if options.frames else ""
        picture = _by_cycles(scene, prog) if by_cycles else None
        report, paths = files.render(scene, options.output, _stem(), number, options.file_output, picture)
        for line in report.warnings:
            if line not in warned:
                _warn(prog, line)
                warned.add(line)
        _show(report, options.json, f"Wrote {', '.join(map(str, paths))}")
        passed &= report.passed
    return int(not passed)


def _by_cycles(scene, prog: str) -> Picture:
    """Render the current frame with Cycles, whose work no signal's handler can end."""
    files.check(scene)
    with signals.leaving(f"{prog}: {STOPPED}"):
        return picture_of(scene)


def verify(arguments: Sequence[str], prog: str) -> int:
    """Compare a file's camera with Blender's own answers."""
    parser = _parser(
        prog,
        "Compare the rays of a Blender file's camera with Blender's own frame.",
        f"{prog} blend_scenes/spheres_and_planes.blend --frame 12.5",
        "prints the largest and the median error of the rays beside the bound that each witness can reach.",
    )
    _add_frame(parser)
    _add_json(parser)
    parser.add_argument("--cycles", action="store_true", help="compare with what Cycles renders of the camera's shader")
    options = parser.parse_args(arguments)
    scene = _open(options)
    _go_to(scene, options.frame)
    report = replace(verified(scene, options.cycles), warnings=not_run())
    signals.raise_if_stopping()
    for line in report.warnings:
        _warn(prog, line)
    _show(report, options.json, "All witnesses agree" if report.passed else "A witness disagrees")
    return int(not report.passed)


def to_cycles(arguments: Sequence[str], prog: str) -> int:
    """Save a copy of a file whose camera is a custom one of Cycles."""
    parser = _parser(
        prog,
        "Save a copy of a Blender file whose camera renders in Cycles with our rays, in a Blender without this add-on.",
        f"{prog} blend_scenes/toys.blend --output toys_in_cycles.blend",
        "prints what the copy cannot follow without the add-on, and what was changed in the scene.",
        ends="exit status: 0 done; 2 bad input.",
    )
    parser.add_argument("--output", type=Path, required=True, metavar="COPY.blend", help="the file to write")
    options = parser.parse_args(arguments)
    scene = _open(options)
    said = make_custom(scene)
    scene.render.engine = "CYCLES"  # not before: it would compile what is half set up
    for line in not_run():
        _warn(prog, line)
    signals.raise_if_stopping()
    save_copy(options.output)
    print("\n".join((*said, f"Wrote {options.output}")), flush=True)
    return 0


COMMANDS = {"cast": cast, "verify": verify, "to_cycles": to_cycles}


def register(undo) -> None:
    """Add ``blender --command camera_ray_caster cast FILE.blend``; see ``registration``."""
    command = bpy.utils.register_cli_command("camera_ray_caster", _from_blender)
    undo.callback(bpy.utils.unregister_cli_command, command)


def _from_blender(arguments: Sequence[str]) -> int:
    keep_output()
    command, *rest = arguments or [""]
    return main(command, rest, f"camera_ray_caster {command}".strip())


ENDS = "exit status: 0 done; 1 done, but the camera's rays disagree with a witness; 2 bad input."


def _parser(prog: str, purpose: str, example: str, result: str, ends: str = ENDS) -> Parser:
    parser = Parser(
        prog=prog,
        description=purpose,
        epilog=f"example:\n  {example}\n{fill(result, WIDTH)}\n\n{fill(ends, WIDTH)}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("file", nargs="?", type=Path, metavar="FILE.blend", help="default: the file that is open")
    parser.add_argument("--camera", metavar="NAME", help="default: the scene's active camera")
    parser.add_argument("--calibration", type=Path, metavar="FILE", help="of OpenCV, ROS, COLMAP, nerfstudio, Kalibr, "
                        "mrcal or Project Aria: the camera's model follows from it")  # fmt: skip
    parser.add_argument("--calibration-camera", default="", metavar="NAME", help="of a file with several cameras")
    parser.add_argument("--enable-autoexec", action="store_true",
                        help="run the Python scripts and drivers of FILE.blend; default: they do not run")  # fmt: skip
    return parser


def _add_json(parser) -> None:
    parser.add_argument("--json", action="store_true", help="print the report as JSON in place of the table")


def _add_frame(parser) -> None:
    parser.add_argument("--frame", type=frame_number, help="default: the file's; a fraction is between frames")


def _open(options):
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
        camera = find_camera(scene, options.camera)
        for marker in scene.timeline_markers:
            marker.camera = None  # it would take the camera's place at its frame
        scene.camera = camera
    if options.calibration is not None:
        check_camera(scene, scene.camera)
        set_calibration(scene.camera.data, str(options.calibration.absolute()), options.calibration_camera)
    elif options.calibration_camera:
        raise InputError("--calibration-camera names one of --calibration FILE: give that, too")
    return scene


def _go_to(scene, frame: float | None) -> None:
    if frame is not None:
        scene.frame_set(math.floor(frame), subframe=frame - math.floor(frame))


def _warn(prog: str, line: str) -> None:
    print(f"{prog}: warning: {line}", file=sys.stderr)


def _stem() -> str:
    return Path(bpy.data.filepath).stem or "untitled"


def _show(report: Report, json: bool, last_line: str) -> None:
    print(as_json(report) if json else "\n".join((*as_lines(report), "", last_line)), flush=True)
