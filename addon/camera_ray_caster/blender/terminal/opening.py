"""Opening a .blend without running what it brings along, its Python only where the user lets it; and saving a copy."""

from contextlib import redirect_stdout
from pathlib import Path

import bpy

from ...core.records import InputError

_withheld: list[str] = []
"""Style modules of the open file that were switched off."""


def open_file(path: Path, enable_autoexec: bool = False) -> None:
    """Open a .blend; ``enable_autoexec`` lets its scripts run: drivers in Python, texts that register, style modules.

    Raises InputError where there is no such file, or none that this Blender can open.
    """
    try:
        found = path.is_file()
    except (OSError, ValueError):  # Python may not look; a null character
        found = False
    if not found:
        raise InputError(f"there is no file {str(path)!r}: give the path of a .blend")
    try:
        with redirect_stdout(None):  # where Python's copy of the error would go
            bpy.ops.wm.open_mainfile(filepath=str(path.resolve()), use_scripts=enable_autoexec)
    except RuntimeError as error:
        raise InputError(f"{str(path)!r} is no .blend that this Blender can open: {reported(error)}") from error
    _withheld.clear()
    if not enable_autoexec:
        _withhold_style_modules()


def save_copy(path: Path) -> None:
    """Save the open file under another name; Blender gives it that name when all of it is written.

    Raises InputError for a name that is no .blend or the open file's own, and where it cannot be written.
    """
    if path.suffix != ".blend":
        raise InputError(f"{str(path)!r} is no name of a Blender file: let it end in .blend")
    if bpy.data.filepath and path.resolve() == Path(bpy.data.filepath).resolve():
        raise InputError(f"{str(path)!r} is the file that is open: give its copy another name")
    try:
        with redirect_stdout(None):
            bpy.ops.wm.save_as_mainfile(filepath=str(path.resolve()), copy=True, check_existing=False)
    except (RuntimeError, OSError) as error:
        raise InputError(f"cannot write {str(path)!r}: {reported(error)}; choose another place") from error


def reported(error: Exception) -> str:
    """Return the first thing that an operator reported, without its label."""
    return str(error).strip().splitlines()[0].removeprefix("Error: ")


def not_run() -> tuple[str, ...]:
    """Return a warning of the scripts of the open file that Blender has come upon and not run; () without any."""
    if not (bpy.app.autoexec_fail or _withheld):
        return ()
    first = " ".join((bpy.app.autoexec_fail_message or _withheld[0]).splitlines())
    return (f"scripts in the file were not run, so the picture may be another: --enable-autoexec runs them ({first})",)


def _withhold_style_modules() -> None:
    """Switch off Freestyle's scripts: Blender 5.0 runs them whatever it was told."""
    for scene in bpy.data.scenes:
        for layer in scene.view_layers:
            settings = layer.freestyle_settings
            for module in settings.modules if scene.render.use_freestyle and settings.mode == "SCRIPT" else ():
                if module.use and module.script is not None:
                    module.use = False
                    _withheld.append(f"Freestyle style module {module.script.name!r}")
