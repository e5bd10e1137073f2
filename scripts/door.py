"""What the scripts for a terminal share: the way into the add-on beside them, with pip's bpy or inside Blender.

An extension that is installed and enabled steps aside for this process: the scripts run the code that they lie beside.
"""

import sys
from pathlib import Path

from ends import listen  # they lie beside this file
from kept_memory import keep_memory

ADDON = Path(__file__).resolve().parents[1] / "addon"
ENGINE = "CAMERA_RAY_CASTER"


def through(command: str) -> int:
    """Run a command of the add-on's terminal with this process's arguments and return its exit status."""
    sys.path.insert(0, str(ADDON))
    from camera_ray_caster.blender.terminal.standard_output import keep_output

    keep_output()
    try:
        import bpy
    except ModuleNotFoundError:
        print(f"{command}.py: needs Blender or pip's bpy: `make cast` sets it up", file=sys.stderr)
        return 2
    import addon_utils

    if not bpy.app.binary_path:  # a process of our own, not somebody's Blender
        keep_memory()
    installed = bpy.types.RenderEngine.bl_rna_get_subclass_py(ENGINE)
    if installed is not None:
        addon_utils.disable(package_of(installed))
    import camera_ray_caster
    from camera_ray_caster.blender.terminal import commands, signals

    listen(signals.stop)
    camera_ray_caster.register()
    try:
        return commands.main(command, _arguments(bool(bpy.app.binary_path)), f"{command}.py")
    finally:
        camera_ray_caster.unregister()  # Blender may hang at its end otherwise


def package_of(engine: type) -> str:
    """Return the name of the add-on's package, under which Blender has it, that an engine is of."""
    return engine.__module__.partition(".blender.")[0]


def _arguments(inside_blender: bool) -> list[str]:
    """Return the arguments that are ours: inside Blender those after --."""
    if not inside_blender:
        return sys.argv[1:]
    return sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
