"""What a cast reads of a scene, as one record: camera and shapes, with their motion and neighboring frames."""

from __future__ import annotations

from dataclasses import dataclass, replace

from .camera.camera import Camera
from .motion.evaluations import Motion
from .records import BlenderCamera, Shapes


@dataclass(frozen=True, eq=False)
class Scene:
    """A camera and the shapes that it sees, at one time. Camera and shapes of a scene that moves refer to its motion,
    and with flow to the next and the previous frame.
    """

    camera: Camera
    shapes: Shapes
    record: BlenderCamera | None = None
    """The record of Blender's camera, without the numbers of a calibration file; None for a camera made without it."""

    @property
    def raw(self) -> BlenderCamera:
        """The record that the camera was made from."""
        return self.camera.record if self.record is None else self.record

    def with_motion(self, motion: Motion | None) -> Scene:
        """Return the scene with a motion."""
        return replace(self, camera=replace(self.camera, motion=motion), shapes=replace(self.shapes, motion=motion))
