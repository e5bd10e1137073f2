"""Paths of calibration files relative to the .blend: remapped where Blender remaps its own paths.

Blender does so for the paths of its own datablocks only, when a file is saved in another folder and when datablocks are
appended.
"""

from pathlib import Path

import bpy
from bpy.app.handlers import persistent

from ...core.cameras.parts.calibration import FILE
from .declared import GROUP

_before: list[tuple[object, str]] = []
"""Settings of cameras and their paths, as they were before the file is saved in another folder, and last the folder."""


def remapped(path: str, before: str, after: str) -> str:
    """Return a path relative to a folder, which begins with //, relative to another one.

    It is absolute if that is on another drive, or "": the file has not been saved.
    """
    absolute = bpy.path.abspath(path, start=before)
    try:
        return bpy.path.relpath(absolute, start=after) if after else absolute
    except ValueError:
        return absolute


def _folder(path: str) -> str:
    """Return the folder of a file; "" for a file without a path."""
    return str(Path(path).parent) if path else ""


def _relative(cameras) -> list[tuple[object, str]]:
    """Return the local cameras' own settings that have relative paths, and the paths."""
    settings = [getattr(camera, GROUP) for camera in cameras if camera.library is None]
    return [(own, path) for own in settings if (path := getattr(own, FILE.name)).startswith("//")]


@persistent
def remap(path: str, *_):
    """Remap the paths before the file is written to another folder."""
    _before.clear()
    before, after = _folder(bpy.data.filepath), _folder(path)
    if before and after and before != after:
        _before.extend(_relative(bpy.data.cameras))
        for own, value in _before:
            setattr(own, FILE.name, remapped(value, before, after))
        _before.append((None, before))


@persistent
def restore(*_):
    """Restore the paths if a copy was saved, or if saving failed: the open file is still in its former folder."""
    if _before and _folder(bpy.data.filepath) == _before.pop()[1]:
        for own, value in _before:
            setattr(own, FILE.name, value)
    _before.clear()


@persistent
def remap_appended(context, *_):
    """Remap the paths of cameras that were appended from a file in another folder."""
    for item in context.import_items:
        if isinstance(item.id, bpy.types.Camera) and item.source_library is not None:
            before = _folder(bpy.path.abspath(item.source_library.filepath))
            for own, value in _relative([item.id]):
                setattr(own, FILE.name, remapped(value, before, _folder(bpy.data.filepath)))


HANDLERS = (
    ("save_pre", remap), ("save_post", restore), ("save_post_fail", restore), ("blend_import_post", remap_appended),
)  # fmt: skip


def register(undo) -> None:
    """See ``registration``."""
    undo.add_handlers(HANDLERS)
