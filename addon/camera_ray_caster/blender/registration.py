"""What Blender is told of: the modules in the order in which they are registered."""

from . import cast_operator, engine, operators, panels, panels_camera, panels_cast, properties, reports, terminal

MODULES = (properties, reports, engine, operators, cast_operator, panels, panels_camera, panels_cast, terminal)


def register() -> None:
    """Register every module."""
    for module in MODULES:
        module.register()


def unregister() -> None:
    """Take all of it back, the last first."""
    for module in reversed(MODULES):
        module.unregister()
