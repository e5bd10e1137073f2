"""EXR images by Blender's own OpenImageIO: all channels with their numbers, where Blender's images have four."""

import sys
from pathlib import Path

import bpy
import numpy as np

from ...core import memory
from ...core.cameras.files import ray_exr
from ...core.records import InputError


def openimageio():
    """Return Blender's OpenImageIO. A Python that imports bpy does not search its folder, and may have another one.

    Raises InputError if the other OpenImageIO was imported before.
    """
    before = list(sys.path)
    folders = list(Path(bpy.utils.system_resource("PYTHON")).glob("lib/python*/site-packages"))
    sys.path[:0] = map(str, folders)
    try:
        import OpenImageIO
    finally:
        sys.path[:] = before
    taken = Path(OpenImageIO.__file__)
    if any((folder / "OpenImageIO").is_dir() and not taken.is_relative_to(folder) for folder in folders):
        raise InputError(
            f"Blender's own OpenImageIO is needed, but {taken} is already imported: import it after this call"
        )
    return OpenImageIO


def channels_of(path: str) -> dict[str, np.ndarray]:
    """Return the channels of a file by name, (rows, columns) float32 from the top; see ``ray_exr.decoder``."""
    library = openimageio()
    file = library.ImageInput.open(path)
    if file is None:
        raise ValueError(f"it cannot be read: {_line(library.geterror())}")
    channels: dict[str, np.ndarray] = {}
    part = 0
    while file.seek_subimage(part, 0):
        spec = file.spec()
        kinds = {str(kind) for kind in spec.channelformats} or {str(spec.format)}
        if "half" in kinds:
            raise ValueError("its numbers are half floats, which turn rays by up to 2.4e-4 radians: save it as float32")
        size = 8 * spec.width * spec.height * spec.nchannels
        memory.require(size, f"the channels of {path!r}", "give a smaller table")
        pixels = file.read_image(part, 0, 0, spec.nchannels, "float")
        if pixels is None:
            raise ValueError(f"it is damaged: {_line(file.geterror())}")
        channels |= {name: pixels[..., k] for k, name in enumerate(spec.channelnames)}
        part += 1
    file.close()
    return channels


def _line(text: str) -> str:
    return " ".join(text.split())


ray_exr.decoder = channels_of
