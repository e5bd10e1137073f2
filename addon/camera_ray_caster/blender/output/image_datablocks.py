"""Cast passes as float Image datablocks, one per pass. They are saved in the .blend and replaced by the next cast."""

from collections.abc import Iterator, Mapping

import bpy
import numpy as np
from bpy.app.handlers import persistent

from ...core.report.display import displayed
from ..properties.pass_properties import PASSES, stored
from ..read.texels import pixels_of

PREFIX = "Ray Caster "
VIEW = "Ray Caster: Shown"
"""Name of the image that shows a pass in colors."""
OF = "of"
"""Name of its property with the name of the pass's image."""

_held: dict[str, tuple[str, tuple[int, int], np.ndarray]] = {}
"""Pass, size and pixels of each image during an undo or a redo."""
_editors: list[tuple] = []
"""The spaces of Image Editors that show them, and the names of the images."""
latest: list[str] = []
"""Names of the images of the latest cast since the file was loaded."""


def image_name(key: str, view: str = "") -> str:
    """Return the name of a pass's Image datablock; ``view`` is the view's name in a stereo scene."""
    return f"{PREFIX}{key.replace('_', ' ')} {view}".rstrip()


def store(images: Mapping[tuple[str, str], np.ndarray]) -> Iterator[str]:
    """Write passes, given by (key, view), into their Image datablocks; yield the name of each image once it is written.

    Call this only on the main thread.
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
    """Return the float image of a name and size; reuse the image of an earlier cast if there is one.

    Setting a property of an existing image makes Blender free and refill its pixels, so only changes are set.
    """
    image = bpy.data.images.get(name)
    if image is None or not (image.is_float and (image.source == "GENERATED" or image.packed_file)):
        image = bpy.data.images.new(name, width, height, alpha=True, float_buffer=True, is_data=is_data)
        image.use_fake_user = True  # save the image even if nothing uses it
        return image
    if image.packed_file:  # its pixels are then in memory
        image.source = "GENERATED"
        if image.packed_file:
            image.unpack(method="REMOVE")
    if (image.generated_width, image.generated_height) != (width, height):
        image.generated_width, image.generated_height = width, height
    return image


def results() -> dict[str, str]:
    """Return the key of the pass by name, for all images that casts have made."""
    keys = sorted((entry.key for entry in PASSES), key=len, reverse=True)  # else "distance bound" is "distance"
    keys_by_name = {}
    for name in [image.name for image in bpy.data.images]:
        key = next((key for key in keys if f"{name} ".startswith(f"{image_name(key)} ")), None)
        if key is not None:
            keys_by_name[name] = key
    return keys_by_name


def show_in_colors(name: str) -> tuple[bpy.types.Image, str]:
    """Return an image that shows the named result in displayable colors, and a description of the colors.

    For the combined pass, the image is the result itself.
    """
    result, key = bpy.data.images[name], results()[name]
    if key == "combined":
        return result, "as it is"
    channels = next(len(entry.channels) for entry in PASSES if entry.key == key)
    colors, description = displayed(key, pixels_of(result)[..., :channels])
    image = bpy.data.images.get(VIEW)
    if image is None:
        image = bpy.data.images.new(VIEW, *result.size)
        image.colorspace_settings.name = "Non-Color"  # numbers, not light
    image.scale(*result.size)
    image.pixels.foreach_set(_rgba(colors.reshape(-1, 3)).ravel())
    image.update()
    image[OF] = name
    return image, description


@persistent
def pack(*_) -> None:
    """Pack images that were cast since the last save into the file, before it is saved."""
    for name in results():
        image = bpy.data.images[name]
        if image.source == "GENERATED" and image.is_dirty:
            image.pack()


@persistent
def hold(*_) -> None:
    """Keep the images over an undo or a redo, which may remove them or lose their pixels."""
    _held.clear()
    for name, key in results().items():
        image = bpy.data.images[name]
        if image.has_data:
            _held[name] = key, tuple(image.size), pixels_of(image).ravel()
    _editors[:] = [(space, space.image.name) for space in editors() if space.image and space.image.name in _held]


@persistent
def give_back(*_) -> None:
    """Store the images again that an undo or a redo has removed, and show them where they were shown."""
    for name, (key, size, pixels) in _held.items():
        image = bpy.data.images.get(name)
        if image is None or not image.has_data:
            image = _datablock(name, *size, is_data=key != "combined")
            image.pixels.foreach_set(pixels)
            image.update()
    for space, name in _editors:
        if space.image is None:
            space.image = bpy.data.images.get(name)
    _held.clear()
    _editors.clear()
    drop_lost()


def editors() -> list:
    """Return the active spaces of all open Image Editors."""
    areas = [area for window in bpy.context.window_manager.windows for area in window.screen.areas]
    return [area.spaces.active for area in areas if area.type == "IMAGE_EDITOR"]


def drop_lost() -> None:
    """Remove images whose pixels a redo has not brought back: Blender would show and save them as black."""
    for name in (*results(), VIEW):
        image = bpy.data.images.get(name)
        if image is not None and image.source == "GENERATED" and not image.has_data:
            bpy.data.images.remove(image)


@persistent
def forget(*_) -> None:
    """Forget which images are the latest: another file is loaded."""
    latest.clear()


def register(undo) -> None:
    undo.add_handlers(pack, "save_pre")
    undo.add_handlers(forget, "load_pre")
    undo.add_handlers(hold, "undo_pre", "redo_pre")
    undo.add_handlers(give_back, "undo_post", "redo_post")


def _rgba(pixels: np.ndarray, lent: np.ndarray | None = None) -> np.ndarray:
    """Return a pass, (n, channels), as (n, 4) float32: gray for one channel, blue 0 for two channels, alpha 1.

    ``lent`` is an earlier result to overwrite: allocating new memory takes longer than the copy.
    """
    count, channels = pixels.shape
    rgba = np.ones((count, 4), np.float32) if lent is None or len(lent) != count else lent
    for k in range(3):  # one channel at a time: a broadcast to all takes four times as long
        rgba[:, k] = pixels[:, min(k, channels - 1)] if channels != 2 or k < 2 else 0
    return rgba


def show(names: list[str]) -> None:
    """Show the first of these images in every open Image Editor, unless the editor already shows one of them. A pass
    that is shown in colors is shown anew.
    """
    latest[:] = names
    colored = bpy.data.images.get(VIEW)
    if colored is not None and colored.get(OF) in names:
        show_in_colors(colored[OF])
        names = [*names, VIEW]
    for space in editors():
        if space.image is None or space.image.name not in names:
            space.image = bpy.data.images.get(names[0])
