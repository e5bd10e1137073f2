"""Unique names of datablocks: linked datablocks may have the name of a local one, or of one of another library."""

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
