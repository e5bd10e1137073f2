"""What a cast reads of a scene, as one record: camera and shapes, with their motion and the neighboring frames."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Protocol

from .camera.camera import Camera
from .camera.times import MovingCamera
from .records import Shapes
from .shape_records import MovingShapes


class MovingScene(MovingCamera[Camera], MovingShapes, Protocol):
    """An object that returns the camera and the shapes of a scene at any frame, such as ``Motion``."""


@dataclass(frozen=True, eq=False)
class Scene:
    """A camera and the shapes that it sees. Each of the two knows itself at other times."""

    camera: Camera
    shapes: Shapes

    def __repr__(self) -> str:
        return f"<Scene {self.camera}, {self.shapes}>"

    @classmethod
    def given(cls, camera: Camera | Scene, shapes: Shapes | None, to: str) -> Scene:
        """Return the scene that is given to a function as camera and shapes, or as one record. Raises TypeError, which
        names the function, for anything else.
        """
        if isinstance(camera, Scene) and shapes is None:
            shapes, camera = camera.shapes, camera.camera
        if not (isinstance(camera, Camera) and isinstance(shapes, Shapes)):
            types = f"{type(camera).__name__} and {type(shapes).__name__}"
            several = "; make one of several shapes: join(*shapes)" if isinstance(shapes, list | tuple) else ""
            raise TypeError(f"{to} takes a camera and shapes, or a scene and all else by name, not {types}{several}")
        return cls(camera, shapes)

    @classmethod
    def given_with(cls, camera: Camera | Scene, shapes: Any, value: Any, to: str) -> tuple[Scene, Any]:
        """Return the scene and the value of a function that takes both, or a camera, shapes and the value.

        Raises TypeError as ``given`` does.
        """
        if isinstance(camera, Scene) and value is None:
            shapes, value = None, shapes
        return cls.given(camera, shapes, to), value

    @property
    def motion(self) -> MovingCamera[Camera] | None:
        """The scene over the times of the camera's pixels; None if they have one time, or nothing moves."""
        return self.camera.motion

    @property
    def next(self) -> Scene | None:
        """The scene at the next frame, and in ``previous`` at the previous one. None if it was not read."""
        camera, shapes = self.camera.next, self.shapes.next
        return None if camera is None or shapes is None else Scene(camera, shapes)

    @property
    def previous(self) -> Scene | None:
        """The scene at the previous frame. None if it was not read."""
        camera, shapes = self.camera.previous, self.shapes.previous
        return None if camera is None or shapes is None else Scene(camera, shapes)

    def at(self, frame: float | None) -> Scene:
        """Return the scene at a frame, without pixel times; itself if ``frame`` is None."""
        return self if frame is None else Scene(self.camera.at(frame), self.shapes.at(frame))

    def at_rest(self) -> Scene:
        """Return the scene without pixel times if nothing moves meanwhile, else itself."""
        motions = self.camera.motion, self.shapes.motion
        if self.camera.pixel_time is None or not all(motion is None or motion.is_still for motion in motions):
            return self
        return replace(self, camera=replace(self.camera, pixel_time=None))

    def with_timeline(
        self, motion: MovingScene | None = None, next: Scene | None = None, previous: Scene | None = None
    ) -> Scene:
        """Return the scene with other neighboring frames, and with another motion unless that is None; camera and
        shapes take what is theirs.
        """
        camera, shapes = self.camera, self.shapes
        if motion is not None:
            camera, shapes = replace(camera, motion=motion), replace(shapes, motion=motion)
        of_camera: dict[str, Any] = {}
        of_shapes: dict[str, Any] = {}
        for name, scene in (("next", next), ("previous", previous)):
            of_camera[name], of_shapes[name] = (None, None) if scene is None else (scene.camera, scene.shapes)
        return Scene(replace(camera, **of_camera), replace(shapes, **of_shapes))
