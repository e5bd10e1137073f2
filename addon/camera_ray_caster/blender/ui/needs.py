"""Shared parts of operators: the camera that they work on, when they are grayed out, and error messages."""

from functools import wraps

from ...core.records import InputError

NO_CAMERA = "The scene has no active camera: add a camera, or set a camera in the Scene properties"


LINKED = "The camera is linked from another file: make it local, or an override, first"


def camera_object_of(context):
    """Return the camera object that a panel shows: the active object if it is a camera, else the scene's camera."""
    item = context.object
    return item if item is not None and item.type == "CAMERA" else context.scene.camera


def select_alone(context, *items) -> None:
    """Select these objects and no others, and make the first one active."""
    for item in context.selected_objects:
        item.select_set(False)
    for item in items:
        item.select_set(True)
    context.view_layer.objects.active = items[0]


class OfScene:
    """Base of the operators on the scene's camera."""

    @classmethod
    def poll(cls, context):
        """Gray out the operator without a camera."""
        cls.poll_message_set(NO_CAMERA)
        return context.scene.camera is not None


class OfCamera:
    """Base of the operators on the panel's camera."""

    @classmethod
    def poll(cls, context):
        """Gray out the operator without a camera in the context, and for one that cannot be changed."""
        item = camera_object_of(context)
        is_linked = item is not None and item.data is not None and not item.data.is_editable
        cls.poll_message_set(LINKED if is_linked else "Select a camera object first")
        return item is not None and not is_linked


def reporting(execute):
    """Decorate an operator's ``execute`` so that it reports an InputError as a Blender error and returns CANCELLED."""

    @wraps(execute)
    def reported(self, context):
        try:
            return execute(self, context)
        except InputError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}

    return reported
