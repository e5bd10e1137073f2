"""Hides Blender's outlines and grid in a 3D View that shows the picture of a model that Blender cannot draw.

Blender draws them in perspective, so they do not match the picture. They are restored when the view shows something
else, before the file is saved, and before another file is loaded. The update runs after a view is drawn, since every
relevant change redraws the view. Auto Save and the save on quit call no handlers of add-ons, so a screen with hidden
overlays is marked; when a file with such a mark is opened, its overlays are restored.
"""

from __future__ import annotations

from collections.abc import Iterator

import bpy
from bpy.app.handlers import persistent

from .camera_notes import drawn_alike
from .see_through import shows_picture

MISLEADING = (
    "show_outline_selected", "show_floor", "show_axis_x", "show_axis_y", "show_axis_z", "show_ortho_grid",
    "show_object_origins", "show_relationship_lines", "show_extras", "show_bones", "show_motion_paths",
    "show_wireframes", "show_face_orientation", "show_cursor",
)  # fmt: skip
"""Properties of a view's overlays that are drawn in Blender's perspective."""

MARK = "camera_ray_caster_overlays"
"""Custom property of a screen with hidden overlays: the names of those that were shown."""

_before: dict[int, dict[str, bool]] = {}
"""What a view's overlays were before they were hidden, by the pointer of the 3D View."""


def misleads(space, scene) -> bool:
    """Return whether a 3D View shows the picture of a camera whose model Blender does not draw."""
    return shows_picture(space, scene) and not drawn_alike(scene.camera)


def hide(space) -> None:
    """Hide Blender's outlines and grid in a 3D View. If all are hidden already, as in a view that was split off from
    another one, keep the former values of that view.
    """
    before = {name: getattr(space.overlay, name) for name in MISLEADING}
    if not any(before.values()) and _before:
        before = next(reversed(_before.values()))
    _before[space.as_pointer()] = before
    for name in MISLEADING:
        setattr(space.overlay, name, False)


def restore(space) -> None:
    """Restore the overlays of a 3D View in which they are hidden."""
    for name, value in _before.pop(space.as_pointer(), {}).items():
        setattr(space.overlay, name, value)


def update() -> None:
    """Hide or restore the overlays in each window as needed, and mark its screen."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            space = area.spaces.active
            if area.type == "VIEW_3D" and misleads(space, window.scene) != (space.as_pointer() in _before):
                (restore if space.as_pointer() in _before else hide)(space)
        hidden = [_before[space.as_pointer()] for space in _views(window.screen) if space.as_pointer() in _before]
        window.screen.pop(MARK, None)
        if hidden:
            window.screen[MARK] = [name for name, was_shown in hidden[-1].items() if was_shown]


def draw() -> None:
    """Have the overlays updated after this drawing if the view has changed; called by Blender for each 3D View."""
    space = bpy.context.space_data
    is_stale = misleads(space, bpy.context.scene) != (space.as_pointer() in _before)
    if is_stale and not bpy.app.timers.is_registered(update):
        bpy.app.timers.register(update, first_interval=0.0)


def _views(screen) -> Iterator[bpy.types.SpaceView3D]:
    """Yield the 3D Views of a screen, also those that another editor covers."""
    for area in screen.areas:
        yield from (space for space in area.spaces if space.type == "VIEW_3D")


@persistent
def restore_all(*_) -> None:
    """Restore the overlays of every view: the file is saved, or another one is loaded. The next drawing hides them."""
    for screen in bpy.data.screens:
        for space in _views(screen):
            restore(space)
        screen.pop(MARK, None)
    _before.clear()


@persistent
def restore_marked(*_) -> None:
    """Restore the overlays of the views that were hidden when Blender saved the file by itself: those with none."""
    for screen in bpy.data.screens:
        shown = screen.pop(MARK, ())
        for space in _views(screen):
            if not any(getattr(space.overlay, name) for name in MISLEADING):
                for name in set(shown).intersection(MISLEADING):
                    setattr(space.overlay, name, True)


def stop() -> None:
    """Restore everything, and hide nothing any more."""
    if bpy.app.timers.is_registered(update):
        bpy.app.timers.unregister(update)
    restore_all()


def register(undo) -> None:
    """Register this module; see ``registration``."""
    undo.callback(stop)
    undo.add_handlers([("save_pre", restore_all), ("load_pre", restore_all), ("load_post", restore_marked)])
    handle = bpy.types.SpaceView3D.draw_handler_add(draw, (), "WINDOW", "POST_PIXEL")
    undo.callback(bpy.types.SpaceView3D.draw_handler_remove, handle, "WINDOW")
