"""Restores a scene after pictures of it were made, since in a window the user continues to work with it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress

from ..properties.passes import PASSES
from .files import LAYERS, PICTURE

RENDER = (
    "engine", "use_persistent_data", "use_sequencer", "use_render_cache", "use_lock_interface", "resolution_x",
    "resolution_y", "resolution_percentage",
)  # fmt: skip
"""Properties of a scene's render settings that the making of pictures changes; some versions of Blender lack some."""


@contextmanager
def restored(scene) -> Iterator[None]:
    """Restore a scene's camera, frame, passes and render settings afterwards, unless it was removed."""
    before = list(_values(scene))
    camera, frame = scene.camera, (scene.frame_current, scene.frame_subframe)
    try:
        yield
    finally:
        with suppress(ReferenceError):
            for owner, name, value in before:
                setattr(owner, name, value)
            with suppress(ReferenceError):  # the camera was removed
                scene.camera = camera
            scene.frame_set(frame[0], subframe=frame[1])


def _values(scene) -> Iterator[tuple]:
    """Yield (owner, name, value) of what is restored, in the order in which it has to be set."""
    owners = [(scene.render, RENDER), (scene.render.image_settings, dict.fromkeys((*PICTURE, *LAYERS)))]
    owners += [(marker, ("camera",)) for marker in scene.timeline_markers]
    owners += [(entry.settings(scene, layer), (entry.tick,)) for layer in scene.view_layers for entry in PASSES]
    for owner, names in owners:
        yield from ((owner, name, getattr(owner, name)) for name in names if hasattr(owner, name))
