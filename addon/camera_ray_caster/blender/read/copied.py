"""A copy of a window's scene, which can be evaluated at other frames while the window shows its own.

The window's scene keeps its frame, and objects that were moved without a keyframe keep their places. The copy shares
all data with the scene, and exists during one reading only.
"""

from collections.abc import Iterator
from contextlib import contextmanager

import bpy

from . import shape_cache

EVENTS = "depsgraph_update_pre", "depsgraph_update_post", "frame_change_pre", "frame_change_post"


@contextmanager
def copied(window) -> Iterator[bpy.types.Scene]:
    """Yield a copy of a window's scene. Handlers of evaluations do not run meanwhile, but for those that keep meshes:
    they would change the scene itself.
    """
    with bpy.context.temp_override(window=window), _without_handlers():
        copy = window.scene.copy()
        shape_cache.copies.add(copy.session_uid)
        try:
            yield copy
        finally:
            shape_cache.forget_copy()
            bpy.data.scenes.remove(copy)
            for other in bpy.context.window_manager.windows:
                other.view_layer.update()  # reports all objects once, as a copy is removed


@contextmanager
def _without_handlers() -> Iterator[None]:
    """Take out the handlers that are not of the cache of shapes."""
    before = {name: list(getattr(bpy.app.handlers, name)) for name in EVENTS}
    try:
        for name, handlers in before.items():
            of_shapes = [handler for handler in handlers if handler in (shape_cache.watch, shape_cache.tag)]
            getattr(bpy.app.handlers, name)[:] = of_shapes
        yield
    finally:
        for name, handlers in before.items():
            getattr(bpy.app.handlers, name)[:] = handlers
