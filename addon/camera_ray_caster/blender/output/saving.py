"""Files that Blender writes: complete, or refused with the system's reason.

For a full disk Blender reports "Invalid argument" or "No such file or directory". It reports nothing for a PNG file or
a compressed .blend, and leaves a truncated file.
"""

import os
import struct
import sys
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext, redirect_stdout, suppress
from pathlib import Path
from tempfile import TemporaryFile

import bpy

from ...core.records import InputError
from ..process.opening import reported, scripts_given_back
from ..process.standard_output import quiet_errors

PICTURE = {
    "media_type": "IMAGE",
    "file_format": "PNG",
    "views_format": "INDIVIDUAL",
    "color_mode": "RGBA",
    "color_depth": "8",
}
LAYERS = {
    "media_type": "MULTI_LAYER_IMAGE",
    "file_format": "OPEN_EXR_MULTILAYER",
    "views_format": "INDIVIDUAL",  # one file per view: every reader supports it
    "color_depth": "32",
    "exr_codec": "ZIP",
    "use_exr_interleave": True,  # one part: every reader supports it, at any pixel aspect
}
"""Image settings by Blender's names, in the order in which they must be set."""

PROBE = 1 << 20
"""Number of bytes that can still be written after a failure; if they cannot, the disk is full."""
END_OF_PNG = b"IEND\xaeB`\x82"
ZSTD, SEEKABLE = b"\x28\xb5\x2f\xfd", 0x8F92EAB1
"""First bytes of a compressed .blend, and the number that ends its table of frames."""


@contextmanager
def blender_writes(folder: Path) -> Iterator[None]:
    """Let Blender write into a folder inside the context; discard what its libraries print on standard error.

    Raises OSError in place of Blender's RuntimeError: with the system's reason if the disk is full, else with Blender's
    message.
    """
    try:
        with quiet_errors(), redirect_stdout(None):
            yield
    except RuntimeError as error:
        check_space(folder)
        raise OSError(0, reported(error)) from error


def check_space(folder: Path) -> None:
    """Raise OSError, with the system's reason, if nothing more can be written into a folder."""
    with TemporaryFile(dir=folder) as probe:
        probe.write(bytes(PROBE))


def check_whole(path: Path) -> None:
    """Raise OSError if a PNG file or a .blend is truncated."""
    is_whole = _tail(path, len(END_OF_PNG)) == END_OF_PNG if path.suffix == ".png" else _is_whole_blend(path)
    if not is_whole:
        check_space(path.parent)
        raise OSError(0, "the file is truncated")


def save_copy(path: Path) -> None:
    """Save a copy of the open file: beside its place, where it is checked and then moved from.

    Raises InputError if the name does not end in .blend or is the open file's own, or if it cannot be written.
    """
    if path.suffix != ".blend":
        raise InputError(f"{str(path)!r} is not the name of a Blender file: give a name that ends in .blend")
    target = path.resolve()
    if bpy.data.filepath and target == Path(bpy.data.filepath).resolve():
        raise InputError(f"{str(path)!r} is the open file: give the copy another name")
    draft = target.with_name(f".writing_{target.name}")
    of_blender = Path(f"{draft}@")
    try:
        for left in (draft, of_blender):  # by a run that was killed
            left.unlink(missing_ok=True)
        # Blender writes and then renames the second one, or removes it if the disk is full: open, its space stays taken
        held = nullcontext() if sys.platform == "win32" else of_blender.open("xb")
        with held, scripts_given_back(), blender_writes(target.parent):
            bpy.ops.wm.save_as_mainfile(filepath=str(draft), copy=True, check_existing=False)
        check_whole(draft)
        os.replace(draft, target)
    except OSError as error:
        raise InputError(f"cannot write {str(path)!r}: {error.strerror}; choose another place") from error
    finally:
        for left in (draft, of_blender):
            with suppress(OSError):
                left.unlink(missing_ok=True)


def _is_whole_blend(path: Path) -> bool:
    """Whether a .blend ends in its last block; or, compressed, in a table of all its frames.

    Reference: Zstandard Seekable Format.
    """
    size = path.stat().st_size
    with path.open("rb") as file:
        compressed = file.read(4) == ZSTD
    if not compressed:
        return b"ENDB" in _tail(path, 64)
    if size < 17 or struct.unpack("<I", _tail(path, 4))[0] != SEEKABLE:
        return False
    frames = struct.unpack("<I", _tail(path, 9)[:4])[0]
    table = 17 + 8 * frames  # its header of 8 bytes, two numbers a frame, its end of 9 bytes
    if size < table:
        return False
    sizes = struct.unpack(f"<{2 * frames}I", _tail(path, table)[8:-9])
    return sum(sizes[::2]) + table == size


def _tail(path: Path, count: int) -> bytes:
    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - count))
        return file.read()
