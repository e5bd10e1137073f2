"""Cast passes as Image datablocks: float pictures, one a pass, which the next cast replaces."""

from __future__ import annotations

from collections.abc import Mapping

import bpy
import numpy as np

from ..engine.passes import stored

PREFIX = "Ray Caster "


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
    if image is None or not (image.source == "GENERATED" and image.is_float):
        return bpy.data.images.new(name, width, height, alpha=True, float_buffer=True)
    image.generated_width, image.generated_height = width, height
    return image


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
