"""EXR images by Blender's own OpenImageIO: all channels with their numbers, where Blender's images have four."""

import sys
from pathlib import Path

import bpy
import numpy as np

from ...core import memory
from ...core.programs.parts import ray_exr
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


def channels_of(path: str) -> dict[str, np.ndarray]:
    """Return the channels of a file by name, (rows, columns) from the top; see ``ray_exr.decoder``."""
    library = openimageio()
    file = library.ImageInput.open(path)
    if file is None:
        raise ValueError(f"it cannot be read: {_line(library.geterror())}")
    channels: dict[str, np.ndarray] = {}
    subimage = 0
    while file.seek_subimage(subimage, 0):
        spec = file.spec()
        kinds = spec.channelformats or [spec.format] * spec.nchannels
        size = 8 * spec.width * spec.height * spec.nchannels
        memory.require(size, f"the channels of {path!r}", "give a smaller file")
        pixels = file.read_image(subimage, 0, 0, spec.nchannels, "float")
        if pixels is None:
            raise ValueError(f"it is damaged: {_line(file.geterror())}")
        for k, (name, kind) in enumerate(zip(spec.channelnames, kinds, strict=True)):
            channels[name] = pixels[..., k].astype(np.float16 if str(kind) == "half" else np.float32, copy=False)
        subimage += 1
    file.close()
    return channels


def _line(text: str) -> str:
    return " ".join(text.split())


ray_exr.decoder = channels_of
