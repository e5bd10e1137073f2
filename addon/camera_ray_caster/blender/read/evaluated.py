"""A scene as a depsgraph has evaluated it: its camera, its shapes, and their motion."""

from collections.abc import Callable

from ...core.camera.build import camera_from
from ...core.camera.camera import Camera
from ...core.records import BlenderCamera, InputError
from ...core.scene import Scene
from ..properties.setting_labels import in_labels
from .camera_fields import camera_record
from .depsgraph_shapes import shapes_record

Eye = Callable[[BlenderCamera], BlenderCamera]
"""Function from the record of a camera object to the record of the eye that is read."""


def camera_at(camera_object, depsgraph, eye: Eye | None = None) -> tuple[BlenderCamera, Camera]:
    """Return the record of a camera object or of one of its eyes, and the camera, both at the depsgraph's frame.

    Raises InputError if there is no camera, and for a camera that cannot be cast.
    """
    raw = camera_record(camera_object, depsgraph)
    raw = raw if eye is None else eye(raw)
    return raw, camera_from(raw)


def camera_or_reason(
    camera_object, depsgraph, eye: Eye | None = None
) -> tuple[BlenderCamera, Camera, str] | tuple[None, None, str]:
    """Return what ``camera_at`` does and "", or None twice and why the camera cannot be cast, in one line."""
    try:
        return *camera_at(camera_object, depsgraph, eye), ""
    except InputError as error:
        return None, None, in_labels(str(error))


Read = Callable[..., Scene]
"""Function from a camera object and a depsgraph to the scene at the depsgraph's frame: ``scene_at`` with its options.
"""


def scene_at(camera_object, depsgraph, eye: Eye | None = None, has_colors: bool = True) -> Scene:
    """Return camera and shapes at the depsgraph's frame, without motion; see ``shapes_record`` for ``has_colors``.
    Raises the errors of ``camera_at``.
    """
    _, camera = camera_at(camera_object, depsgraph, eye)
    return Scene(camera, shapes_record(depsgraph, has_colors))
