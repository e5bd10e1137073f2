"""The command that renders frames of a Blender file to pictures, EXR files and reports."""

from collections.abc import Sequence
from pathlib import Path

from ...core.casting.passes import PASSES
from ...core.casting.request import PRECISIONS, SHADINGS
from ...core.records import InputError
from ..cycles.device import said_of_device
from ..cycles.picture import Picture, picture_of
from ..cycles.shader import check_cycles
from ..engine.engine import CameraRayCaster
from ..engine.passes import tick, ticked
from ..output import files
from ..read.scene import read_camera
from . import signals
from .options import add_frame, add_json, command_parser, go_to, open_scene, show, stem, warn
from .words import add_frames, joined, pass_names, sample_count

CYCLES = "CYCLES"
ENGINES = CameraRayCaster.bl_idname, CYCLES

DEFAULT_PASSES = ("combined", "depth", "normal", "position", "object_index")
"""What is cast of a view layer that ticks nothing beside combined."""


def run(arguments: Sequence[str], prog: str) -> int:
    """Render frames of a file to pictures, EXR files and reports."""
    parser = command_parser(
        prog,
        "Cast the rays of a Blender file's camera at what it shows.",
        f"{prog} blend_scenes/spheres_and_planes.blend --output out --passes combined,depth",
        "writes out/spheres_and_planes.png, the 32-bit multilayer out/spheres_and_planes.exr with a layer a pass, and "
        "out/report.json; with --frames each name ends in its frame's number.",
    )
    frames = parser.add_mutually_exclusive_group()
    add_frame(frames)
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
    add_json(parser)
    options = parser.parse_args(joined(arguments, "--frames"))
    by_cycles = options.engine == CYCLES
    if options.samples and not by_cycles:
        raise InputError(f"--samples is for --engine {CYCLES}: the file has our own samples")
    if by_cycles:
        check_cycles()
    scene = open_scene(options)
    if by_cycles:
        scene.cycles.samples = options.samples or scene.cycles.samples
        for line in said_of_device(scene):
            warn(prog, line)
    for layer in scene.view_layers:
        if options.passes or [entry.key for entry in ticked(scene, layer)] == ["combined"]:
            tick(scene, layer, options.passes or DEFAULT_PASSES)
    for setting in ("shading", "precision"):
        if getattr(options, setting):
            setattr(scene.camera_ray_caster, setting, getattr(options, setting))
    passed, warned = True, set()
    for frame in options.frames or [options.frame]:
        go_to(scene, frame)
        read_camera(scene)  # a camera that cannot be cast is refused before anything is made
        number = f"_{frame:04d}" if options.frames else ""
        picture = _by_cycles(scene, prog) if by_cycles else None
        report, paths = files.render(scene, options.output, stem(), number, options.file_output, picture)
        for line in report.warnings:
            if line not in warned:
                warn(prog, line)
                warned.add(line)
        show(report, options.json, f"Wrote {', '.join(map(str, paths))}")
        passed &= report.passed
    return int(not passed)


def _by_cycles(scene, prog: str) -> Picture:
    """Render the current frame with Cycles, whose work no signal's handler can end."""
    files.check(scene)
    with signals.leaving(f"{prog}: {signals.STOPPED}"):
        return picture_of(scene)
