"""What a cast reads of a scene, as one record: camera and shapes, with their motion and the neighboring frames."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from .camera.camera import Camera
from .records import Shapes
from .timeline import MovingScene, Timeline


@dataclass(frozen=True, eq=False)
class Scene:
    """A camera and the shapes that it sees, at one time, and through their timelines at others."""

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
            return camera
        if not (isinstance(camera, Camera) and isinstance(shapes, Shapes)):
            types = f"{type(camera)} and {type(shapes)}"
            raise TypeError(f"{to} takes a camera and shapes, or a scene and all else by name, not {types}")
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
    def motion(self) -> MovingScene | None:
        """The scene over the times of the camera's pixels; None if they have one time, or nothing moves."""
        return self.camera.timeline.motion

    @property
    def next(self) -> Scene | None:
        """The scene at the next frame, and in ``previous`` at the previous one. None if it was not read."""
        return self._other("next")

    @property
    def previous(self) -> Scene | None:
        """The scene at the previous frame. None if it was not read."""
        return self._other("previous")

    def at(self, frame: float | None) -> Scene:
        """Return the scene at a frame, without pixel times; itself if ``frame`` is None."""
        return self if frame is None else Scene(self.camera.at(frame), self.shapes.at(frame))

    def at_rest(self) -> Scene:
        """Return the scene without pixel times if nothing moves meanwhile, else itself."""
        motions = self.camera.timeline.motion, self.shapes.timeline.motion
        if self.camera.pixel_time is None or not all(motion is None or motion.is_still for motion in motions):
            return self
        return Scene(replace(self.camera, pixel_time=None), self.shapes)

    def with_timeline(
        self, motion: MovingScene | None = None, next: Scene | None = None, previous: Scene | None = None
    ) -> Scene:
        """Return the scene with its motion and its neighboring frames, to which camera and shapes refer."""
        timeline = Timeline(motion, next, previous)
        return Scene(replace(self.camera, timeline=timeline), replace(self.shapes, timeline=timeline))

    def _other(self, name: str) -> Scene | None:
        """Return a neighboring frame: the camera and the shapes may have been read one by one."""
        ours, theirs = getattr(self.camera.timeline, name), getattr(self.shapes.timeline, name)
        return None if None in (ours, theirs) else Scene(ours.camera, theirs.shapes)
