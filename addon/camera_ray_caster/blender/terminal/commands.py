"""The entry point of the terminal commands.

Exit status 0: done; 1: done, but an independent reference disagrees with the camera's rays; 2: bad input, with one
line on standard error; 130: stopped by Ctrl C or another signal that ends a process.
"""

import signal
import sys
from collections.abc import Sequence

import bpy

from ...core.memory import limits_as_input
from ...core.records import Cancelled, InputError
from ..process import opening, signals
from ..process.standard_output import keep_output
from ..read import physics
from . import cast, explain, export, to_cycles, verify

COMMANDS = {
    "cast": cast.run,
    "dataset": lambda arguments, prog: cast.run(("--dataset", *arguments), prog),
    "verify": verify.run,
    "explain": explain.run,
    "to_cycles": to_cycles.run,
    "export": export.run,
}


def main(command: str, arguments: Sequence[str], prog: str) -> int:
    """Run a command of COMMANDS and return its exit status."""
    try:
        if command not in COMMANDS:
            raise InputError(f"there is no command {command!r}: choose from {', '.join(COMMANDS)}")
        with limits_as_input():
            return COMMANDS[command](arguments, prog)
    except InputError as error:
        print(f"{prog}: {error}", file=sys.stderr)
        return 2
    except (Cancelled, KeyboardInterrupt):
        print(f"{prog}: {signals.STOPPED}", file=sys.stderr)
        return 130
    finally:
        opening.give_back()
        physics.release()
        signals.reset()


def register(undo) -> None:
    """Register ``blender --command camera_ray_caster cast FILE.blend``; see ``registration``."""
    command = bpy.utils.register_cli_command("camera_ray_caster", _from_blender)
    undo.callback(bpy.utils.unregister_cli_command, command)


def _from_blender(arguments: Sequence[str]) -> int:
    keep_output()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signals.stop)
    command, *options = arguments or [""]
    return main(command, options, f"camera_ray_caster {command}".strip())
