"""Camera and shapes as the window shows them now: read again only after something of them has changed."""

from __future__ import annotations

from dataclasses import dataclass, replace

import bpy
from bpy.app.handlers import persistent

from ...core.camera.build import camera_from
from ...core.camera.camera import Camera
from ...core.records import BlenderCamera, InputError, Shapes
from ..read.scene import camera_record, shapes_record


@dataclass(frozen=True, eq=False)
class Observed:
    """What ``observe`` has read: another one after every change, and equal to itself alone."""

    key: tuple
    """The scene, the view layer and the camera that it was read of."""
    raw: BlenderCamera | None
    """None where there is no camera."""
    camera: Camera | None
    """At the current frame, without a clock; None where there is no camera that can be cast."""
    shapes: Shapes


_read: list[Observed] = []
_stale = {"camera", "shapes"}


def observe(context) -> Observed:
    """Return the active camera and the shapes of the window's scene, evaluated."""
    scene, layer = context.scene, context.view_layer
    key = scene.as_pointer(), layer.as_pointer(), scene.camera and scene.camera.as_pointer()
    if _read and not _stale and _read[0].key == key:
        return _read[0]
    depsgraph = context.evaluated_depsgraph_get()
    known = _read[0].shapes if _read and _read[0].key[:2] == key[:2] and "shapes" not in _stale else None
    shapes = shapes_record(depsgraph) if known is None else known
    _read[:] = [Observed(key, *_camera(scene, depsgraph), shapes)]
    _stale.clear()
    return _read[0]


def _camera(scene, depsgraph) -> tuple[BlenderCamera | None, Camera | None]:
    raw = None
    try:
        raw = camera_record(scene, scene.camera, depsgraph)
        return raw, replace(camera_from(raw), pixel_time=None)
    except InputError:
        return raw, None  # the sidebar says why


@persistent
def tag(scene, depsgraph):
    """Something was evaluated: where it is cameras alone, the shapes are what they were."""
    _stale.add("camera")
    for update in depsgraph.updates:
        source = update.id.original
        if not isinstance(source, bpy.types.Camera) and getattr(source, "type", "") != "CAMERA":
            _stale.add("shapes")


@persistent
def tag_all(*_):
    """Another frame, an undo or another file: nothing is what it was."""
    _stale.update(("camera", "shapes"))


@persistent
def forget(*_):
    """Another file: keep nothing of this one."""
    _read.clear()
    tag_all()


HANDLERS = (
    ("depsgraph_update_post", tag),
    ("frame_change_post", tag_all),
    ("undo_post", tag_all),
    ("redo_post", tag_all),
    ("load_pre", forget),
)


def register() -> None:
    """See ``registration``."""
    for name, function in HANDLERS:
        getattr(bpy.app.handlers, name).append(function)


def unregister() -> None:
    """See ``registration``."""
    for name, function in reversed(HANDLERS):
        getattr(bpy.app.handlers, name).remove(function)
    forget()
