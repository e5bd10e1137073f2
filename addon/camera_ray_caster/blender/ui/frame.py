"""Set Frame: the resolution becomes the one that the camera asks for, in which nothing is stretched."""

from collections.abc import Iterator
from contextlib import contextmanager

import bpy

from ...core.camera.asked_size import AskedSize, asked_size
from ...core.cameras import MODELS
from ...core.cameras.parts.settings import CAMERA, Flag
from ...core.records import InputError
from ..properties.declared import CAMERA as OWN_SETTINGS
from ..properties.declared import GROUP
from ..read.camera_fields import camera_record
from .needs import OfCamera, camera_object_of
from .notes import Note

SET_FRAME = Flag(
    "set_frame", "Set Frame",
    "Set the scene's resolution to the size or the aspect ratio of the camera's pictures. If disabled, a camera with "
    "another aspect ratio than the frame is refused",
    True,
)  # fmt: skip
TYPES = ("type", "panorama_type")


class SetFrame(OfCamera, bpy.types.Operator):
    """Set the scene's resolution to the size or the aspect ratio of the camera's pictures, so that none is stretched"""

    bl_label = "Set Frame"

    def execute(self, context):
        wanted = frame_of(context, camera_object_of(context))
        if wanted is None:
            self.report({"INFO"}, "The frame already has the aspect ratio of the camera's pictures")
            return {"CANCELLED"}
        self.report({"INFO"}, set_frame(context.scene, wanted))
        return None


def frame_of(context, item) -> AskedSize | None:
    """Return the frame that a camera object asks for, or None: see ``asked_size``, which raises InputError."""
    return asked_size(camera_record(item, context.evaluated_depsgraph_get()))


def set_frame(scene, wanted: AskedSize) -> str:
    """Set a scene's resolution, and return a line that says so."""
    render = scene.render
    before = f"{render.resolution_x} × {render.resolution_y}"
    render.resolution_x, render.resolution_y = wanted.width, wanted.height
    return f"The frame is set to {wanted.width} × {wanted.height}; it was {before}"


@contextmanager
def framed(context, item, is_set: bool) -> Iterator[list[str]]:
    """Let a camera object's settings be changed, then set the frame that the camera asks for, or refuse the change.

    Yields a list to which the line about the frame is appended. If the frame is not to be set, the settings are
    restored and InputError is raised, with both sizes.
    """
    lines: list[str] = []
    before = _settings(item.data)
    yield lines
    item.data.update_tag()
    context.view_layer.update()
    wanted = frame_of(context, item)
    if wanted is None:
        return
    if not is_set:
        for owner, name, value in before:
            setattr(owner, name, value)
        raise InputError(f"{wanted.sentence}: enable {SET_FRAME.label}, or set the resolution")
    lines.append(set_frame(context.scene, wanted))


def _settings(camera) -> list[tuple]:
    """Return (owner, name, value) of all that a preset or a calibration may set in a camera's data."""
    group = getattr(camera, GROUP)
    names = {setting.name for model in MODELS for setting in model.SETTINGS if setting.owner == CAMERA}
    owned = [(group, setting.name) for setting in OWN_SETTINGS] + [(camera, name) for name in (*TYPES, *sorted(names))]
    return [(owner, name, _value(getattr(owner, name))) for owner, name in owned if hasattr(owner, name)]


def _value(value):
    return tuple(value) if isinstance(value, bpy.types.bpy_prop_array) else value


def frame_note(context, item) -> Note | None:
    """Return both sizes and the button Set Frame if a camera object asks for another frame, or None."""
    try:
        wanted = frame_of(context, item)
    except InputError:
        return None  # the panel shows the reason, also if there is no camera
    if wanted is None:
        return None
    text = f"Set Frame to {wanted.width} × {wanted.height}"
    return Note(wanted.sentence, lambda row: row.operator(SetFrame.bl_idname, text=text, icon="FULLSCREEN_ENTER"))


CLASSES = (SetFrame,)
