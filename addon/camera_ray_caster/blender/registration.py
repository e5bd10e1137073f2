"""What Blender is told of: the modules in the order in which they are registered."""

from . import engine, operators, panels, properties, reports, terminal

MODULES = (properties, reports, engine, operators, panels, terminal)


def register() -> None:
    for module in MODULES:
        module.register()


def unregister() -> None:
    for module in reversed(MODULES):
        module.unregister()
