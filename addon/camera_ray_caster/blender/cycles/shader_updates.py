"""Handlers that update the shaders of cameras when their settings change: lens, shift, a slit or the resolution."""

import pickle

import bpy
from bpy.app.handlers import persistent

from ...core.camera.build import camera_from
from ...core.records import BlenderCamera, InputError
from ...core.shaders.camera_shader import CameraShader
from ..read.camera_fields import camera_record, shader_mark
from .convert import shader_of
from .shader import CUSTOM, has_inputs, is_enabled, rewrite, set_inputs

_known: dict[int, tuple[bytes, CameraShader]] = {}
"""Shaders of camera objects and the states that they were made from, by the objects' session_uid."""


@persistent
def follow(scene, depsgraph):
    """Update the shaders of a scene's custom cameras, if there are any."""
    customs = {camera.session_uid for camera in bpy.data.cameras if camera.type == CUSTOM}
    if not customs or not is_enabled():
        return
    for item in {item.session_uid: item for item in (*scene.objects, scene.camera) if item is not None}.values():
        if item.type == "CAMERA" and item.data.session_uid in customs and not _is_shared(item, scene.camera):
            update(item, depsgraph)


def _is_shared(item, active) -> bool:
    """Whether the active camera is another object with the same data. The shader is then that of the active camera."""
    return active is not None and item != active and item.data == active.data


def update(camera_object, depsgraph) -> None:
    """Update a camera's shader, if it is one of ours. A camera that cannot be cast keeps its shader."""
    camera = camera_object.data
    mark, known = shader_mark(camera), _known.get(camera_object.session_uid)
    if mark is None:
        return
    try:
        raw = camera_record(camera_object, depsgraph)
        state = _state(raw)
        if known is None or known[0] != state:
            known = state, shader_of(raw, camera_from(raw), mark.places)
    except InputError:  # the sidebar shows the reason
        return
    _known[camera_object.session_uid] = known
    _, shader = known
    if camera.custom_shader.as_string() == shader.source:
        set_inputs(camera, shader)  # a user may have changed them
        if not has_inputs(camera_object.evaluated_get(depsgraph).data, shader):  # keyframes override them
            camera.update_tag()
    else:
        rewrite(camera, shader)


def _state(raw: BlenderCamera) -> bytes:
    settings = {name: value for name, value in raw.settings.items() if name != "frame"}
    return pickle.dumps(vars(raw) | {"settings": settings})


@persistent
def forget(*_):
    """Forget all shaders: after an undo or in another file, any object may have changed."""
    _known.clear()


def register(undo) -> None:
    undo.callback(forget)
    undo.add_handlers(follow, "depsgraph_update_post", "frame_change_post")
    undo.add_handlers(forget, "undo_post", "redo_post", "load_pre")
