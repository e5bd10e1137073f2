"""Cast passes as Image datablocks: float pictures, one a pass, saved with the file; the next cast replaces them."""

from __future__ import annotations

from collections.abc import Mapping

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


def store(images: Mapping[tuple[str, str], np.ndarray]) -> list:
    """Write passes, by their keys and views, into their Image datablocks and return these. Only the main thread may."""
    return [_store(*name, pixels) for name, pixels in images.items()]


def _store(key: str, view: str, pixels: np.ndarray):
    height, width = pixels.shape[:2]
    image = _datablock(image_name(key, view), width, height)
    if key != "combined":
        image.colorspace_settings.name = "Non-Color"
    image.pixels.foreach_set(_rgba(stored(key, pixels).reshape(height * width, -1)).ravel())
    image.update()
    return image


def _datablock(name: str, width: int, height: int):
    """Return the float image of that name and size: the one that an earlier cast has made, if it has."""
    image = bpy.data.images.get(name)
    if image is None or not (image.is_float and (image.source == "GENERATED" or image.packed_file)):
        image = bpy.data.images.new(name, width, height, alpha=True, float_buffer=True)
        image.use_fake_user = True  # it is saved also where nothing uses it
        return image
    _unpack(image)
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


def _rgba(pixels: np.ndarray) -> np.ndarray:
    """Return (n, 4): gray where a pass has one channel, no blue where it has two, alpha 1 where it has none."""
    channels = pixels.shape[1]
    if channels == 4:
        return pixels
    rgba = np.ones((len(pixels), 4), np.float32)
    rgba[:, :3] = np.pad(pixels, ((0, 0), (0, 1))) if channels == 2 else pixels
    return rgba


def show(window_manager, images: list) -> None:
    """Show the first of these images in every Image Editor that is open, unless it shows another of them."""
    for window in window_manager.windows:
        for area in window.screen.areas:
            if area.type == "IMAGE_EDITOR" and area.spaces.active.image not in images:
                area.spaces.active.image = images[0]
