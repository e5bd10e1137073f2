"""Live views: what Blender draws in a 3D View, through the model of the scene's camera, in any shading.

Blender draws a few perspective faces from the camera's eye, which one program warps into the picture (``core.faces``).
The faces are drawn again only after a change. Handlers and GPU objects exist only while a view is live.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import bpy
from bpy.app.handlers import persistent

from ..read.view import camera_frame, views_3d
from .live_picture import LiveView, camera_of, draw_picture, draw_picture_anew, is_blenders
from .live_programs import forget
from .shown import can_show, is_live
from .shown import live as _live

FAILURES = RuntimeError, SystemError, ValueError, MemoryError, ReferenceError
"""What Blender raises if the GPU cannot do it."""
MATCAP = "A MatCap turns with each face of the live view, so that brightness jumps: choose Studio or Flat lighting"
SETTLED = 0.2
"""Seconds without a change after which Blender's texts and gizmos are drawn over the picture again."""


_handles: list = []
_state: dict[str, Any] = {"changes": 0, "busy": False, "follow": None, "over": ()}


def begin(space, follow: Callable[[], None], over: Sequence[Callable[[], None]]) -> None:
    """Make a 3D View live. A timer calls ``follow`` when its camera can no longer be live, or can be so again; the
    functions ``over`` draw over its picture.
    """
    _live.setdefault(space.as_pointer(), {})
    _state.update(follow=follow, over=over)
    if not _handles:
        for function, when in ((draw_below, "POST_VIEW"), (draw_anew, "POST_PIXEL")):
            _handles.append(bpy.types.SpaceView3D.draw_handler_add(function, (), "WINDOW", when))
        for name, function in HANDLERS:
            getattr(bpy.app.handlers, name).append(function)


def end(space) -> None:
    """End a live 3D View; with the last, the handlers end, and what the GPU holds is freed."""
    _live.pop(space.as_pointer(), None)
    if not _live:
        stop()


@persistent
def stop(*_) -> None:
    """End all live views: another file is loaded, or the add-on is disabled."""
    _live.clear()
    while _handles:
        bpy.types.SpaceView3D.draw_handler_remove(_handles.pop(), "WINDOW")
    for name, function in HANDLERS:
        handlers = getattr(bpy.app.handlers, name)
        if function in handlers:
            handlers.remove(function)
    forget()


@persistent
def changed(*_) -> None:
    """Have the faces drawn again: something was evaluated."""
    _state["changes"] += 1


HANDLERS = (
    ("depsgraph_update_post", changed), ("frame_change_post", changed), ("undo_post", changed), ("redo_post", changed),
    ("load_pre", stop),
)  # fmt: skip


def draw_below() -> None:
    """Draw the picture as the faces are over Blender's own drawing, and below its texts; called for each 3D View."""
    _drawn(draw_picture)


def draw_anew() -> None:
    """Draw the faces and the picture again after a change; called for each 3D View, when Blender has drawn all else:
    only then it can draw another view. What it drew over the picture is there again when it draws the region next.
    """
    _drawn(_draw_changed)


def _drawn(draw: Callable) -> None:
    context = bpy.context
    views, frame = _live.get(context.space_data.as_pointer()), camera_frame(context)
    if views is None or _state["busy"] or frame is None:
        return
    view = views.setdefault(context.region.as_pointer(), LiveView())
    view.changes, _state["busy"] = _state["changes"], True
    try:
        camera, is_shown = camera_of(context, view), can_show(context.space_data, context.scene)
        if (camera is None) == is_shown:
            _later(_state["follow"], 0.0)
        if camera is not None and is_shown and not is_blenders(camera):
            draw(context, view, camera, frame)
    except FAILURES as error:
        view.camera = (*view.camera[:2], f"The live view cannot be drawn: {' '.join(str(error).split())}")
    finally:
        _state["busy"] = False


def _draw_changed(*arguments) -> None:
    if draw_picture_anew(*arguments):
        for draw_over in _state["over"]:
            draw_over()
        _later(settle, SETTLED)


def _later(function: Callable, seconds: float) -> None:
    if not bpy.app.timers.is_registered(function):
        bpy.app.timers.register(function, first_interval=seconds)


def settle() -> None:
    """Have live views drawn again, with what Blender draws over them; forget those that were closed."""
    spaces = {space.as_pointer() for screen in bpy.data.screens for area in screen.areas for space in area.spaces}
    for closed in _live.keys() - spaces:
        del _live[closed]
    for _, area in views_3d():
        if is_live(area.spaces.active):
            area.tag_redraw()


def sentences(context) -> Iterator[str]:
    """Yield what differs in the context's live region from the camera's picture, in sentences."""
    space, view = context.space_data, _live[context.space_data.as_pointer()].get(context.region.as_pointer())
    if view is None or (view.camera[1] is not None and is_blenders(view.camera[1])):
        return
    if view.camera[2]:
        yield view.camera[2] if can_show(space, context.scene) else f"A cast is shown: {view.camera[2]}"
        return
    if not can_show(space, context.scene):
        return
    yield from view.differences
    if space.shading.type == "SOLID" and space.shading.light == "MATCAP":
        yield MATCAP


def register(undo) -> None:
    undo.callback(stop)
