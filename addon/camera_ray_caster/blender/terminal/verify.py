"""The command that compares a file's camera with Blender's own answers."""

from collections.abc import Sequence
from dataclasses import replace

from ..verification.check import verified
from . import signals
from .opening import not_run
from .options import add_frame, add_json, command_parser, go_to, open_scene, show, warn


def run(arguments: Sequence[str], prog: str) -> int:
    """Compare a file's camera with Blender's own answers."""
    parser = command_parser(
        prog,
        "Compare the rays of a Blender file's camera with Blender's own frame.",
        f"{prog} blend_scenes/spheres_and_planes.blend --frame 12.5",
        "prints the largest and the median error of the rays beside the bound that each witness can reach.",
    )
    add_frame(parser)
    add_json(parser)
    parser.add_argument("--cycles", action="store_true", help="compare with what Cycles renders of the camera's shader")
    options = parser.parse_args(arguments)
    scene = open_scene(options)
    go_to(scene, options.frame)
    report = replace(verified(scene, options.cycles), warnings=not_run())
    signals.raise_if_stopping()
    for line in report.warnings:
        warn(prog, line)
    show(report, options.json, "All witnesses agree" if report.passed else "A witness disagrees")
    return int(not report.passed)
