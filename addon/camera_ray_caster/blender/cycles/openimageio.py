"""Blender's own OpenImageIO, which oslquery needs."""

import sys
from pathlib import Path

import bpy

from ...core.records import InputError


def openimageio():
    """Return Blender's OpenImageIO. A Python that imports bpy does not search its folder, and may have another one.

    Raises InputError if this Blender has none, as builds by others than its makers, or if another was imported before.
    """
    before = list(sys.path)
    folders = list(Path(bpy.utils.system_resource("PYTHON")).glob("lib/python*/site-packages"))
    sys.path[:0] = map(str, folders)
    try:
        import OpenImageIO
    except ModuleNotFoundError as error:
        raise InputError("this build of Blender has no OpenImageIO: use a build from blender.org") from error
    finally:
        sys.path[:] = before
    taken = Path(OpenImageIO.__file__)
    if any((folder / "OpenImageIO").is_dir() and not taken.is_relative_to(folder) for folder in folders):
        raise InputError(
            f"Blender's own OpenImageIO is needed, but {taken} is already imported: import it after this call"
        )
    return OpenImageIO
