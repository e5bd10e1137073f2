"""Paths of cameras' files relative to the .blend: remapped where Blender remaps its own paths.

Blender does so for the paths of its own datablocks only, when a file is saved in another folder and when datablocks are
appended.
"""

from pathlib import Path

import bpy
from bpy.app.handlers import persistent

from .declared import GROUP, files

_before: list[tuple[object, str, str]] = []
"""Settings of cameras, the names of their paths and the paths, as they were before the file is saved in another folder.

Last is the folder.
"""


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


def _relative(cameras) -> list[tuple[object, str, str]]:
    """Return the local cameras' own settings that have relative paths, with the names of the paths and the paths."""
    settings = [getattr(camera, GROUP) for camera in cameras if camera.library is None]
    paths = [(group, file.name, getattr(group, file.name)) for group in settings for file in files()]
    return [entry for entry in paths if entry[2].startswith("//")]


def _remap(paths, before: str, after: str) -> None:
    """Set the paths, relative to the folder ``before``, as they are relative to ``after``."""
    for group, name, path in paths:
        setattr(group, name, remapped(path, before, after))


@persistent
def remap(path: str, *_):
    """Remap the paths before the file is written to another folder."""
    _before.clear()
    before, after = _folder(bpy.data.filepath), _folder(path)
    if before and after and before != after:
        _before.extend(_relative(bpy.data.cameras))
        _remap(_before, before, after)
        _before.append((None, "", before))


@persistent
def restore(*_):
    """Restore the paths if a copy was saved, or if saving failed: the open file is still in its former folder."""
    if _before and _folder(bpy.data.filepath) == _before.pop()[2]:
        for group, name, path in _before:
            setattr(group, name, path)
    _before.clear()


@persistent
def remap_appended(context, *_):
    """Remap the paths of cameras that were appended from a file in another folder."""
    for item in context.import_items:
        if isinstance(item.id, bpy.types.Camera) and item.source_library is not None:
            before = _folder(bpy.path.abspath(item.source_library.filepath))
            _remap(_relative([item.id]), before, _folder(bpy.data.filepath))


def register(undo) -> None:
    undo.add_handlers(remap, "save_pre")
    undo.add_handlers(restore, "save_post", "save_post_fail")
    undo.add_handlers(remap_appended, "blend_import_post")
