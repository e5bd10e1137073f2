"""The command that saves a copy of a file with its camera as a custom camera of Cycles."""

from collections.abc import Sequence
from pathlib import Path

from ..cycles import to_cycles
from ..output.saving import save_copy
from ..process import signals
from ..process.opening import not_run
from .options import command_parser, open_scene, warn


def run(arguments: Sequence[str], prog: str) -> int:
    """Save a copy of a file whose camera is a custom camera of Cycles; return the exit status."""
    parser = command_parser(
        prog,
        "Save a copy of a Blender file whose camera renders in Cycles with the add-on's rays, also in a Blender "
        "without the add-on.",
        f"{prog} blend_scenes/toys.blend --output toys_in_cycles.blend",
        "prints which changes the copy cannot follow without the add-on, and what was changed in the scene.",
        ends="exit status: 0 done; 2 bad input.",
    )
    parser.add_argument(
        "--output", type=Path, required=True, metavar="COPY.blend", help="path of the .blend file to write"
    )
    options = parser.parse_args(arguments)
    scene = open_scene(options)
    remarks = to_cycles(scene)
    scene.render.engine = "CYCLES"  # set last: Cycles would compile an unfinished setup
    for line in not_run():
        warn(prog, line)
    signals.raise_if_stopping()
    save_copy(options.output)
    print("\n".join((*remarks, f"Wrote {options.output}")), flush=True)
    return 0
