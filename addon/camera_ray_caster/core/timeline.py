"""A scene at other times: its motion over the times of pixels, and its neighboring frames."""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol

import numpy as np


class MovingScene(Protocol):
    """An object that returns the camera and the shapes of a scene at any frame, such as ``Motion``."""

    @property
    def is_still(self) -> bool:
        """Whether neither the camera nor the shapes move."""

    @property
    def cuts(self) -> tuple[float, ...]:
        """The frames at which motion may change abruptly."""

    def camera_at(self, frame: float) -> Any:
        """Return the ``Camera`` at a frame, without its pixel times."""

    def poses_at(self, frames: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
        """Return the eyes (n, 3) and bases (n, 3, 3) of the camera at frames (n,); None if its model changes."""

    def shapes_at(self, frame: float) -> Any:
        """Return the ``Shapes`` at a frame."""

    def in_words(self) -> list[str]:
        """Return lines for the report on the accuracy of the motion."""


class Timeline(NamedTuple):
    """A scene at other times than that of its camera and shapes, which both refer to it."""

    motion: MovingScene | None = None
    """The scene over the times of the camera's pixels; None if they have one time, or nothing moves."""
    next: Any = None
    """The ``Scene`` at the next frame, and in ``previous`` at the previous one: see ``casting.flow``. None if not read.
    """
    previous: Any = None


ONE_TIME = Timeline()
"""The timeline of a camera and of shapes of which no other time is known."""
