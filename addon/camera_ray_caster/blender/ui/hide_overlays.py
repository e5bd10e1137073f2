"""Changes what Blender draws in a 3D View that shows the picture of a model that Blender cannot draw.

In a cast's picture Blender's outlines, grid and texts are hidden: Blender draws them in perspective, so they do not
match it. In a live view World Space Lighting is switched on: light that turned with each face would jump at their
edges. Both are restored when the view shows something else, before the file is saved, and before another file is
loaded. The update runs after a view is drawn, since every relevant change redraws the view. Auto Save and the save on
quit call no handlers of add-ons, so a screen with changed views is marked; when a file with such a mark is opened, they
are restored.
"""

from collections.abc import Iterator

import bpy
from bpy.app.handlers import persistent

from ..view3d.shown import drawn_alike
from .see_through import shows_cast, shows_picture

MISLEADING = (
    "show_outline_selected", "show_floor", "show_axis_x", "show_axis_y", "show_axis_z", "show_ortho_grid",
    "show_object_origins", "show_relationship_lines", "show_extras", "show_bones", "show_motion_paths",
    "show_wireframes", "show_face_orientation", "show_cursor", "show_text",
)  # fmt: skip
"""Properties of a view's overlays that are drawn in Blender's perspective. Texts are the names of objects at places in
it, and "Camera Perspective".
"""

MARK = "camera_ray_caster_overlays"
"""Custom property of a screen with hidden overlays: the names of those that were shown."""
LIGHT = "use_world_space_lighting"
MARK_LIGHT = "camera_ray_caster_light"
"""Custom property of a screen in whose views World Space Lighting was switched on."""

_before: dict[int, dict[str, bool]] = {}
"""What changed properties of a view were before, by the pointer of the 3D View."""


def misleads(space, scene) -> bool:
    """Return whether a 3D View shows the picture of a camera whose model Blender does not draw."""
    return shows_picture(space, scene) and not drawn_alike(scene.camera)


def wanted(space, scene) -> dict[str, bool]:
    """Return the properties of a 3D View that have to be changed, with their values."""
    if not misleads(space, scene):
        return {}
    if shows_cast(space, scene):
        return dict.fromkeys(MISLEADING, False)
    shading = space.shading
    return {LIGHT: True} if (shading.type, shading.light) == ("SOLID", "STUDIO") else {}


def _owner(space, name: str):
    return space.shading if name == LIGHT else space.overlay


def change(space, values: dict[str, bool]) -> None:
    """Change properties of a 3D View. If all overlays are hidden already, as in a view that was split off from another
    one, keep the former values of that view.
    """
    before = {name: getattr(_owner(space, name), name) for name in values}
    if not any(before.values()) and LIGHT not in values and _before:
        before = next(reversed(_before.values()))
    _before[space.as_pointer()] = before
    for name, value in values.items():
        setattr(_owner(space, name), name, value)


def restore(space) -> None:
    """Restore the properties of a 3D View that are changed."""
    for name, value in _before.pop(space.as_pointer(), {}).items():
        setattr(_owner(space, name), name, value)


def _is_stale(space, scene) -> bool:
    return wanted(space, scene).keys() != _before.get(space.as_pointer(), {}).keys()


def update() -> None:
    """Change or restore the views of each window as needed, and mark its screen."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            space = area.spaces.active
            if area.type == "VIEW_3D" and _is_stale(space, window.scene):
                restore(space)
                if values := wanted(space, window.scene):
                    change(space, values)
        mark(window.screen)


def mark(screen) -> None:
    """Mark a screen by what is changed in its views."""
    changed = [_before[space.as_pointer()] for space in _views(screen) if space.as_pointer() in _before]
    for name in (MARK, MARK_LIGHT):
        screen.pop(name, None)
    for before in changed:
        if before.get(LIGHT) is False:
            screen[MARK_LIGHT] = True
        elif LIGHT not in before:
            screen[MARK] = [name for name, was_shown in before.items() if was_shown]


def draw() -> None:
    """Update the views after this drawing if their content has changed; called by Blender for each 3D View."""
    if _is_stale(bpy.context.space_data, bpy.context.scene) and not bpy.app.timers.is_registered(update):
        bpy.app.timers.register(update, first_interval=0.0)


def _views(screen) -> Iterator[bpy.types.SpaceView3D]:
    """Yield the 3D Views of a screen, also those that another editor covers."""
    for area in screen.areas:
        yield from (space for space in area.spaces if space.type == "VIEW_3D")


@persistent
def restore_all(*_) -> None:
    """Restore every view: the file is saved, or another one is loaded. The next drawing changes them again."""
    for screen in bpy.data.screens:
        for space in _views(screen):
            restore(space)
        for name in (MARK, MARK_LIGHT):
            screen.pop(name, None)
    _before.clear()


@persistent
def restore_marked(*_) -> None:
    """Restore the views that were changed when Blender saved the file by itself: those without overlays, and those in
    Solid with World Space Lighting.
    """
    for screen in bpy.data.screens:
        shown, is_lit = screen.pop(MARK, ()), screen.pop(MARK_LIGHT, False)
        for space in _views(screen):
            if is_lit and space.shading.type == "SOLID":
                setattr(space.shading, LIGHT, False)
            if not any(getattr(space.overlay, name) for name in MISLEADING):
                for name in set(shown).intersection(MISLEADING):
                    setattr(space.overlay, name, True)


def stop() -> None:
    """Restore everything, and hide nothing any more."""
    if bpy.app.timers.is_registered(update):
        bpy.app.timers.unregister(update)
    restore_all()


def register(undo) -> None:
    undo.callback(stop)
    undo.add_handlers(restore_all, "save_pre", "load_pre")
    undo.add_handlers(restore_marked, "load_post")
    undo.add_drawing(bpy.types.SpaceView3D, draw, "POST_PIXEL")
