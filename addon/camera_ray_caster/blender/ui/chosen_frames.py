"""The choice of frames of operators that cast or export several cameras."""

from collections.abc import Callable, Sequence
from typing import Any

from ...core.records import InputError
from ..read.camera_fields import ALL, find_cameras
from ..read.frames import frame_of
from ..rig import frames_of, shows

RANGE = "RANGE", "Range", "The scene's frame range, with its frame step"
CURRENT = "CURRENT", "Current", "The current frame"
POSES = "POSES", "Poses", "The frames of the poses in files of cameras: each camera in its own, others in all of them"


def usual(scene) -> str:
    """Return the choice for all cameras of a scene: POSES if any has poses from a file, else RANGE."""
    return (POSES if frames_of(find_cameras(scene, [ALL])) else RANGE)[0]


def chosen(scene, choice: str, cameras: Sequence) -> tuple[Sequence[float], Callable[[Any, float], bool]]:
    """Return the frames of a choice, and a function that tells whether a camera object is shown in one of them.

    Raises InputError if there are none.
    """
    if choice == CURRENT[0]:
        return [frame_of(scene)], lambda *_: True
    if choice == RANGE[0]:
        return range(scene.frame_start, scene.frame_end + 1, scene.frame_step), lambda *_: True
    frames = frames_of(cameras)
    if not frames:
        raise InputError("no camera has poses from a file: choose Range or Current")
    return frames, shows


def as_options(scene, choice: str, cameras: Sequence) -> list[str]:
    """Return the words of the terminal's commands for a choice. Raises InputError if there are no frames."""
    frames, _ = chosen(scene, choice, cameras)
    if choice == POSES[0]:
        return ["--poses"]
    if choice == CURRENT[0]:
        return [f"--frame={frames[0]!r}"]
    return [f"--frames={scene.frame_start}:{scene.frame_end}:{scene.frame_step}"]


def in_words(scene, choice: str, seconds: float = 0.0) -> str:
    """Return how many pictures of all cameras a choice of frames makes, and about how long they take if one takes
    ``seconds``. Raises InputError if there are none.
    """
    cameras = find_cameras(scene, [ALL])
    frames, is_shown = chosen(scene, choice, cameras)
    count = sum(is_shown(camera, frame) for camera in cameras for frame in frames)
    text = _counted(count, "picture")
    if count == len(cameras) * len(frames):
        text = f"{_counted(len(cameras), 'camera')} × {_counted(len(frames), 'frame')} = {text}"
    if seconds:
        minutes = round(count * seconds / 60)
        text += f", about {_counted(minutes, 'minute')}" if minutes else ", less than a minute"
    return text


def _counted(count: int, noun: str) -> str:
    return f"{count:,} {noun}{'' if count == 1 else 's'}"
