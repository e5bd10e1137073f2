"""What a render shows otherwise than a 3D View does, written at the bottom of it.

A view that is drawn may not evaluate the scene at other frames. Outside of drawing that would set what the user has
moved and not keyed back to its animation. So the view has one frame for all pixels, and says so.
"""

from __future__ import annotations

import bpy

from ..properties.declared import ENGINE
from . import text
from .scene_cache import cached_scene

MARGIN = 28
"""Pixels between the text and the edge, at the interface's scale 1."""


def draw() -> None:
    """Write it where the view shows the camera's picture, or the overlay; called by Blender for each 3D View."""
    context = bpy.context
    lines = [("", line) for line in cached_scene(context).differences] if _shows_camera(context) else []
    if lines:
        margin, across = MARGIN * context.preferences.system.ui_scale, text.visible_width(context)
        text.write(context, lines, lambda width, height: ((across - width) / 2, height + margin))


def _shows_camera(context) -> bool:
    scene, space = context.scene, context.space_data
    is_rendered = space.shading.type == "RENDERED" and scene.render.engine == ENGINE
    if is_rendered and context.region_data.view_perspective == "CAMERA":
        return True
    return scene.camera_ray_caster_overlay.show and space.overlay.show_overlays


def register(undo) -> None:
    """See ``registration``."""
    handle = bpy.types.SpaceView3D.draw_handler_add(draw, (), "WINDOW", "POST_PIXEL")
    undo.callback(bpy.types.SpaceView3D.draw_handler_remove, handle, "WINDOW")
