"""What Blender is told of: the modules in the order in which they are registered."""

from .engine import engine, viewport
from .output import reports
from .properties import groups
from .terminal import commands
from .ui import (
    camera_panels,
    cast_operator,
    cast_panels,
    model_panels,
    operators,
    overlay_panels,
    render_panels,
)
from .view3d import mouse_gizmo, overlay, scene_cache

MODULES = (
    groups, reports, scene_cache, viewport, engine, operators, cast_operator, overlay, mouse_gizmo,
    render_panels, model_panels, camera_panels, cast_panels, overlay_panels, commands,
)  # fmt: skip


def register() -> None:
    """Register every module."""
    for module in MODULES:
        module.register()


def unregister() -> None:
    """Take all of it back, the last first."""
    for module in reversed(MODULES):
        module.unregister()
