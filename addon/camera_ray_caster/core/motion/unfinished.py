"""The motion of a scene that is not resolved yet, and by cameras of another size: for pictures to look at."""

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise

import numpy as np

from ..camera.camera import Camera
from .evaluations import Motion, with_lens_of
from .interpolation import State, TimeInterval


def linear(states: dict[float, State], tolerance: float) -> Motion:
    """Return the motion that is linear between two or more evaluations, in order, and of unknown accuracy."""
    pairs = tuple(pairwise(states))
    intervals = tuple(TimeInterval.of(states, pair) for pair in pairs)
    return Motion(intervals, states, tolerance, estimated=np.inf, unresolved=pairs)


def seen_by(motion: Motion, camera_of: Callable[[Camera], Camera]) -> Motion:
    """Return a motion with the cameras that a function makes of its own, such as those of another size."""
    states: dict[float, State] = {}
    for frame, (camera, shapes) in motion.states.items():
        state = camera_of(camera), shapes
        states[frame] = with_lens_of(next(iter(states.values()), state), state)
    intervals = tuple(TimeInterval.of(states, interval.frames) for interval in motion.intervals)
    return replace(motion, intervals=intervals, states=states)
