"""Where the pixels of the active camera lie in a 3D View that looks through it, and in an Image Editor."""

from __future__ import annotations

import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d

from ..output import images

FAR = 1000.0
"""Pixels from the region's corner to the place where the scale of an Image Editor is measured."""


def frame_in(context, raster) -> tuple[float, float, float, float] | None:
    """Return left, bottom, right, top of the camera's frame in the context's region; None where it is not seen."""
    return image_frame(context, raster) if context.area.type == "IMAGE_EDITOR" else camera_frame(context)


def camera_frame(context) -> tuple[float, float, float, float] | None:
    """Return left, bottom, right, top of the camera's frame as Blender draws it, in the region's pixels.

    None where the view does not look through the scene's camera. Zoom, offset, shift and sensor fit are Blender's own.
    """
    region_data, camera = context.region_data, context.scene.camera
    if region_data is None or region_data.view_perspective != "CAMERA" or camera is None or camera.type != "CAMERA":
        return None
    if context.space_data.camera != camera:
        return None
    evaluated = camera.evaluated_get(context.view_layer.depsgraph)
    matrix = region_data.view_matrix.inverted()
    corners = [matrix @ corner for corner in evaluated.data.view_frame(scene=context.scene)]
    seen = [location_3d_to_region_2d(context.region, region_data, corner) for corner in corners]
    if None in seen:
        return None
    xs, ys = [point.x for point in seen], [point.y for point in seen]
    return min(xs), min(ys), max(xs), max(ys)


def image_frame(context, raster) -> tuple[float, float, float, float] | None:
    """Return left, bottom, right, top of the camera's frame in an Image Editor's region, in the region's pixels.

    None where the image is neither a render nor one that a cast has made. One of the size of the render window is that
    part of the frame; of a render, which has no size in Python, the scene says whether it is.
    """
    image = context.space_data.image
    if not is_picture(image):
        return None
    whole, window = ((0, 0), raster.size), ((raster.x0, raster.y0), raster.shape[::-1])
    is_render, crops = image.type == "RENDER_RESULT", context.scene.render.use_crop_to_border
    first, count = window if (crops if is_render else tuple(image.size) == window[1]) else whole
    view = context.region.view2d  # in widths and heights of the image; its way back would round to whole pixels
    corner, far = (np.array(view.region_to_view(at, at)) for at in (0.0, FAR))
    pixel = FAR / (far - corner) / count
    start = -FAR * corner / (far - corner) - pixel * first
    return *start, *(start + pixel * raster.size)


def is_picture(image) -> bool:
    """Return whether an image shows what a camera sees: a render, or what a cast has made."""
    if image is None:
        return False
    return image.type == "RENDER_RESULT" or image.name == images.VIEW or image.name in images.results()
