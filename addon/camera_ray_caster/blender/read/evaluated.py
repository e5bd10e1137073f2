"""A scene as a depsgraph has evaluated it: its camera, its shapes, and their motion."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from ...core.camera.build import camera_from
from ...core.camera.camera import Camera
from ...core.motion.evaluations import Motion
from ...core.records import BlenderCamera, Shapes
from .camera import camera_record
from .shapes import shapes_record

Eye = Callable[[BlenderCamera], BlenderCamera]
"""Function from the record of a camera object to the record of the eye that is read."""


@dataclass(frozen=True)
class SceneRecord:
    """Data that a cast needs from a scene."""

    raw: BlenderCamera
    """Record that the camera was made from."""
    camera: Camera
    shapes: Shapes

    def with_motion(self, motion: Motion | None) -> "SceneRecord":
        """Return the record with a motion."""
        return replace(self, camera=replace(self.camera, motion=motion), shapes=replace(self.shapes, motion=motion))


def camera_at(camera_object, depsgraph, eye: Eye | None = None) -> tuple[BlenderCamera, Camera]:
    """Return the record of a camera object or of one of its eyes, and the camera, both at the depsgraph's frame.

    Raises InputError if there is no camera, and for a camera that cannot be cast.
    """
    raw = camera_record(camera_object, depsgraph)
    raw = raw if eye is None else eye(raw)
    return raw, camera_from(raw)


def scene_at(camera_object, depsgraph, eye: Eye | None = None) -> SceneRecord:
    """Return camera and shapes at the depsgraph's frame, without motion. Raises the errors of ``camera_at``."""
    return SceneRecord(*camera_at(camera_object, depsgraph, eye), shapes_record(depsgraph))
