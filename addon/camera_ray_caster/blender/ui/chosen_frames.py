"""The choice of frames of operators that cast or export several cameras."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from ...core.records import InputError
from ..read.camera import ALL, find_cameras
from ..read.frames import frame_of
from ..rig import frames_of, shows

RANGE = "RANGE", "Range", "The scene's frame range, with its frame step"
CURRENT = "CURRENT", "Current", "The current frame"
POSES = "POSES", "Poses", "The frames of the poses in files of cameras: each camera in its own, others in all of them"


def usual(scene) -> str:
    """Return the choice for all cameras of a scene: POSES if any has poses from a file, else RANGE."""
    return (POSES if frames_of(find_cameras(scene, [ALL])) else RANGE)[0]


def chosen(scene, which: str, cameras: Sequence) -> tuple[Sequence[float], Callable[[Any, float], bool]]:
    """Return the frames of a choice, and a function that tells whether a camera object is shown in one of them.

    Raises InputError if there are none.
    """
    if which == CURRENT[0]:
        return [frame_of(scene)], _always
    if which == RANGE[0]:
        return range(scene.frame_start, scene.frame_end + 1, scene.frame_step), _always
    frames = frames_of(cameras)
    if not frames:
        raise InputError("no camera has poses from a file: choose Range or Current")
    return frames, shows


def _always(camera, frame: float) -> bool:
    return True
