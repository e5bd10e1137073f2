"""Properties of Blender that are changed for a while."""

from contextlib import ExitStack


def changed(stack: ExitStack, owner, **values) -> None:
    """Set properties of a Blender struct until the stack is closed."""
    for name, value in values.items():
        stack.callback(setattr, owner, name, getattr(owner, name))
        setattr(owner, name, value)
