"""The command ``camera-ray-caster COMMAND FILE.blend ...``, or ``python -m camera_ray_caster``, with pip's bpy."""

import signal
import sys


def main() -> int:
    """Run a command with the arguments of this process; return its exit status: see ``blender.terminal.commands``."""
    command, *arguments = sys.argv[1:] or [""]
    try:
        from .blender import registration
        from .blender.process import signals
        from .blender.terminal import commands
    except ImportError as error:
        missing = "pip's bpy, as camera-ray-caster[blender] brings it"
        print(f"camera-ray-caster: needs {missing}, or a library of the system: {error}", file=sys.stderr)
        return 2
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signals.stop)
    registration.register()
    try:
        return commands.main(command, arguments, f"camera-ray-caster {command}".strip())
    finally:
        registration.unregister()  # otherwise Blender may hang at exit


if __name__ == "__main__":
    sys.exit(main())
