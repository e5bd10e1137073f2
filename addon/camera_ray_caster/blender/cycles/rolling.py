"""Cycles cameras whose rows are exposed one after another, by Cycles' own rolling shutter from the top row down."""

from typing import Any

from ...core.camera.camera import Camera
from ...core.camera.pixel_time import ROLLING_SHUTTER, LinearTime
from ...core.camera.times import SweepTime
from ...core.records import BlenderCamera, InputError
from ...core.shaders.turn import UPRIGHT, Turn, shutter_of
from ..read.frames import go_to

MOTION_STEPS = 7
"""Motion steps of every object in a slit scan: 2^7 + 1 places over its frames, Cycles' maximum."""


def check_time(raw: BlenderCamera, camera: Camera) -> None:
    """Raise InputError for pixel times whose order is not Cycles' order of rows."""
    time = camera.pixel_time
    if time is None or (isinstance(time, LinearTime) and Turn.of(time) == UPRIGHT):
        return
    if isinstance(time, SweepTime):
        raise InputError(f"Cycles cannot move camera {raw.name!r} from beam to beam: set Time to One Time")
    other = "set Readout to Top to Bottom" if is_shutter(raw) else "set End to an earlier frame than Start"
    raise InputError(
        f"each pixel of camera {raw.name!r} has its own time, but Cycles exposes rows from the top down: render the "
        f"camera with cast.py --engine CYCLES, or {other}"
    )


def is_shutter(raw: BlenderCamera) -> bool:
    """Whether a camera's pixel times come from the scene's own rolling shutter."""
    return bool(raw.settings["time_mode"] == ROLLING_SHUTTER)


def blur_settings(scene, raw: BlenderCamera, camera: Camera, objects) -> list[tuple[Any, dict[str, Any]]]:
    """Return the settings, as owners and values, that give Cycles' rolling shutter the times of a camera's rows.

    objects: the objects that may move in a slit scan.
    """
    settings = [(scene.cycles, {"rolling_shutter_type": "TOP"}), (scene.render, {"use_motion_blur": True})]
    if is_shutter(raw):
        return settings
    _, frames = shutter_of(camera.pixel_time, camera.raster)
    moving = {"use_motion_blur": True, "use_deform_motion": True, "motion_steps": MOTION_STEPS}
    return [
        *settings,
        (scene.render, {"motion_blur_position": "START", "motion_blur_shutter": frames}),
        (scene.cycles, {"rolling_shutter_duration": 0.0}),
        *((item.cycles, moving) for item in objects),
    ]


def set_up_time(scene, raw: BlenderCamera, camera: Camera) -> list[str]:
    """Set Cycles' rolling shutter to the times of a camera's rows; return lines on the changes.

    A slit scan shows the same frames whatever the current frame is, but Cycles' shutter opens at the current frame. The
    scene is therefore set to the frame at which the slit scan begins.
    """
    if camera.pixel_time is None:
        return []
    for owner, values in blur_settings(scene, raw, camera, scene.objects):
        for name, value in values.items():
            setattr(owner, name, value)
    if is_shutter(raw):
        return ["Motion Blur was enabled, with Cycles' Rolling Shutter from top to bottom"]
    begin, frames = shutter_of(camera.pixel_time, camera.raster)
    go_to(scene, begin)
    return [
        f"The slit scan is Cycles' Rolling Shutter, open for {frames:g} frames from frame {begin:g} on, where the "
        "scene is now: at other frames, Cycles shows other times",
        "Motion Blur was enabled, and the Motion Steps of all objects were set to 7",
    ]
