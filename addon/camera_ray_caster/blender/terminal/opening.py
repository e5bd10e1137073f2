"""Opening a .blend without running its Python, unless the user allows it; and saving a copy."""

from contextlib import redirect_stdout
from pathlib import Path

import bpy

from ...core.records import InputError

_withheld: list[str] = []
"""Freestyle style modules of the open file that were switched off."""


def open_file(path: Path, enable_autoexec: bool = False) -> None:
    """Open a .blend; ``enable_autoexec`` lets its scripts run: drivers in Python, texts that register, style modules.

    Raises InputError if there is no such file or this Blender cannot open it.
    """
    try:
        found = path.is_file()
    except (OSError, ValueError):  # no permission; a null character
        found = False
    if not found:
        raise InputError(f"there is no file {str(path)!r}: give the path of a .blend file")
    try:
        with redirect_stdout(None):  # Python prints a copy of the error there
            bpy.ops.wm.open_mainfile(filepath=str(path.resolve()), use_scripts=enable_autoexec)
    except RuntimeError as error:
        raise InputError(f"{str(path)!r} is not a .blend file that this Blender can open: {reported(error)}") from error
    _withheld.clear()
    if not enable_autoexec:
        _withhold_style_modules()


def save_copy(path: Path) -> None:
    """Save a copy of the open file; Blender renames a temporary file when it is complete.

    Raises InputError if the name does not end in .blend or is the open file's own, or if it cannot be written.
    """
    if path.suffix != ".blend":
        raise InputError(f"{str(path)!r} is not the name of a Blender file: give a name that ends in .blend")
    if bpy.data.filepath and path.resolve() == Path(bpy.data.filepath).resolve():
        raise InputError(f"{str(path)!r} is the open file: give the copy another name")
    try:
        with redirect_stdout(None):
            bpy.ops.wm.save_as_mainfile(filepath=str(path.resolve()), copy=True, check_existing=False)
    except (RuntimeError, OSError) as error:
        raise InputError(f"cannot write {str(path)!r}: {reported(error)}; choose another place") from error


def reported(error: Exception) -> str:
    """Return the first line of an operator's error, without the label "Error: "."""
    return str(error).strip().splitlines()[0].removeprefix("Error: ")


def not_run() -> tuple[str, ...]:
    """Return a warning, in a tuple, if Blender did not run some scripts of the open file; else ()."""
    if not (bpy.app.autoexec_fail or _withheld):
        return ()
    first = " ".join((bpy.app.autoexec_fail_message or _withheld[0]).splitlines())
    return (
        f"scripts in the file were not run, so the picture may differ: --enable-autoexec runs the scripts ({first})",
    )


def _withhold_style_modules() -> None:
    """Switch off Freestyle's style modules: Blender 5.0 runs them even with ``use_scripts=False``."""
    for scene in bpy.data.scenes:
        for layer in scene.view_layers:
            settings = layer.freestyle_settings
            for module in settings.modules if scene.render.use_freestyle and settings.mode == "SCRIPT" else ():
                if module.use and module.script is not None:
                    module.use = False
                    _withheld.append(f"Freestyle style module {module.script.name!r}")
