"""Reading of a scene's camera and shapes as plain records. The scene is restored afterwards."""

from collections.abc import Callable
from contextlib import contextmanager
from dataclasses import replace
from functools import partial, wraps
from numbers import Real
from typing import Any

import bpy

from ...core.arguments import P, R, deprecated, keywords, number, shown, word, words
from ...core.camera.camera import Camera
from ...core.camera.pixel_time import LAST_FRAME
from ...core.camera.stereo import eye_record
from ...core.casting.pass_needs import frames_of
from ...core.casting.passes import PASSES
from ...core.records import InputError, Shapes
from ...core.scene import Scene
from .camera_fields import check_camera, eye_object, has_pixel_times, is_removed
from .depsgraph_shapes import shapes_record
from .evaluated import camera_at, scene_at
from .frames import frame_of, go_to, layer_of
from .motion import motion_of, with_other_frames
from .physics import prepare


def _frame_came_second(function: Callable[P, R]) -> Callable[P, R]:
    """Let a function take its arguments by position as they were before version 0.3, with a DeprecationWarning."""

    @wraps(function)
    def call(*args: P.args, **keywords: P.kwargs) -> R:
        by_name: Any = function
        others = args[1:]
        if not others or (len(others) == 1 and not isinstance(others[0], Real)):
            return function(*args, **keywords)
        first = ("frame", "camera_object") if isinstance(others[0], Real | None) else ("camera_object", "frame")
        old = dict(zip((*first, "view", "passes"), others, strict=False))
        deprecated(f"{function.__name__} takes all but the scene and the camera as keywords: frame=..., view=...")
        return by_name(args[0], **old, **keywords)

    return call


@_frame_came_second
def read_scene(scene, camera_object=None, *, frame=None, view="", passes=()) -> Scene:
    """Return camera and shapes in one reading, as one record that ``cast`` takes: ``cast(scene, passes=...)``.

    Camera and shapes are those of ``read_camera`` and ``read_shapes`` for the same arguments. ``next`` and ``previous``
    are the scenes of those neighboring frames that flow among ``passes`` needs, else None. Raises the errors of
    ``read_camera``, and InputError for an unknown pass, and for physics that are not baked if other frames than the
    current one are needed.
    """
    passes = words(passes, "passes", PASSES)
    with evaluated_camera(scene, camera_object, frame, view, bool(frames_of(passes)), True) as (active, depsgraph):
        return _with_motion(scene, active, depsgraph, view, passes)


@keywords
def read_camera(scene, camera_object=None, *, frame=None, view="") -> Camera:
    """Return the scene's camera as evaluated, with parents, constraints, drivers, animation and timeline markers.

    ``camera_object``: default the scene's active camera at that frame. ``frame``: default the current frame; its
    fraction is the subframe. ``view``: "" for the camera itself, else the name of a multi-view eye, such as "left" or
    "right".
    If pixels have their own times, the scene is also evaluated at other times, and the camera has its motion. Raises
    InputError if there is no camera or no model for it, and for invalid parameters.
    """
    with evaluated_camera(scene, camera_object, frame, view) as (active, depsgraph):
        eye = partial(eye_record, view=view)
        _, camera = camera_at(active, depsgraph, eye)
        read = partial(scene_at, eye=eye, has_colors=False)
        motion = motion_of(camera, depsgraph, active, partial(go_to, scene), read)
        return replace(camera, motion=motion)


@_frame_came_second
def read_shapes(scene, camera_object=None, *, frame=None, view="") -> Shapes:
    """Return the scene's shapes as evaluated, in the world, and the names of objects that cannot be cast.

    The arguments are as in ``read_camera``. The camera matters only if its pixels have their own times: the shapes then
    have their motion, and InputError is raised for a camera that cannot be cast.
    InputError is raised, too, for another frame than the current one if physics are not baked.
    Outside a render, Blender evaluates the objects that the viewport shows, with the viewport's modifier and particle
    settings. Objects that only a render shows are named in ``left_out``.
    """
    with evaluated_camera(scene, camera_object, frame, view, moves=True) as (active, depsgraph):
        if has_pixel_times(active, depsgraph):
            return _with_motion(scene, active, depsgraph, view).shapes
        return shapes_record(depsgraph)


def _with_motion(scene, camera_object, depsgraph, view: str, passes=()) -> Scene:
    eye, frame = partial(eye_record, view=view), frame_of(depsgraph.scene_eval)
    read = partial(scene_at, eye=eye)
    record = read(camera_object, depsgraph)
    return with_other_frames(record, depsgraph, camera_object, frame, passes, partial(go_to, scene), read)


_readings: list[bool] = []
"""One entry during a reading: the evaluation calls handlers, which may start a reading, too."""


@contextmanager
def evaluated_camera(scene, camera_object=None, frame=None, view="", goes_on=False, moves=False):
    """Yield the camera object that ``read_camera`` reads for these arguments, and the depsgraph that evaluates it.

    If a handler calls this during another reading, the scene is read in its current evaluation. InputError is raised if
    that is not sufficient: for another frame, another camera or a view, for pixel times, and if the reading ``goes_on``
    to other frames; and, if what ``moves`` is read, for another frame of physics that are not baked.
    """
    _check_scene(scene)
    frame = None if frame is None else number(frame, "frame", LAST_FRAME)
    view = word(view, "view")
    if camera_object is not None:
        check_camera(scene, camera_object)
    if _readings:
        depsgraph = layer_of(scene).depsgraph
        active = scene.camera if camera_object is None else camera_object
        elsewhere = frame is not None or goes_on or view or active != scene.camera
        if elsewhere or has_pixel_times(active, depsgraph):
            raise InputError(
                "a handler reads a camera while another reading evaluates the scene: "
                "read the active camera at the current frame there, or read it later, in a timer"
            )
        yield active, depsgraph
        return
    _readings.append(True)
    try:
        with (
            evaluated(scene, frame, camera_object, moves),
            evaluated(scene, None, eye_object(scene, view)) as depsgraph,
        ):
            yield scene.camera, depsgraph
    finally:
        _readings.clear()


@contextmanager
def evaluated(scene, frame=None, camera_object=None, moves=False):
    """Yield the scene's depsgraph at a frame with a camera active; restore frame and camera afterwards.

    ``moves``: refuse another frame of physics that are not baked; see ``physics.prepare``. Raises InputError if a
    handler, which Blender calls at each frame, removes the camera or what else is read.
    """
    layer = layer_of(scene)
    before = scene.frame_current, scene.frame_subframe, scene.camera
    try:
        if frame is not None:
            if moves and frame != frame_of(scene):
                layer.update()  # a scene may have no depsgraph yet
                prepare(layer.depsgraph, (frame,))
            go_to(scene, frame)
        if camera_object is not None and camera_object != scene.camera:
            scene.camera = camera_object  # a hidden camera is evaluated only while it is active,
            scene.frame_current = scene.frame_current  # and animated only when the frame is set
        layer.update()
        yield layer.depsgraph
    except ReferenceError as error:
        raise InputError(
            "a handler or another script removed what is read from the file: let it do so before or after a reading"
        ) from error
    finally:
        if (scene.frame_current, scene.frame_subframe) != before[:2]:
            scene.frame_set(before[0], subframe=before[1])
        if scene.camera != before[2] and (before[2] is None or not is_removed(before[2])):
            scene.camera = before[2]  # also if a timeline marker has bound another camera
            layer.update()


def _check_scene(scene) -> None:
    if not isinstance(scene, bpy.types.Scene):
        raise InputError(f"{shown(scene)} is not a scene: give a scene such as bpy.context.scene")
    if is_removed(scene):
        raise InputError("the scene has been removed from the file: give an existing scene")
