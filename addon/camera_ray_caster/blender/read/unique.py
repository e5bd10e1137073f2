"""Unique names of datablocks: linked datablocks may have the name of a local one, or of one of another library."""

from collections.abc import Iterable

import bpy


def unique_name(item, among) -> str:
    """Return the name of a datablock in a collection of ``bpy.data``, such as ``bpy.data.objects``.

    If others have the same name, the name of a linked one is followed by its library's file name in brackets, as
    Blender shows it. A local datablock always has its own name.
    """
    if item.library is None:
        return item.name
    files = [None, *(library.filepath for library in bpy.data.libraries)]
    namesakes = sum(among.get((item.name, file)) is not None for file in files)
    return item.name if namesakes == 1 else item.name_full


def find_unique(name: str, among):
    """Return the datablock with this unique name in a collection of ``bpy.data``; None if there is none."""
    local = among.get((name, None))
    if local is not None:
        return local
    linked = (item for item in among if name in (item.name, item.name_full))
    return next((item for item in linked if unique_name(item, among) == name), None)


def by_name(items: Iterable) -> dict[str, object]:
    """Return objects by their unique names, sorted by name."""
    return dict(sorted((unique_name(item, bpy.data.objects), item) for item in items))


def named(name: str, items: Iterable):
    """Return the object of this unique name, or the only one called so in its own file; None if there is none."""
    known = by_name(items)
    local = [item for item in known.values() if item.name == name]
    return known.get(name) or (local[0] if len(local) == 1 else None)
