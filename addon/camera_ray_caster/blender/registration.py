"""What Blender is told of: the modules in the order in which they are registered."""

from . import (
    cast_operator,
    engine,
    mouse_gizmo,
    observed,
    operators,
    overlay,
    panels,
    panels_camera,
    panels_cast,
    panels_model,
    panels_overlay,
    properties,
    reports,
    terminal,
    viewport,
)

MODULES = (
    properties, reports, observed, viewport, engine, operators, cast_operator, overlay, mouse_gizmo,
    panels, panels_model, panels_camera, panels_cast, panels_overlay, terminal,
)  # fmt: skip


def register() -> None:
    """Register every module."""
    for module in MODULES:
        module.register()


def unregister() -> None:
    """Take all of it back, the last first."""
    for module in reversed(MODULES):
        module.unregister()
