"""The texels of Blender's images, read once and shared between materials."""

import os
from pathlib import Path
from zlib import crc32

import bpy
import imbuf
import numpy as np
from bpy.app.handlers import persistent

from ...core import memory
from ...core.materials.textures import Texels
from ...core.records import InputError

MOST_TEXELS = 64 << 20
"""Images with more texels are not read."""

LINEAR = ("Linear Rec.709", "Linear", "scene_linear")
"""Names of the color space of stored bytes that need no conversion, besides sRGB and data."""


HAS_BYTES = hasattr(imbuf.types.ImBuf, "with_buffer")
"""Whether Python can read the bytes of an image file that Blender loads: from Blender 5.2 on."""

STRIP = 1 << 18
"""Texels that are converted at once."""


class Unreadable(Exception):
    """An image that is not read, with the reason."""


_known: dict[int, tuple[tuple, Texels | None]] = {}
"""Images and the state in which they were read, by their session_uid."""


def image_of(image) -> Texels | None:
    """Return an image's texels; None if Blender cannot load it. Raises Unreadable for images that are not read."""
    if image.source not in {"FILE", "GENERATED"} or image.type not in {"IMAGE", "UV_TEST"}:
        raise Unreadable(f"its image {image.name!r} is a {_kind(image)}, which is not read")
    wide, high = image.size
    if wide * high > MOST_TEXELS:
        raise Unreadable(f"its image {image.name!r} has {wide * high:,} texels, more than {MOST_TEXELS:,}")
    key, state = image.session_uid, _state(image)
    before = _known.get(key)
    if before is not None and before[0] == state and not image.is_dirty:
        return before[1]
    texels = _read(image) if wide * high else None
    if before is not None and _same(before[1], texels):
        texels = before[1]
    _known[key] = state, texels
    return texels


def pixels_of(image) -> np.ndarray:
    """Return an image's pixels as Blender has them, (rows, columns, channels) float32, row 0 at the bottom."""
    (wide, high), channels = image.size, image.channels
    values = np.empty(wide * high * channels, np.float32)
    image.pixels.foreach_get(values)
    return values.reshape(high, wide, channels)


def pixels_of_file(path: Path) -> np.ndarray:
    """Return the numbers in an image file, without conversion of colors: see ``pixels_of``."""
    image = bpy.data.images.load(str(path))
    try:
        image.colorspace_settings.is_data = True
        return pixels_of(image)
    finally:
        bpy.data.images.remove(image)


def _kind(image) -> str:
    return {"TILED": "set of UDIM tiles", "MOVIE": "movie", "SEQUENCE": "sequence"}.get(image.source, "render result")


def _path(image) -> str:
    return bpy.path.abspath(image.filepath_from_user(), library=image.library)


def _state(image) -> tuple:
    """Return what tells whether an image is as it was read; changes by painting are seen by ``is_dirty``."""
    packed = image.packed_file
    path = _path(image)
    try:
        on_disk = None if packed else os.stat(path).st_mtime_ns
    except (OSError, ValueError):
        on_disk = None
    return (
        tuple(image.size), path, on_disk, crc32(packed.data) if packed else 0, image.source, image.alpha_mode,
        image.colorspace_settings.name, image.generated_type, tuple(image.generated_color), image.is_dirty,
    )  # fmt: skip


def _read(image) -> Texels:
    """Return the texels of an image. Those of bytes take 8 bytes per texel on the way, beside Blender's 4, or 16 where
    Blender gives no access to the bytes.
    """
    (wide, high), space = image.size, image.colorspace_settings
    is_file = HAS_BYTES and image.source == "FILE" and not (image.is_float or image.is_dirty)
    is_file &= image.alpha_mode != "PREMUL"  # Blender's pixels are divided by alpha then
    try:
        needed = (8 if is_file else 16) * wide * high
        memory.require(needed, f"the texels of image {image.name!r}", "use a smaller image")
    except InputError as error:
        raise Unreadable(str(error)) from error
    if not (image.is_float or space.is_data or space.name == "sRGB" or space.name in LINEAR):
        raise Unreadable(f"its image {image.name!r} has the color space {space.name}, which is not read")
    is_data = space.is_data or image.alpha_mode in {"NONE", "CHANNEL_PACKED"}
    stored = (_loaded(image) if is_file else None) if wide * high else None
    if stored is None:
        stored = _fetched(image)
    for first in range(0, len(stored), STRIP):
        strip = stored[first : first + STRIP]
        if image.alpha_mode == "NONE":
            strip[:, 3] = 1 if image.is_float else 255
        if not (is_data or image.is_float):  # colors of bytes are multiplied by alpha, as Cycles stores them
            strip[:, :3] = (strip[:, :3].astype(np.uint16) * strip[:, 3:] + 127) // 255
    return Texels(image.name, stored.reshape(high, wide, 4), space.name == "sRGB" and not image.is_float, is_data)


def _loaded(image) -> np.ndarray | None:
    """Return the bytes of an image's file, (n, 4) uint8, as Blender's loader gives them; None if that fails."""
    packed = image.packed_file
    try:
        buffer = imbuf.load_from_buffer(packed.data) if packed else imbuf.load(_path(image))
    except (OSError, ValueError):
        return None
    try:
        if buffer.buffer_type != "BYTE" or buffer.size != tuple(image.size):
            return None
        with buffer.with_buffer() as view:
            return np.array(view).reshape(-1, 4)
    finally:
        buffer.free()


def _fetched(image) -> np.ndarray:
    """Return the pixels of an image with four channels, (n, 4): bytes, or float32 that are finite."""
    (wide, high), channels = image.size, image.channels
    values = np.empty(wide * high * channels, np.float32)
    image.pixels.foreach_get(values)
    if image.is_float:
        rows = values.reshape(-1, channels)
        np.nan_to_num(rows, copy=False, nan=0.0, posinf=0.0, neginf=0.0)
        return rows if channels == 4 else _four(rows)
    stored = values.view(np.uint8)[: 4 * wide * high].reshape(-1, 4)  # in the same memory, from its beginning
    for first in range(0, len(stored), STRIP):
        rows = _four(values[first * channels : (first + STRIP) * channels].reshape(-1, channels))
        stored[first : first + STRIP] = np.rint(rows * 255)
    del stored
    values.resize(wide * high, refcheck=False)  # which gives the other memory back
    return values.view(np.uint8).reshape(-1, 4)


def _four(rows: np.ndarray) -> np.ndarray:
    """Return pixels, (n, channels), as red, green, blue and alpha: one or two channels are gray, and alpha 1."""
    texels = np.ones((len(rows), 4), np.float32)
    if rows.shape[1] < 3:
        texels[:, :3] = rows[:, :1]
    else:
        texels[:, : rows.shape[1]] = rows
    return texels


def _same(first: Texels | None, second: Texels | None) -> bool:
    return first is second or (
        first is not None
        and second is not None
        and (first.is_srgb, first.is_data) == (second.is_srgb, second.is_data)
        and np.array_equal(first.texels, second.texels)
    )


@persistent
def forget(*_):
    """Discard all images when another file is loaded."""
    _known.clear()
