"""The See Through operator: the 3D View looks through the camera, whatever its model.

In a window the view is live: Blender's own drawing in the shading that the view has, warped by the model. What cannot
be warped, such as a model whose rays have many origins, is shown by our own cast: shading and engine change for it.
It is a switch: pressed again it restores the view, its shading and the scene's render engine.
"""

from contextlib import suppress

import bpy
from bpy.app.handlers import persistent

from ..properties.declared import ENGINE
from ..view3d import lesson, live, notice, overlay
from ..view3d.live_picture import why_not
from .needs import OfScene

SEEN = "CAMERA", "RENDERED"
"""Perspective and shading of a view that shows the picture of a cast."""
_views: dict[int, tuple[str, str]] = {}
"""Perspective and shading before See Through, by the pointer of the 3D View."""
_cast_instead: dict[int, str] = {}
"""Shadings of live views whose camera is shown by a cast, by the pointer of the 3D View."""
BEFORE = "camera_ray_caster_engine"
"""Custom property of a scene: its render engine before See Through, which a file keeps that is saved meanwhile."""
OVER = overlay.draw_in_picture, lesson.draw_marks, notice.draw
"""What is drawn over a live view's picture."""
RESTORES = "the scene's render engine is Camera Ray Caster; See Through again restores it"


class SeeThrough(OfScene, bpy.types.Operator):
    """Look through the scene's camera, whatever its model, in the shading that the view has. A model whose rays have
    many origins is shown in Rendered shading by the render engine Camera Ray Caster. Press again to restore the view"""

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
        if before != SEEN or scene.render.engine != ENGINE:  # an undo restores the engine alone
            _views[space.as_pointer()] = before
        space.use_local_camera = False
        space.region_3d.view_perspective = "CAMERA"
        can_be_live = not bpy.app.background and live.can_show(space, scene)
        if can_be_live:
            live.begin(space, follow, OVER)
            reason = why_not(scene.camera, context.evaluated_depsgraph_get())
            if not reason:
                return {"FINISHED"}
            _cast_instead[space.as_pointer()] = space.shading.type
        if show_cast(space, scene):
            self.report({"INFO"}, f"{reason}: {RESTORES}" if can_be_live else f"T{RESTORES[1:]}")
        return {"FINISHED"}


def show_cast(space, scene) -> bool:
    """Show the picture of a cast in a 3D View; return whether the scene's engine had to be changed."""
    is_other = scene.render.engine != ENGINE
    if is_other:
        scene[BEFORE] = scene.render.engine
    scene.render.engine, space.shading.type = ENGINE, "RENDERED"
    return is_other


def end(context) -> None:
    """Restore a 3D View, and the scene's engine if no other view shows a cast."""
    space, scene = context.space_data, context.scene
    live.end(space)
    _cast_instead.pop(space.as_pointer(), None)
    perspective, shading = _views.pop(space.as_pointer(), ("CAMERA", "SOLID"))
    space.region_3d.view_perspective, space.shading.type = perspective, shading
    _restore_engine(scene)


def _restore_engine(scene) -> None:
    views = [space for window, space in _every_view() if window.scene == scene]
    if not any(shows_cast(view, scene) for view in views):
        with suppress(TypeError):  # an engine that this Blender does not have
            scene.render.engine = scene.pop(BEFORE, scene.render.engine)


def _every_view():
    """Yield each window and 3D View."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                yield window, area.spaces.active


def follow() -> None:
    """Show live views whose camera cannot be live by a cast, and again live once it can; called by a timer."""
    for window, space in _every_view():
        scene, place = window.scene, space.as_pointer()
        if not live.is_live(space) or space.region_3d.view_perspective != "CAMERA" or scene.camera is None:
            continue
        reason = why_not(scene.camera, window.view_layer.depsgraph)
        if reason and live.can_show(space, scene):
            _cast_instead[place] = space.shading.type
            show_cast(space, scene)
        elif not reason and place in _cast_instead:
            shading = _cast_instead.pop(place)
            if shows_cast(space, scene):
                space.shading.type = shading
                _restore_engine(scene)


def is_seen_through(context) -> bool:
    """Return whether See Through is on in the 3D View."""
    space = context.space_data
    is_live = live.is_live(space) and space.region_3d is not None and space.region_3d.view_perspective == "CAMERA"
    return is_live or shows_cast(space, context.scene)


def shows_picture(space, scene) -> bool:
    """Return whether a 3D View shows the picture of a scene's camera, live or by a cast."""
    return shows_cast(space, scene) or shows_live(space, scene)


def shows_live(space, scene) -> bool:
    """Return whether a 3D View shows the picture of a scene's camera live."""
    view = space.region_3d
    is_shown = live.is_live(space) and live.can_show(space, scene)
    return is_shown and view is not None and view.view_perspective == "CAMERA"


def shows_cast(space, scene) -> bool:
    """Return whether a 3D View shows the picture of a scene's camera by a cast."""
    view = space.region_3d
    return view is not None and (view.view_perspective, space.shading.type) == SEEN and scene.render.engine == ENGINE


@persistent
def forget(*_) -> None:
    """Forget what was before: another file is loaded."""
    _views.clear()
    _cast_instead.clear()


CLASSES = (SeeThrough,)


def register(undo) -> None:
    """Register this module; see ``registration``."""
    undo.callback(forget)
    undo.add_handlers([("load_pre", forget)])
