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

CLASSES = (
    *groups.CLASSES, *overlay.CLASSES, *engine.CLASSES, *operators.CLASSES, *cast_operator.CLASSES,
    *cycles_operators.CLASSES, *frame.CLASSES, *follow_timeline.CLASSES, *other_engine.CLASSES, *add_line.CLASSES,
    *export_operators.CLASSES, *rig_operators.CLASSES, *mouse_gizmo.CLASSES, *render_panels.CLASSES,
    *gallery_panels.CLASSES, *menus.CLASSES, *presets.CLASSES, *model_panels.CLASSES,
    *see_through.CLASSES, *see_through_here.CLASSES, *select_seen.CLASSES,
    *camera_panels.CLASSES, *in_process.CLASSES, *cast_all.CLASSES,
    *cameras_list.CLASSES, *show_result.CLASSES, *cast_panels.CLASSES, *verify_panels.CLASSES,
    *left_out_panels.CLASSES, *lens_operators.CLASSES, *lesson_operators.CLASSES, *lecture_operators.CLASSES,
    *point_operators.CLASSES, *gallery_operators.CLASSES,
    *open_lesson.CLASSES, *lesson_panels.CLASSES, *facts_panels.CLASSES, *overlay_panels.CLASSES,
    *cloud_operators.CLASSES, *object_panels.CLASSES, *through_model.CLASSES,
)  # fmt: skip
"""Blender types in registration order: a panel comes after its parent panel."""

MODULES = (
    groups, paths, shape_cache, shader_updates, reports, image_datablocks, gallery, lens_icon, scene_cache,
    other_times, engine, viewport, cast_operator, overlay, hit_points, pixel_lessons, live, notice, render_panels,
    menus, gallery_panels, gallery_operators, lesson_operators, lecture_operators, presets, export_operators,
    rig_operators, commands, other_engine, see_through, hide_overlays, select_seen, in_process,
)  # fmt: skip
"""Modules that register more than classes. Their ``register(undo)`` gives ``undo`` the callbacks that undo it."""


class Undo(ExitStack):
    """Callbacks that each remove one thing, last in first out. Things that other code has removed are skipped."""

    def callback(self, remove, *arguments):
        """Add a callback."""
        return super().callback(_unless_gone, remove, *arguments)

    def add_handlers(self, handlers) -> None:
        """Append functions to the named lists in ``bpy.app.handlers``, until they are undone."""
        for name, function in handlers:
            handler_list = getattr(bpy.app.handlers, name)
            handler_list.append(function)
            self.callback(handler_list.remove, function)


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
