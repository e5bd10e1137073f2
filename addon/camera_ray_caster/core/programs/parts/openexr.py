"""EXR images by OpenImageIO, which Blender has: all channels with their numbers, where Blender's images have four.

It is imported where an image is read, and nothing else of core needs it.
"""

from __future__ import annotations

import sys
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from ... import memory
from ...records import InputError

PACKAGES = "python/lib/python*/site-packages"
"""Packages of Blender's Python, in the folder of its version."""


def openimageio():
    """Return OpenImageIO: Blender's where there is a bpy, whose Python does not search its folder and may have another.

    Raises InputError if there is none, as in builds by others than Blender's makers, or if another was imported before.
    """
    before = list(sys.path)
    folders = _packages_of_blender()
    sys.path[:0] = map(str, folders)
    try:
        import OpenImageIO
    except ModuleNotFoundError as error:
        raise InputError("this Python has no OpenImageIO: use a build of Blender from blender.org or bpy") from error
    finally:
        sys.path[:] = before
    taken = Path(OpenImageIO.__file__)
    if any((folder / "OpenImageIO").is_dir() and not taken.is_relative_to(folder) for folder in folders):
        raise InputError(
            f"Blender's own OpenImageIO is needed, but {taken} is already imported: import it after this call"
        )
    return OpenImageIO


def _packages_of_blender() -> list[Path]:
    """Return the folders of packages of the Blender that bpy is of; none without bpy. Its file is
    bpy/VERSION/scripts/modules/bpy/__init__.py where it is imported, and bpy/__init__.* of pip's before.
    """
    spec = find_spec("bpy")
    if spec is None or spec.origin is None:
        return []
    file = Path(spec.origin)
    return [folder for root in (*file.parents[3:4], *file.parent.glob("*")) for folder in root.glob(PACKAGES)]


def channels_of(path: str) -> dict[str, np.ndarray]:
    """Return the channels of a file by name, (rows, columns) from the top: float16 those of half floats, else float32.

    Raises InputError without OpenImageIO, and ValueError with the reason, in one line, for a file that cannot be read.
    """
    library = openimageio()
    file = library.ImageInput.open(path)
    if file is None:
        raise ValueError(f"it cannot be read: {_line(library.geterror())}")
    channels: dict[str, np.ndarray] = {}
    part = 0
    while file.seek_subimage(part, 0):
        spec = file.spec()
        kinds = spec.channelformats or [spec.format] * spec.nchannels
        size = 8 * spec.width * spec.height * spec.nchannels
        memory.require(size, f"the channels of {path!r}", "give a smaller file")
        pixels = file.read_image(part, 0, 0, spec.nchannels, "float")
        if pixels is None:
            raise ValueError(f"it is damaged: {_line(file.geterror())}")
        for k, (name, kind) in enumerate(zip(spec.channelnames, kinds, strict=True)):
            channels[name] = pixels[..., k].astype(np.float16 if str(kind) == "half" else np.float32, copy=False)
        part += 1
    file.close()
    return channels


def _line(text: str) -> str:
    return " ".join(text.split())
