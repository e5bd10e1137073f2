"""The 3D Views in the windows, and where one in camera view shows the camera's frame."""

from collections.abc import Iterator

import bpy
from bpy_extras.view3d_utils import location_3d_to_region_2d

from ..properties.declared import ENGINE

SEEN = "CAMERA", "RENDERED"
"""Perspective and shading of a view that shows the picture of a cast."""


def views_3d() -> Iterator[tuple]:
    """Yield each window and area of a 3D View."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                yield window, area


def shows_cast(space, scene) -> bool:
    """Return whether a 3D View shows the picture of a scene's camera by a cast."""
    view = space.region_3d
    return view is not None and (view.view_perspective, space.shading.type) == SEEN and scene.render.engine == ENGINE


def camera_frame(context) -> tuple[float, float, float, float] | None:
    """Return left, bottom, right, top of the camera's frame as Blender draws it, in the region's pixels.

    Return None if the view does not look through the scene's camera. Zoom, offset, shift and sensor fit are Blender's.
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
