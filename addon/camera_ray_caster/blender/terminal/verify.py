"""The command that compares a file's camera with Blender's own results."""

from collections.abc import Sequence
from dataclasses import replace

from ..process import signals
from ..process.opening import not_run
from ..verification.check import verified
from .options import add_frame, add_json, command_parser, go_to, open_scene, show, warn


def run(arguments: Sequence[str], prog: str) -> int:
    """Compare a file's camera with Blender's own results; return the exit status."""
    parser = command_parser(
        prog,
        "Compare the rays of a Blender file's camera with Blender's own frame.",
        f"{prog} blend_scenes/spheres_and_planes.blend --frame 12.5",
        "prints the largest and the median error of the rays, and the error bound of each reference check.",
    )
    add_frame(parser)
    add_json(parser)
    parser.add_argument(
        "--with-cycles",  # Cycles itself reads what begins with --cycles, and ends Blender
        action="store_true",
        help="also compare the rays with a picture that Cycles renders with the camera's shader",
    )
    options = parser.parse_args(arguments)
    scene = open_scene(options)
    go_to(scene, options.frame)
    report = replace(verified(scene, options.with_cycles), warnings=not_run())
    signals.raise_if_stopping()
    for line in report.warnings:
        warn(prog, line)
    show(report, options.json, report.verdict)
    return int(not report.passed)
