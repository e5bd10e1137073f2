"""The section of a real lens with the rays of a pixel, as an icon that panels show."""

import bpy.utils.previews

from ...core.camera.camera import Camera
from ...core.lesson.section import SIDE, section

NAME = "section"
_previews: list[bpy.utils.previews.ImagePreviewCollection] = []
_shown: list[tuple[Camera, tuple[int, int]]] = []
"""The camera and the pixel of the icon."""


def icon(camera: Camera, pixel: tuple[int, int]) -> int:
    """Return the icon of the section of a camera's real lens, with the rays of a pixel."""
    if not _previews:
        _previews.append(bpy.utils.previews.new())
    if not _shown or _shown[0][0] is not camera or _shown[0][1] != pixel:
        _previews[0].clear()
        made = _previews[0].new(NAME)
        made.image_size = SIDE, SIDE
        made.image_pixels_float.foreach_set(section(camera.model, pixel[0] + 0.5, pixel[1] + 0.5).ravel())
        _shown[:] = [(camera, pixel)]
    return _previews[0][NAME].icon_id


def forget() -> None:
    """Remove the icon."""
    _shown.clear()
    while _previews:
        bpy.utils.previews.remove(_previews.pop())


def register(undo) -> None:
    undo.callback(forget)
