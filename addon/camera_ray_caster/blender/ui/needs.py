"""What operators share: which camera they are about, when they are grayed out, and errors in one line."""

from functools import wraps

from ...core.records import InputError

NO_CAMERA = "The scene has no active camera: add one, or set one in the Scene properties"


def camera_object_of(context):
    """Return the camera object that a panel is about: the active object, or else the scene's camera."""
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
    """An operator on the camera of the scene."""

    @classmethod
    def poll(cls, context):
        """Grayed out without a camera."""
        cls.poll_message_set(NO_CAMERA)
        return context.scene.camera is not None


class OfCamera:
    """An operator on the camera of the panel."""

    @classmethod
    def poll(cls, context):
        """Grayed out without a camera in the context."""
        cls.poll_message_set("Select a camera object first")
        return camera_object_of(context) is not None


def reporting(execute):
    """Let an operator's ``execute`` show an InputError as Blender shows errors, and change nothing then."""

    @wraps(execute)
    def reported(self, context):
        try:
            return execute(self, context)
        except InputError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}

    return reported
