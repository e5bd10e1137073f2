"""The See Through operator: the 3D View looks through the camera, whatever its model, and shows the cast picture.

It is a switch: pressed again it restores the view, its shading and the scene's render engine.
"""

from contextlib import suppress

import bpy
from bpy.app.handlers import persistent

from ..properties.declared import ENGINE
from .needs import OfScene

SEEN = "CAMERA", "RENDERED"
"""Perspective and shading of a view that shows the camera's picture."""
_views: dict[int, tuple[str, str]] = {}
"""Perspective and shading before See Through, by the pointer of the 3D View."""
BEFORE = "camera_ray_caster_engine"
"""Custom property of a scene: its render engine before See Through, which a file keeps that is saved meanwhile."""


class SeeThrough(OfScene, bpy.types.Operator):
    """Look through the scene's camera, whatever its model: the view becomes the camera's, its shading Rendered, and the
    scene's render engine Camera Ray Caster. Press again to restore all three"""

    bl_idname = "camera_ray_caster.see_through"
    bl_label = "See Through Camera"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        """Gray out the operator without a camera, and outside a 3D View."""
        cls.poll_message_set("Available only in a 3D View")
        return context.area is not None and context.area.type == "VIEW_3D" and super().poll(context)

    def execute(self, context):
        """Look through the camera, or restore what was before; report a change of the scene's engine."""
        if is_seen_through(context):
            end(context)
            return {"FINISHED"}
        space, scene = context.space_data, context.scene
        before = space.region_3d.view_perspective, space.shading.type
        if before != SEEN:  # an undo restores the engine alone
            _views[space.as_pointer()] = before
        if scene.render.engine != ENGINE:
            scene[BEFORE] = scene.render.engine
            self.report({"INFO"}, "The scene's render engine is Camera Ray Caster; See Through again restores it")
        scene.render.engine = ENGINE
        space.use_local_camera = False
        space.region_3d.view_perspective, space.shading.type = SEEN
        return {"FINISHED"}


def end(context) -> None:
    """Restore a 3D View, and the scene's engine if no other view looks through the camera."""
    space, scene = context.space_data, context.scene
    perspective, shading = _views.pop(space.as_pointer(), ("CAMERA", "SOLID"))
    space.region_3d.view_perspective, space.shading.type = perspective, shading
    views = [area.spaces.active for window in context.window_manager.windows
             if window.scene == scene for area in window.screen.areas if area.type == "VIEW_3D"]  # fmt: skip
    if not any(shows_picture(view, scene) for view in views):
        with suppress(TypeError):  # an engine that this Blender does not have
            scene.render.engine = scene.pop(BEFORE, scene.render.engine)


def is_seen_through(context) -> bool:
    """Return whether the 3D View shows the camera's picture."""
    return shows_picture(context.space_data, context.scene)


def shows_picture(space, scene) -> bool:
    """Return whether a 3D View shows the picture of a scene's camera."""
    view = space.region_3d
    return view is not None and (view.view_perspective, space.shading.type) == SEEN and scene.render.engine == ENGINE


@persistent
def forget(*_) -> None:
    """Forget what was before: another file is loaded."""
    _views.clear()


CLASSES = (SeeThrough,)


def register(undo) -> None:
    """Register this module; see ``registration``."""
    undo.callback(forget)
    undo.add_handlers([("load_pre", forget)])
