"""Restores a scene after pictures of it were made, since in a window the user continues to work, and may save it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress

from ..properties.passes import PASSES
from .file_outputs import writing
from .saving import LAYERS, PICTURE

RENDER = (
    "engine", "use_persistent_data", "use_sequencer", "use_render_cache", "use_lock_interface", "resolution_x",
    "resolution_y", "resolution_percentage",
)  # fmt: skip
"""Properties of the render settings that making pictures changes; some versions of Blender lack some."""


@contextmanager
def restored(scene) -> Iterator[Callable[[], None]]:
    """Restore a scene's camera, frame, passes and render settings afterwards, as far as they were not removed.

    Yields a function that exchanges what the scene has for what it had before. Called before and after the file is
    saved, it lets the file have what the user has set.
    """
    kept = list(_values(scene))

    def exchange() -> None:
        had = []
        for owner, name, _ in kept:
            with suppress(ReferenceError):  # the scene, or a part of it, was removed
                had.append((owner, name, getattr(owner, name)))
        for owner, name, value in kept:
            with suppress(ReferenceError):  # or the camera
                setattr(owner, name, value)
        kept[:] = had

    try:
        yield exchange
    finally:
        exchange()
        with suppress(ReferenceError):
            scene.frame_set(scene.frame_current, subframe=scene.frame_subframe)


def _values(scene) -> Iterator[tuple]:
    """Yield (owner, name, value) of what is restored, in the order in which it has to be set."""
    owners = [(scene.render, RENDER), (scene.render.image_settings, dict.fromkeys((*PICTURE, *LAYERS)))]
    owners += [(marker, ("camera",)) for marker in scene.timeline_markers]
    owners += [(entry.settings(scene, layer), (entry.tick,)) for layer in scene.view_layers for entry in PASSES]
    owners += [(scene.camera_ray_caster, ("exact_shapes",)), *((node, ("mute",)) for node in writing(scene))]
    owners += [(scene, ("camera", "frame_current", "frame_subframe"))]
    for owner, names in owners:
        yield from ((owner, name, getattr(owner, name)) for name in names if hasattr(owner, name))
