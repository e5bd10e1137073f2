"""How the command scripts run the add-on of this source tree, with pip's bpy or inside Blender.

An installed and enabled extension is disabled for this process, so that the scripts run the code of this source tree.
"""

import sys
from pathlib import Path

from ends import listen  # in this folder
from kept_memory import keep_memory

ADDON = Path(__file__).resolve().parents[1] / "addon"
ENGINE = "CAMERA_RAY_CASTER"


def through(command: str) -> int:
    """Run a command of the add-on's terminal with this process's arguments and return its exit status."""
    sys.path.insert(0, str(ADDON))
    from camera_ray_caster.blender.process.standard_output import keep_output

    keep_output()
    try:
        import bpy
    except ImportError as error:  # bpy is not there, or a library of the system that it needs
        print(f"{command}.py: needs Blender or pip's bpy, which `make cast` sets up: {error}", file=sys.stderr)
        return 2
    import addon_utils

    if not bpy.app.binary_path:  # our own process, not a user's Blender
        keep_memory()
    installed = bpy.types.RenderEngine.bl_rna_get_subclass_py(ENGINE)
    if installed is not None:
        addon_utils.disable(package_of(installed))
    import camera_ray_caster
    from camera_ray_caster.blender.process import signals
    from camera_ray_caster.blender.terminal import commands

    listen(signals.stop)
    try:
        camera_ray_caster.register()
    except camera_ray_caster.InputError as error:
        print(f"{command}.py: {error}", file=sys.stderr)
        return 2
    try:
        return commands.main(command, _arguments(bool(bpy.app.binary_path)), f"{command}.py")
    finally:
        camera_ray_caster.unregister()  # otherwise Blender may hang at exit


def package_of(engine: type) -> str:
    """Return the package name under which Blender has enabled the add-on of a render engine class."""
    return engine.__module__.partition(".blender.")[0]


def _arguments(inside_blender: bool) -> list[str]:
    """Return the arguments of the script: inside Blender, those after "--"."""
    if not inside_blender:
        return sys.argv[1:]
    return sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
