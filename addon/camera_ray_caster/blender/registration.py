"""What Blender is told of: the modules in the order in which they are registered."""

from . import properties

MODULES = (properties,)


def register() -> None:
    for module in MODULES:
        module.register()


def unregister() -> None:
    for module in reversed(MODULES):
        module.unregister()
