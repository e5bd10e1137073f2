"""The operator that moves the pixel times with the timeline, and the note that offers it."""

import bpy

from ...core.camera.pixel_time import END, SETTINGS, START
from ..properties.declared import GROUP
from ..read.frames import frame_of
from .needs import OfCamera, camera_object_of
from .notes import Note


class FollowTimeline(OfCamera, bpy.types.Operator):
    """Add drivers that move Start and End of the pixel times with the timeline. The current frame's picture stays the
    same; in an animation each frame gets its own
    """

    bl_label = "Follow Timeline"

    @classmethod
    def why_gray(cls, context) -> str:
        if reason := super().why_gray(context):
            return reason
        is_scan = has_range(camera_object_of(context).data)
        return "" if is_scan else "Available only for slit scans and time displacement"

    def execute(self, context):
        settings = getattr(camera_object_of(context).data, GROUP)
        for setting in (START, END):
            offset = getattr(settings, setting.name) - frame_of(context.scene)
            settings.driver_add(setting.name).driver.expression = f"frame {offset:+.9g}"


def has_range(camera) -> bool:
    """Return whether a camera's pixels have times between Start and End."""
    return START in SETTINGS.get(getattr(camera, GROUP).time_mode, ())


def timeline_note(scene, camera) -> Note | None:
    """Return a note with the operator if a camera object's pixels have the same times in all frames of a movie."""
    if camera is None or camera.type != "CAMERA" or not has_range(camera.data) or scene.frame_start == scene.frame_end:
        return None
    moves = camera.data.animation_data
    if moves is not None and (moves.action or any(START.name in driver.data_path for driver in moves.drivers)):
        return None
    text = "All frames have the same times"
    return Note(text, lambda row: row.operator(FollowTimeline.bl_idname, icon="DRIVER"), "INFO")


CLASSES = (FollowTimeline,)
