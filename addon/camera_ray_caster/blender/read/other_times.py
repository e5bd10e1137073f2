"""The motion of a window's scene over the times of its camera's pixels, for Rendered shading.

Frames are evaluated while nothing changes: those with keyframes first, then those that the tolerance needs. Each is
evaluated once, and kept until Blender reports a change or no view shows the camera's picture.
"""

from collections.abc import Generator, Iterator
from dataclasses import dataclass, field, replace
from time import perf_counter

import bpy
from bpy.app.handlers import persistent

from ...core.motion.evaluations import Motion, resolving
from ...core.motion.interpolation import State
from ...core.motion.unfinished import linear
from ...core.records import InputError
from ..properties.setting_labels import in_labels
from .camera_fields import has_pixel_times
from .copied import copied
from .evaluated import camera_at, scene_at
from .frames import frame_of
from .motion import keyed_frames
from .physics import prepare
from .view import shows_cast, views_3d

PERIOD, SHORT, SETTLED = 0.2, 0.03, 0.3
"""Seconds between two looks, between two readings, and without a change before the first one."""
BUDGET = 0.2
"""Seconds after which the window is drawn before further frames are evaluated, once the first ones are known. Of a room
of 1,000 objects the first frame takes 0.45 s, and each further one 0.2 s.
"""
MOST_KEYFRAMES = 4
"""Maximum number of frames with keyframes before the first picture."""
STEADY = {"OBJECT", "POSE"}
"""Modes of the active object in which the scene can be copied."""


@dataclass
class OtherTimes:
    """What is known of a scene at other frames."""

    owners: tuple = ()
    """Pointers of the scene, its view layer and its camera."""
    states: dict[float, State] = field(default_factory=dict)
    times: tuple = ()
    """The first and the last time that the motion is for, its tolerance, and the maximum number of evaluations."""
    steps: Generator[float, State | None, Motion] | None = None
    """The frames that are still to be evaluated; None before the first one."""
    wanted: float = 0.0
    """The frame that is to be evaluated next."""
    motion: Motion | None = None
    is_done: bool = False
    """Whether the motion is that of a render."""
    reason: str = ""
    """Why no motion can be read."""


_known = OtherTimes()
_changed = [0.0]
"""When the scene changed last."""


def known(scene, layer) -> OtherTimes:
    """Return what is known of a scene, and have it read on: called while a 3D View draws the camera's picture."""
    if scene.camera is None or not has_pixel_times(scene.camera, layer.depsgraph):
        return OtherTimes(is_done=True)
    if not bpy.app.timers.is_registered(read_on):
        bpy.app.timers.register(read_on, first_interval=SETTLED)
    return _known if _known.owners == _owners(scene, layer) else OtherTimes()


def sentences(scene, layer) -> Iterator[str]:
    """Yield what differs in a 3D View from a render of a camera whose pixels have their own times."""
    times, now = known(scene, layer), f"frame {frame_of(scene):g}"
    if times.reason:
        yield f"Every pixel is shown at {now}: {times.reason}"
    elif not times.is_done:
        so_far = f"{len(times.states)} frames" if times.motion else now
        yield f"Each pixel has its own time: it is shown from {so_far} so far; more follow while nothing changes"


def read_on() -> float | None:
    """Evaluate further frames if nothing changes; called by a timer while a view shows the camera's picture."""
    window = next((window for window, area in views_3d() if shows_cast(area.spaces.active, window.scene)), None)
    if window is None:
        forget()
        return None
    active, is_playing = window.view_layer.objects.active, window.screen.is_animation_playing
    is_steady = active is None or active.mode in STEADY
    settled = perf_counter() - _changed[0] > SETTLED
    if settled and is_steady and not is_playing and not bpy.app.is_job_running("RENDER"):
        motion, reason = _known.motion, _known.reason
        _read(window)
        if _known.motion is not motion or _known.reason != reason:
            for _, area in views_3d():
                area.tag_redraw()
        return PERIOD if _known.is_done or _known.reason else SHORT
    return PERIOD


def _read(window) -> None:
    """Read the motion of a window's scene as far as the budget allows, unless it is known."""
    scene, layer = window.scene, window.view_layer
    owners = _owners(scene, layer)
    if _known.owners != owners:
        forget()
        _known.owners = owners
    if _known.reason:
        return
    try:
        time = camera_at(scene.camera, layer.depsgraph)[1].pixel_time
        if time is None:
            _known.is_done = True
            return
        times = time.first, time.last, time.tolerance, time.max_evaluations
        if times != _known.times:
            _known.times, _known.steps, _known.motion, _known.is_done = times, None, None, False
        if not _known.is_done:
            with copied(window) as copy:
                _evaluate(copy, layer.name, time)
    except InputError as error:
        _known.motion, _known.reason = None, in_labels(str(error))


def _evaluate(copy, layer: str, time) -> None:
    """Evaluate frames of a scene's copy until the budget is used up, or the motion is that of a render."""
    states, view_layer, span = _known.states, copy.view_layers[layer], (time.first, time.last)
    copy.frame_set(copy.frame_current)  # after its update() animation would also change the scene's own objects

    def state_at(frame: float) -> State:
        if frame not in states:
            copy.frame_set(int(frame // 1), subframe=frame % 1)
            there = scene_at(copy.camera, view_layer.depsgraph)
            states[frame] = there.camera, there.shapes
        camera, shapes = states[frame]
        return replace(camera, pixel_time=time), shapes

    if _known.steps is None:
        prepare(view_layer.depsgraph, span)
        keys = keyed_frames(copy)
        first_ones = dict.fromkeys((*span, *keys[(keys > span[0]) & (keys < span[1])].tolist()[:MOST_KEYFRAMES]))
        for frame in first_ones:
            state_at(frame)
        _known.steps = resolving(*span, time.tolerance, time.max_evaluations, keys)
        _known.wanted = next(_known.steps)
    end = perf_counter() + BUDGET
    try:
        while perf_counter() < end:
            _known.wanted = _known.steps.send(state_at(_known.wanted))
    except StopIteration as finished:
        _known.motion, _known.is_done = finished.value, True
    else:
        near = [frame for frame in sorted(states) if span[0] <= frame <= span[1]]
        if _known.motion is None or len(near) >= 2 * len(_known.motion.states):  # else the picture would begin anew
            _known.motion = linear({frame: state_at(frame) for frame in near}, time.tolerance)


def _owners(scene, layer) -> tuple:
    return scene.as_pointer(), layer.as_pointer(), scene.camera and scene.camera.as_pointer()


@persistent
def changed(*_) -> None:
    """Forget all frames: something has changed."""
    forget()
    _changed[0] = perf_counter()


def forget() -> None:
    """Forget all frames."""
    _known.__init__()


def stop() -> None:
    """Forget all frames, and end the timer."""
    forget()
    if bpy.app.timers.is_registered(read_on):
        bpy.app.timers.unregister(read_on)


def register(undo) -> None:
    undo.callback(stop)
    undo.add_handlers(changed, "depsgraph_update_post", "undo_post", "redo_post", "load_pre")
