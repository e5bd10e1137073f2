"""Shared parts of operators: the camera that they work on, when they are grayed out, and error messages."""

import os
import re
from functools import wraps
from pathlib import Path

import bpy

from ...core.records import InputError
from ..properties.declared import GROUP
from ..properties.setting_labels import in_labels
from ..read.camera_fields import check_camera
from .drawing import draw_message
from .model_settings import lacks, missing

LINKED = "The camera is linked from another file: first make it local or a library override"


def camera_object_of(context):
    """Return the object of the camera that the panels around an operator show, or None.

    It is the camera of the Properties editor's tab, or of the layout's context pointer ``camera``; everywhere else, as
    in the sidebar, it is the scene's camera, whatever is selected.
    """
    data = getattr(context, "camera", None)
    if data is None:
        return context.scene.camera
    users = (context.object, *context.scene.objects)
    return next((item for item in users if item is not None and item.data == data), None)


def objection(context, item, is_changed: bool = False) -> str:
    """Return why an object cannot be used as a camera, or not be changed if it ``is_changed``; "" if it can."""
    try:
        check_camera(context.scene, item)
    except InputError as error:
        return in_labels(str(error))
    return LINKED if is_changed and not item.data.is_editable else ""


def select_alone(context, *items) -> None:
    """Select these objects and no others, and make the first one active, if there is one."""
    for item in context.selected_objects:
        item.select_set(False)
    for item in items:
        item.select_set(True)
    if items:
        context.view_layer.objects.active = items[0]


class Action:
    """Base of the operators. Their identifiers are the names of their classes: ``SetFrame`` is
    ``camera_ray_caster.set_frame``.

    ``execute``, ``invoke`` and ``modal`` return FINISHED where they return nothing. An InputError is reported as a
    Blender error, and they return CANCELLED.
    """

    bl_options = {"REGISTER", "UNDO"}

    def __init_subclass__(cls):
        super().__init_subclass__()
        if "bl_idname" not in vars(cls):
            cls.bl_idname = f"{GROUP}.{re.sub('(?<!^)(?=[A-Z])', '_', cls.__name__).lower()}"
        for name in {"execute", "invoke", "modal"} & vars(cls).keys():
            setattr(cls, name, _reporting(vars(cls)[name]))

    @classmethod
    def why_gray(cls, context) -> str:
        """Return why the operator is gray, for its tooltip; "" if it can be used."""
        return ""

    @classmethod
    def poll(cls, context):
        if reason := cls.why_gray(context):
            cls.poll_message_set(reason)
        return not reason


def _reporting(method):
    """Return an operator's method, with its errors reported: see ``Action``."""

    def reported(self, *arguments):
        try:
            return method(self, *arguments) or {"FINISHED"}
        except InputError as error:
            self.report({"ERROR"}, in_labels(str(error)))
            return {"CANCELLED"}

    def with_event(self, context, event):
        return reported(self, context, event)

    def without(self, context):
        return reported(self, context)

    return wraps(method)(without if method.__name__ == "execute" else with_event)  # Blender counts the parameters


class OfScene(Action):
    """Base of the operators on the scene's camera."""

    @classmethod
    def why_gray(cls, context) -> str:
        return objection(context, context.scene.camera)


class OfCamera(Action):
    """Base of the operators on the panel's camera, which they change."""

    @classmethod
    def why_gray(cls, context) -> str:
        return objection(context, camera_object_of(context), is_changed=True)


class OfRays(OfCamera):
    """Base of the operators that need the rays of the panel's camera, and so the model's objects, such as slits."""

    @classmethod
    def why_gray(cls, context) -> str:
        lacking = missing(context, camera_object_of(context))
        return super().why_gray(context) or (lacks(lacking[0]) if lacking else "")


class OfFile(Action):
    """Base of the operators that ask for a file."""

    def invoke(self, context, event):
        """Ask for the file, beside the .blend; without a name, for which Blender would take that of the .blend."""
        if not self.filepath:
            self.filepath = os.path.join(Path(bpy.data.filepath).parent if bpy.data.filepath else Path.home(), "")
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def draw_found(self, context, lines) -> None:
        """Draw what ``lines`` returns of the path that is chosen in the file dialog, or what is wrong with the file."""
        chosen = context.space_data.params
        path = Path(bpy.path.abspath(chosen.directory.decode())) / chosen.filename
        if not path.is_file():
            return
        try:
            sentences = lines(str(path))
        except InputError as error:
            sentences = [in_labels(str(error))]
        for line in sentences:
            draw_message(self.layout, context, line)
