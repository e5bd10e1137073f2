"""A camera of a scene held against Blender's own answers."""

from ..core.camera import Camera
from ..core.records import Finding
from ..core.verify import verify
from . import witness
from .read import evaluated, read_camera


def verify_camera(scene, camera_object=None, frame=None, view="") -> list[Finding]:
    """Return the findings on the camera that ``read_camera`` returns for these arguments, or raise what that raises."""
    camera = read_camera(scene, camera_object, frame, view)
    with evaluated(scene, frame, camera_object) as depsgraph:
        return verify_evaluated(camera, scene.camera, depsgraph)


def verify_evaluated(camera: Camera, camera_object, depsgraph) -> list[Finding]:
    """Return the findings on a camera that was read of this object, as the depsgraph evaluated it."""
    by_blender = camera.model.key == camera_object.data.type  # Blender knows its own models alone
    return verify(camera, witness.ask(camera_object, depsgraph) if by_blender else None)
