"""Cast passes as Image datablocks: float pictures, one a pass, saved with the file; the next cast replaces them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import bpy
import numpy as np
from bpy.app.handlers import persistent

from ...core.report.display import displayed
from ..engine.passes import PASSES, stored

PREFIX = "Ray Caster "
VIEW = "Ray Caster: Shown"
"""The image that shows a pass in colors."""


def image_name(key: str, view: str = "") -> str:
    """Return the name of a pass's Image datablock; ``view``: of a stereo scene."""
    return f"{PREFIX}{key.replace('_', ' ')} {view}".rstrip()


def store(images: Mapping[tuple[str, str], np.ndarray]) -> Iterator[str]:
    """Write passes, by their keys and views, into their Image datablocks; yield the name of each that is written.

    Only the main thread may.
    """
    lent = None
    for (key, view), pixels in images.items():
        height, width = pixels.shape[:2]
        image = _datablock(image_name(key, view), width, height, is_data=key != "combined")
        flat = stored(key, pixels)
        if key != "combined":
            lent = flat = _rgba(flat.reshape(height * width, -1), lent)
        image.pixels.foreach_set(flat.ravel())
        image.update()
        yield image.name


def _datablock(name: str, width: int, height: int, is_data: bool):
    """Return the float image of that name and size: the one that an earlier cast has made, if it has.

    What is set of an image that is there makes Blender free its pixels and fill it anew.
    """
    image = bpy.data.images.get(name)
    if image is None or not (image.is_float and (image.source == "GENERATED" or image.packed_file)):
        image = bpy.data.images.new(name, width, height, alpha=True, float_buffer=True, is_data=is_data)
        image.use_fake_user = True  # it is saved also where nothing uses it
        return image
    if image.packed_file:
        _unpack(image)
    if (image.generated_width, image.generated_height) != (width, height):
        image.generated_width, image.generated_height = width, height
    return image


def _unpack(image) -> None:
    """Make an image that was packed one of pixels in memory."""
    image.source = "GENERATED"
    if image.packed_file:
        image.unpack(method="REMOVE")


def results() -> dict[str, str]:
    """Return the names of the images that casts have made, each with the key of its pass."""
    keys = sorted((entry.key for entry in PASSES), key=len, reverse=True)  # distance bound is no view of distance
    found = {}
    for name in [image.name for image in bpy.data.images]:
        key = next((key for key in keys if f"{name} ".startswith(f"{image_name(key)} ")), None)
        if key is not None:
            found[name] = key
    return found


def show_in_colors(name: str) -> tuple[bpy.types.Image, str]:
    """Return an image that shows the result of that name in what a screen can show, and in words what its colors mean.

    That of the combined pass is the result itself.
    """
    result, key = bpy.data.images[name], results()[name]
    if key == "combined":
        return result, "as it is"
    (width, height), pixels = result.size, np.empty(len(result.pixels), np.float32)
    result.pixels.foreach_get(pixels)
    channels = next(len(entry.channels) for entry in PASSES if entry.key == key)
    colors, said = displayed(key, pixels.reshape(height, width, 4)[..., :channels])
    image = bpy.data.images.get(VIEW)
    if image is None:
        image = bpy.data.images.new(VIEW, width, height)
        image.colorspace_settings.name = "Non-Color"  # numbers, not light
    image.scale(width, height)
    image.pixels.foreach_set(_rgba(colors.reshape(-1, 3)).ravel())
    image.update()
    return image, said


@persistent
def pack(*_) -> None:
    """The file is about to be saved: put what was cast since the last time into it."""
    for name in results():
        image = bpy.data.images[name]
        if image.source == "GENERATED" and image.is_dirty:
            image.pack()


def register(undo) -> None:
    """See ``registration``."""
    undo.add_handlers([("save_pre", pack)])


def _rgba(pixels: np.ndarray, lent: np.ndarray | None = None) -> np.ndarray:
    """Return (n, 4) float32: gray where a pass, (n, channels), has one channel, no blue where it has two; alpha 1.

    ``lent``: what was returned before, to be overwritten. System memory that is new takes longer than the copy.
    """
    count, channels = pixels.shape
    rgba = np.ones((count, 4), np.float32) if lent is None or len(lent) != count else lent
    for k in range(3):  # a channel at a time: a broadcast to all takes four times as long
        rgba[:, k] = pixels[:, min(k, channels - 1)] if channels != 2 or k < 2 else 0
    return rgba


def show(window_manager, names: list[str]) -> None:
    """Show the first of these images in every Image Editor that is open, unless it shows another of them."""
    for window in window_manager.windows:
        for area in window.screen.areas:
            space = area.spaces.active
            if area.type == "IMAGE_EDITOR" and (space.image is None or space.image.name not in names):
                space.image = bpy.data.images.get(names[0])
