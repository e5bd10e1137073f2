"""The texels of Blender's images, read once and shared between materials."""

import os
from zlib import crc32

import bpy
import numpy as np
from bpy.app.handlers import persistent

from ...core import memory
from ...core.materials.images import Texels
from ...core.records import InputError

MOST_TEXELS = 64 << 20
"""Images with more texels are not read."""

LINEAR = ("Linear Rec.709", "Linear", "scene_linear")
"""Names of the color space of stored bytes that need no conversion, besides sRGB and data."""


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
    found = _read(image) if wide * high else None
    if before is not None and _same(before[1], found):
        found = before[1]
    _known[key] = state, found
    return found


def _kind(image) -> str:
    return {"TILED": "set of UDIM tiles", "MOVIE": "movie", "SEQUENCE": "sequence"}.get(image.source, "render result")


def _state(image) -> tuple:
    """Return what tells whether an image is as it was read; changes by painting are seen by ``is_dirty``."""
    packed = image.packed_file
    path = bpy.path.abspath(image.filepath_from_user(), library=image.library)
    try:
        on_disk = None if packed else os.stat(path).st_mtime_ns
    except (OSError, ValueError):
        on_disk = None
    return (
        tuple(image.size), path, on_disk, crc32(packed.data) if packed else 0, image.source, image.alpha_mode,
        image.colorspace_settings.name, image.generated_type, tuple(image.generated_color), image.is_dirty,
    )  # fmt: skip


def _read(image) -> Texels:
    (wide, high), channels, space = image.size, image.channels, image.colorspace_settings
    try:
        memory.require(20 * wide * high, f"the texels of image {image.name!r}", "use a smaller image")
    except InputError as error:
        raise Unreadable(str(error)) from error
    if not (image.is_float or space.is_data or space.name == "sRGB" or space.name in LINEAR):
        raise Unreadable(f"its image {image.name!r} has the color space {space.name}, which is not read")
    values = np.empty(wide * high * channels, np.float32)
    image.pixels.foreach_get(values)
    values = values.reshape(high, wide, channels)
    texels = np.ones((high, wide, 4), np.float32)
    if channels < 3:
        texels[..., :3] = values[..., :1]
    else:
        texels[..., :channels] = values
    if image.alpha_mode == "NONE":
        texels[..., 3] = 1
    is_data = space.is_data or image.alpha_mode in {"NONE", "CHANNEL_PACKED"}
    if image.is_float:
        return Texels(image.name, np.nan_to_num(texels, nan=0.0, posinf=0.0, neginf=0.0), False, is_data)
    if not is_data:
        texels[..., :3] *= texels[..., 3:]  # as Cycles stores them
    texels *= 255
    stored = np.rint(np.nan_to_num(texels), out=texels).astype(np.uint8)
    return Texels(image.name, stored, space.name == "sRGB", is_data)


def _same(one: Texels | None, other: Texels | None) -> bool:
    return one is other or (
        one is not None
        and other is not None
        and (one.is_srgb, one.is_data) == (other.is_srgb, other.is_data)
        and np.array_equal(one.texels, other.texels)
    )


@persistent
def forget(*_):
    """Discard all images when another file is loaded."""
    _known.clear()
