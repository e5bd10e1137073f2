"""Registration of everything that the add-on adds to Blender, in one step that can be undone."""

import atexit
from contextlib import ExitStack, suppress

import bpy

from ..core.records import InputError
from . import gallery
from .cycles import shader_updates
from .engine import engine, viewport
from .output import image_datablocks, reports
from .properties import calibration_choice, groups, paths
from .properties.declared import ENGINE
from .read import other_times, scene_cache, shape_cache
from .terminal import commands
from .ui import (
    add_line,
    camera_panels,
    cameras_list,
    cast_all,
    cast_operator,
    cast_panels,
    cloud_operators,
    cycles_operators,
    export_operators,
    facts_panels,
    follow_timeline,
    frame,
    gallery_operators,
    gallery_panels,
    hide_overlays,
    in_process,
    lecture_operators,
    left_out_panels,
    lens_operators,
    lesson_operators,
    lesson_panels,
    menus,
    model_panels,
    object_panels,
    open_lesson,
    operators,
    other_engine,
    overlay_panels,
    point_operators,
    presets,
    render_panels,
    rig_operators,
    see_through,
    see_through_here,
    select_seen,
    show_result,
    through_model,
    verify_panels,
)
from .view3d import hit_points, lens_icon, live, mouse_gizmo, notice, overlay, pixel_lessons

PARTS = (
    groups, paths, shape_cache, shader_updates, reports, image_datablocks, gallery, lens_icon, scene_cache, other_times,
    overlay, engine, viewport, operators, cast_operator, hit_points, pixel_lessons, live, notice, cycles_operators,
    frame, follow_timeline, other_engine, add_line, export_operators, rig_operators, mouse_gizmo, render_panels,
    gallery_panels, menus, presets, model_panels, see_through, see_through_here, select_seen, camera_panels, in_process,
    cast_all, cameras_list, show_result, cast_panels, verify_panels, left_out_panels, lens_operators, lesson_operators,
    lecture_operators, point_operators, gallery_operators, open_lesson, lesson_panels, facts_panels, overlay_panels,
    cloud_operators, object_panels, through_model, commands, hide_overlays,
)  # fmt: skip
"""Modules with types of Blender or something else to register, in this order: a panel comes after its parent panel."""

CLASSES = tuple(cls for module in PARTS for cls in getattr(module, "CLASSES", ()))

MODULES = tuple(module for module in PARTS if hasattr(module, "register"))
"""Modules that register more than classes. Their ``register(undo)`` gives ``undo`` the callbacks that undo it."""


class Undo(ExitStack):
    """Callbacks that each remove one thing, last in first out. Things that other code has removed are skipped."""

    def callback(self, remove, *arguments):
        """Add a callback."""
        return super().callback(_unless_gone, remove, *arguments)

    def append(self, functions, function) -> None:
        """Append a function to a menu or a list of handlers."""
        functions.append(function)
        self.callback(functions.remove, function)

    def add_handlers(self, function, *names: str) -> None:
        """Append a function to lists in ``bpy.app.handlers``."""
        for name in names:
            self.append(getattr(bpy.app.handlers, name), function)

    def add_drawing(self, space: type[bpy.types.Space], function, when: str) -> None:
        """Have Blender call a function whenever it draws a region of an editor: see ``Space.draw_handler_add``."""
        handle = space.draw_handler_add(function, (), "WINDOW", when)
        self.callback(space.draw_handler_remove, handle, "WINDOW")


def _unless_gone(remove, *arguments) -> None:
    with suppress(AttributeError, RuntimeError, ValueError):  # raised if it is already removed
        remove(*arguments)


_registered: list[Undo] = []
"""The callbacks that remove everything again; empty if nothing is registered."""


def register() -> None:
    """Register everything, unless it is registered already. On an error, undo the registration and raise the error.

    Raises InputError if another copy of the add-on is registered, or another add-on has a property of its name: each
    would remove the other's.
    """
    if _registered:
        return
    _check_others(__name__.partition("blender.")[0])
    with Undo() as undo:
        for cls in CLASSES:
            bpy.utils.register_class(cls)
            undo.callback(bpy.utils.unregister_class, cls)
        for module in MODULES:
            module.register(undo)
        _registered.append(undo.pop_all())
    if not bpy.app.binary_path:  # unlike Blender, pip's bpy does not disable add-ons, and crashes at exit
        atexit.register(unregister)


def _check_others(package: str) -> None:
    other = bpy.types.RenderEngine.bl_rna_get_subclass_py(ENGINE)
    if other is not None and not other.__module__.startswith(package):
        name = other.__module__.partition(".blender.")[0]
        raise InputError(f"{other.bl_label} is registered already, as {name}: import that, or disable it first")
    if taken := groups.others_property(package):
        raise InputError(f"another add-on has the property {taken}: disable that add-on first")


def unregister() -> None:
    """Remove everything that is registered and still there, in reverse order."""
    atexit.unregister(unregister)
    if _registered:
        _registered.pop().close()


def renew() -> None:
    """Register again, if it is registered, with the camera models that were added since."""
    was_registered = bool(_registered)
    unregister()
    groups.renew()
    calibration_choice.renew()
    if was_registered:
        register()
