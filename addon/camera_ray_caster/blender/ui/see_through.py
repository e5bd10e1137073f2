"""The See Through operator: the 3D View looks through the camera, whatever its model.

In a window the view is live: Blender's own drawing in the shading that the view has, warped by the model. What cannot
be warped, such as a model without a single viewpoint, is shown by our own cast: shading and engine change for it.
It is a switch: pressed again it restores the view, its shading and the scene's render engine. Shading and engine are
given back, too, however else a cast's view is left: by another view, shading, engine or workspace, and without the
camera. A saved file has those of before.
"""

from contextlib import suppress

import bpy
from bpy.app.handlers import persistent
from mathutils import Quaternion

from ..properties.declared import ENGINE
from ..read.view import SEEN, shows_cast, views_3d
from ..view3d import live, notice, overlay, pixel_lessons
from ..view3d.live_picture import why_not
from ..view3d.shown import can_show, is_live
from .needs import OfScene

_views: dict[int, tuple[str, str, Quaternion]] = {}
"""Perspective, shading and rotation before See Through, by the pointer of the 3D View: one that looks through a camera
gets its rotation from Blender.
"""
_cast: dict[int, str] = {}
"""Shading before a cast is shown, by the pointer of the 3D View."""
_followed: set[int] = set()
"""Views that were live before they showed a cast: no undo step has its engine."""
PERIOD = 0.2
"""Seconds after which it is looked again whether a cast is still shown."""
BEFORE = "camera_ray_caster_engine"
"""Custom property of a scene: its render engine before See Through, which a file keeps that is saved meanwhile."""
OVER = overlay.draw_in_picture, pixel_lessons.draw_marks, notice.draw
"""What is drawn over a live view's picture."""
RESTORES = "The scene's render engine is Camera Ray Caster; See Through again restores it"


class SeeThrough(OfScene, bpy.types.Operator):
    """Look through the scene's camera, whatever its model, in the view's shading. Models without a single viewpoint,
    such as Cross-Slit, and slit scans switch the view to Rendered and the engine to Camera Ray Caster. Press again to
    restore both"""

    bl_label = "See Through Camera"

    @classmethod
    def why_gray(cls, context) -> str:
        if context.area is None or context.area.type != "VIEW_3D":
            return "Available only in a 3D View"
        return "" if is_seen_through(context) else super().why_gray(context)

    def execute(self, context):
        if is_seen_through(context):
            end(context)
            return
        space, scene = context.space_data, context.scene
        before = space.region_3d.view_perspective, space.shading.type
        if before != SEEN or scene.render.engine != ENGINE:  # an undo restores the engine alone
            _views[space.as_pointer()] = (*before, space.region_3d.view_rotation.copy())
        space.use_local_camera = False
        space.region_3d.view_perspective = "CAMERA"
        if not bpy.app.background and can_show(space, scene):
            live.begin(space, follow, OVER)
            if not why_not(scene.camera, context.evaluated_depsgraph_get()):
                return
        if show_cast(space, scene):
            self.report({"INFO"}, RESTORES)


def show_cast(space, scene) -> bool:
    """Show the picture of a cast in a 3D View; return whether the scene's engine had to be changed."""
    is_other = scene.render.engine != ENGINE
    if is_other:
        scene[BEFORE] = scene.render.engine
    _cast.setdefault(space.as_pointer(), space.shading.type)
    scene.render.engine, space.shading.type = ENGINE, "RENDERED"
    if not bpy.app.timers.is_registered(watch):
        bpy.app.timers.register(watch, first_interval=PERIOD)
    return is_other


def watch() -> float | None:
    """Restore shading and engine where a cast is no longer shown; called by a timer while one is shown."""
    if bpy.app.is_job_running("RENDER"):  # with an engine of its own
        return PERIOD
    shown = {space.as_pointer(): window.scene for window, space in _every_view()}
    spaces = {space.as_pointer(): space for space in _spaces()}
    for pointer, shading in list(_cast.items()):
        space, scene = spaces.get(pointer), shown.get(pointer)
        if space is None:  # closed
            del _cast[pointer]
            _views.pop(pointer, None)
        elif scene is None or scene.camera is None or not shows_cast(space, scene):
            del _cast[pointer]
            _left(space, scene, shading)
    restore_engines()
    return PERIOD if _cast else None


def _left(space, scene, shading: str) -> None:
    """Restore the shading of a 3D View that no longer shows a cast, but for one that was chosen, or an engine. In
    another workspace (``scene`` None) or from another side the view stays live, and shows the cast again later.
    """
    is_camera_view = space.region_3d.view_perspective == "CAMERA"
    is_chosen = scene is not None and (space.shading.type != "RENDERED" or (is_camera_view and BEFORE in scene))
    if not is_chosen or scene.camera is None:
        space.shading.type = shading
    if scene is not None and (is_camera_view or scene.camera is None):
        if not is_chosen and scene.camera is not None and space.as_pointer() in _followed:
            return  # undone: still live, and ``follow`` shows the cast again
        live.end(space)
        _followed.discard(space.as_pointer())
        before = _views.pop(space.as_pointer(), None)
        if before is not None and not is_chosen:  # undone
            _look_again(space, before)


def end(context) -> None:
    """Restore a 3D View, and the scene's engine if no other view shows a cast."""
    space = context.space_data
    live.end(space)
    _cast.pop(space.as_pointer(), None)
    _followed.discard(space.as_pointer())
    before = _views.pop(space.as_pointer(), ("CAMERA", "SOLID", space.region_3d.view_rotation.copy()))
    _look_again(space, before)
    space.shading.type = before[1]
    restore_engines()


def _look_again(space, before) -> None:
    """Restore the perspective and the rotation of a 3D View."""
    space.region_3d.view_perspective, _, space.region_3d.view_rotation = before


@persistent
def restore_engines(*_) -> None:
    """Restore the engines of scenes of which no view shows a cast, unless another one was chosen meanwhile."""
    cast = [window.scene for window, space in _every_view() if shows_cast(space, window.scene)]
    for scene in bpy.data.scenes:
        if BEFORE in scene and scene not in cast:
            before = scene.pop(BEFORE)
            if scene.render.engine == ENGINE:
                with suppress(TypeError):  # an engine that this Blender does not have
                    scene.render.engine = before


def _every_view() -> list[tuple]:
    """Return each window and 3D View."""
    return [(window, area.spaces.active) for window, area in views_3d()]


def _spaces():
    """Yield each 3D View, also those that are not shown."""
    areas = (area for screen in bpy.data.screens for area in screen.areas)
    yield from (space for area in areas for space in area.spaces if space.type == "VIEW_3D")


def follow() -> None:
    """Show live views whose camera cannot be live by a cast, and again live once it can; called by a timer."""
    for window, space in _every_view():
        scene, pointer = window.scene, space.as_pointer()
        if not is_live(space) or space.region_3d.view_perspective != "CAMERA" or scene.camera is None:
            continue
        reason = why_not(scene.camera, window.view_layer.depsgraph)
        if reason and can_show(space, scene):
            show_cast(space, scene)
            _followed.add(pointer)
        elif not reason and pointer in _cast:
            shading = _cast.pop(pointer)
            if shows_cast(space, scene):
                space.shading.type = shading
                restore_engines()


def is_seen_through(context) -> bool:
    """Return whether See Through is on in the 3D View."""
    space = context.space_data
    is_camera_view = space.region_3d is not None and space.region_3d.view_perspective == "CAMERA"
    return (is_camera_view and is_live(space)) or shows_cast(space, context.scene)


def shows_picture(space, scene) -> bool:
    """Return whether a 3D View shows the picture of a scene's camera, live or by a cast."""
    return shows_cast(space, scene) or shows_live(space, scene)


def shows_live(space, scene) -> bool:
    """Return whether a 3D View shows the picture of a scene's camera live."""
    view = space.region_3d
    is_shown = is_live(space) and can_show(space, scene)
    return is_shown and view is not None and view.view_perspective == "CAMERA"


@persistent
def give_back(*_) -> None:
    """Restore shadings and engines, while a file is saved or for good."""
    for space in _spaces():
        if space.as_pointer() in _cast:
            space.shading.type = _cast[space.as_pointer()]
    restore_engines()


@persistent
def show_again(*_) -> None:
    """Show casts as before the file was saved."""
    for window, space in _every_view():
        if space.as_pointer() in _cast:
            show_cast(space, window.scene)


@persistent
def restore_saved(*_) -> None:
    """Restore a file that Blender saved by itself meanwhile: Auto Save calls no handlers."""
    scenes = [scene for scene in bpy.data.scenes if BEFORE in scene]
    for window, space in _every_view():
        if window.scene in scenes and shows_cast(space, window.scene):
            space.shading.type = "SOLID"
    restore_engines()


@persistent
def forget(*_) -> None:
    """Forget what was before: another file is loaded."""
    _views.clear()
    _cast.clear()
    _followed.clear()


def stop() -> None:
    """Restore everything."""
    if bpy.app.timers.is_registered(watch):
        bpy.app.timers.unregister(watch)
    give_back()
    forget()


CLASSES = (SeeThrough,)


def register(undo) -> None:
    undo.callback(stop)
    undo.add_handlers(forget, "load_pre")
    undo.add_handlers(give_back, "save_pre")
    undo.add_handlers(show_again, "save_post")
    undo.add_handlers(restore_saved, "load_post")
    undo.add_handlers(restore_engines, "undo_post", "redo_post")
