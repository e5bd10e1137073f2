"""Position of the active camera's pixels in a 3D View in camera view, and in an Image Editor."""

from collections.abc import Iterator
from contextlib import contextmanager

import gpu
import numpy as np

from ..output import image_datablocks
from .shown import picture_frame

FAR = 1000.0
"""Distance in pixels from the region's corner to the point where the scale of an Image Editor is measured."""


def frame_in(context, raster) -> tuple[float, float, float, float] | None:
    """Return left, bottom, right, top of the camera's frame in the context's region, or None if it is not shown."""
    return image_frame(context, raster) if context.area.type == "IMAGE_EDITOR" else picture_frame(context)


@contextmanager
def in_pixels(frame, raster) -> Iterator[None]:
    """Draw in pixel coordinates of the camera's full frame, which fills ``frame`` in the region's pixels."""
    left, bottom, right, top = frame
    with gpu.matrix.push_pop():
        gpu.matrix.translate((left, bottom))
        gpu.matrix.scale(((right - left) / raster.width, (top - bottom) / raster.height))
        yield


def image_frame(context, raster) -> tuple[float, float, float, float] | None:
    """Return left, bottom, right, top of the camera's frame in an Image Editor's region, in the region's pixels.

    Return None if the image is neither a render nor made by a cast. An image with the size of the render window shows
    that part of the frame only. A render has no size in Python, so the scene's crop setting decides for a render.
    """
    image = context.space_data.image
    if not is_picture(image):
        return None
    whole, window = ((0, 0), raster.size), ((raster.x0, raster.y0), raster.shape[::-1])
    is_render, crops = image.type == "RENDER_RESULT", context.scene.render.use_crop_to_border
    first, count = window if (crops if is_render else tuple(image.size) == window[1]) else whole
    view = context.region.view2d  # in image widths and heights; view_to_region rounds to pixels
    corner, far = (np.array(view.region_to_view(at, at)) for at in (0.0, FAR))
    pixel = FAR / (far - corner) / count
    start = -FAR * corner / (far - corner) - pixel * first
    return *start, *(start + pixel * raster.size)


def is_picture(image) -> bool:
    """Return whether an image shows a camera's picture: a render, or an image made by a cast."""
    if image is None:
        return False
    return image.type == "RENDER_RESULT" or image.name in (image_datablocks.VIEW, *image_datablocks.results())
