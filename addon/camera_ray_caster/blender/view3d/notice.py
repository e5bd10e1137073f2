"""A notice at the bottom of a 3D View about differences between the view and a render.

The scene cannot be evaluated at other frames while a view is drawn. Doing it at other times would reset objects that
the user has moved without a keyframe. So the view shows all pixels at one frame, and the notice tells this.
"""

from __future__ import annotations

import bpy

from ..properties.declared import ENGINE
from . import text
from .scene_cache import cached_scene

MARGIN = 28
"""Distance between the text and the edge, in pixels at interface scale 1."""


def draw() -> None:
    """Write the notice if the view shows the camera's picture or the overlay; called by Blender for each 3D View."""
    context = bpy.context
    sentences = cached_scene(context).differences if _shows_camera(context) else ()
    if sentences:
        margin, (left, right) = MARGIN * context.preferences.system.ui_scale, text.visible(context)
        lines = [("", line) for one in sentences for line in text.wrapped(context, one, right - left - 2 * margin)]
        text.write(context, lines, lambda width, height: ((left + right - width) / 2, height + margin))


def _shows_camera(context) -> bool:
    scene, space = context.scene, context.space_data
    is_rendered = space.shading.type == "RENDERED" and scene.render.engine == ENGINE
    if is_rendered and context.region_data.view_perspective == "CAMERA":
        return True
    return scene.camera_ray_caster_overlay.show and space.overlay.show_overlays


def register(undo) -> None:
    """Register this module; see ``registration``."""
    handle = bpy.types.SpaceView3D.draw_handler_add(draw, (), "WINDOW", "POST_PIXEL")
    undo.callback(bpy.types.SpaceView3D.draw_handler_remove, handle, "WINDOW")
