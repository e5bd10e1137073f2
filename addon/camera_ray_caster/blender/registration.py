"""Registration of everything that the add-on adds to Blender, in one step that can be undone."""

import atexit
from contextlib import ExitStack, suppress

import bpy

from . import gallery
from .cycles import follow
from .engine import engine, viewport
from .output import images, reports
from .properties import groups
from .read import kept
from .terminal import commands
from .ui import (
    add_line,
    camera_panels,
    cast_operator,
    cast_panels,
    cycles_operators,
    export_operators,
    facts_panels,
    gallery_operators,
    gallery_panels,
    left_out_panels,
    lesson_operators,
    lesson_panels,
    menus,
    model_panels,
    object_panels,
    operators,
    overlay_panels,
    point_operators,
    presets,
    render_panels,
    see_through,
    show_result,
    verify_panels,
)
from .view3d import lesson, mouse_gizmo, notice, overlay, scene_cache

CLASSES = (
    *groups.CLASSES, *overlay.CLASSES, *engine.CLASSES, *operators.CLASSES, *cast_operator.CLASSES,
    *cycles_operators.CLASSES, *add_line.CLASSES, *export_operators.CLASSES,
    *mouse_gizmo.CLASSES, *render_panels.CLASSES, *gallery_panels.CLASSES,
    *menus.CLASSES, *presets.CLASSES, *model_panels.CLASSES,
    *see_through.CLASSES, *camera_panels.CLASSES, *show_result.CLASSES, *cast_panels.CLASSES, *verify_panels.CLASSES,
    *left_out_panels.CLASSES, *lesson_operators.CLASSES, *point_operators.CLASSES, *gallery_operators.CLASSES,
    *lesson_panels.CLASSES, *facts_panels.CLASSES, *overlay_panels.CLASSES, *object_panels.CLASSES,
)  # fmt: skip
"""Blender's types, in the order in which they are registered: a panel comes after the panel that it is in."""

MODULES = (
    groups, kept, follow, reports, images, gallery, scene_cache, viewport, cast_operator, overlay, lesson, notice,
    render_panels, menus, gallery_operators, presets, export_operators, commands,
)  # fmt: skip
"""Modules that add more than classes. ``register(undo)`` adds it and gives ``undo`` the callbacks that remove it."""


class Undo(ExitStack):
    """Callbacks that each remove one thing, the last first; what another add-on or script has removed is gone."""

    def callback(self, remove, *arguments):
        """Add one."""
        return super().callback(_unless_gone, remove, *arguments)

    def add_handlers(self, handlers) -> None:
        """Add functions to the lists of these names in ``bpy.app.handlers``, until this is undone."""
        for name, function in handlers:
            own = getattr(bpy.app.handlers, name)
            own.append(function)
            self.callback(own.remove, function)


def _unless_gone(remove, *arguments) -> None:
    with suppress(AttributeError, RuntimeError, ValueError):  # what Blender and lists raise where there is nothing
        remove(*arguments)


_registered: list[Undo] = []
"""The callbacks that remove everything again; empty where nothing is registered."""


def register() -> None:
    """Register everything, if nothing is. Where that fails nothing stays registered, and the error is raised."""
    if _registered:
        return
    with Undo() as undo:
        for cls in CLASSES:
            bpy.utils.register_class(cls)
            undo.callback(bpy.utils.unregister_class, cls)
        for module in MODULES:
            module.register(undo)
        _registered.append(undo.pop_all())
    if not bpy.app.binary_path:  # Blender disables add-ons before it ends; pip's bpy crashes on what is left
        atexit.register(unregister)


def unregister() -> None:
    """Remove all that is registered and still there, the last first."""
    atexit.unregister(unregister)
    if _registered:
        _registered.pop().close()
