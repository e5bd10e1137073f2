"""Cache of the camera and the shapes that the window shows; they are read again only after a change."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import bpy
from bpy.app.handlers import persistent

from ...core.camera.camera import Camera
from ...core.records import BlenderCamera, Shapes
from .depsgraph_shapes import shapes_record
from .evaluated import camera_or_reason, forget_cameras
from .frames import frame_of
from .render_differences import evaluated_otherwise


@dataclass(frozen=True, eq=False)
class CachedScene:
    """The result of ``cached_scene``: a new object after every change, compared by identity."""

    key: tuple
    """Pointers of the scene, the view layer and the camera."""
    raw: BlenderCamera | None
    """The record of the camera; None without a camera that can be cast."""
    camera: Camera | None
    """The camera at the current frame, without pixel times; None without a camera that can be cast."""
    shapes: Shapes
    reason: str = ""
    """Why the camera cannot be cast."""
    differences: tuple[str, ...] = ()
    """Differences between a render and the window, in sentences."""
    otherwise: tuple[str, ...] = ()
    """Names of the objects that a render evaluates otherwise: see ``evaluated_otherwise``."""


TIMES = "Every pixel is shown at frame"
"""Beginning of the sentence about a camera whose pixels have their own times."""
_read: list[CachedScene] = []
_stale = {"camera", "shapes"}


def cached_scene(context) -> CachedScene:
    """Return the active camera and the shapes of the window's scene, evaluated."""
    scene, layer = context.scene, context.view_layer
    key = scene.as_pointer(), layer.as_pointer(), scene.camera and scene.camera.as_pointer()
    if _read and not _stale and _read[0].key == key:
        return _read[0]
    depsgraph = context.evaluated_depsgraph_get()
    if _read and _read[0].key[:2] == key[:2] and "shapes" not in _stale:
        shapes, otherwise = _read[0].shapes, _read[0].otherwise
    else:
        shapes, otherwise = shapes_record(depsgraph), evaluated_otherwise(depsgraph)
    raw, camera, reason = camera_or_reason(scene.camera, depsgraph)
    messages = tuple(differences(camera, scene))
    camera = camera and replace(camera, pixel_time=None)
    _read[:] = [CachedScene(key, raw, camera, shapes, reason, messages, otherwise)]
    _stale.clear()
    return _read[0]


def differences(camera: Camera | None, scene) -> Iterator[str]:
    """Yield sentences about how a render differs from the window."""
    if camera is None:
        return
    if camera.pixel_time is not None:
        now, first, last = frame_of(scene), camera.pixel_time.first, camera.pixel_time.last
        yield f"{TIMES} {now:g}; in a render, each pixel has its own time, from frame {first:.4g} to {last:.4g}"
    if camera.aperture is not None:
        samples = scene.camera_ray_caster.samples
        blurred = f"; a render with {samples} samples has depth of field"
        rendered = blurred if samples > 1 else ", as in a render with 1 sample"
        yield f"Only rays through the center of the lens are shown{rendered}"


@persistent
def tag(scene, depsgraph):
    """Mark the camera as changed after an evaluation, and the shapes too unless only cameras were updated."""
    _stale.add("camera")
    for update in depsgraph.updates:
        source = update.id.original
        is_camera_object = isinstance(source, bpy.types.Object) and source.type == "CAMERA"
        if not (is_camera_object or isinstance(source, bpy.types.Camera)):
            _stale.add("shapes")


@persistent
def tag_all(*_):
    """Mark everything as changed: after a frame change, an undo or redo, or a new file."""
    _stale.update(("camera", "shapes"))


@persistent
def forget(*_):
    """Forget the cached scene: another file is loaded."""
    _read.clear()
    forget_cameras()
    tag_all()


def register(undo) -> None:
    undo.callback(forget)
    undo.add_handlers(tag, "depsgraph_update_post")
    undo.add_handlers(tag_all, "frame_change_post", "undo_post", "redo_post")
    undo.add_handlers(forget, "load_pre")
