"""Blender in, plain records out. The scene is as it was afterwards."""

import math
from contextlib import contextmanager
from dataclasses import replace
from functools import partial

import bpy

from ...core.arguments import number, shown, word, words
from ...core.camera.camera import Camera
from ...core.camera.pixel_time import LAST_FRAME
from ...core.camera.stereo import eye_record
from ...core.casting.flow import frames_of
from ...core.casting.passes import PASSES
from ...core.records import InputError, Shapes
from .camera import check_camera, eye_object, has_pixel_times, is_removed
from .evaluated import SceneRecord, camera_at, scene_at
from .motion import motion_of, with_other_frames
from .shapes import shapes_record


def read_scene(scene, frame=None, camera_object=None, view="", passes=()) -> SceneRecord:
    """Return camera and shapes, and the record that the camera was made of: what ``read_camera`` and ``read_shapes``
    return for the same arguments, read once. Where ``passes`` have names of flow, ``camera.next``, ``shapes.next`` and
    ``previous`` are those of the neighbors of the frame that these passes look into. Raises what they raise, and
    InputError for an unknown pass.
    """
    passes = words(passes, "passes", PASSES)
    with evaluated_camera(scene, camera_object, frame, view, bool(frames_of(passes))) as (active, depsgraph):
        return _with_motion(scene, active, depsgraph, view, passes)


def read_camera(scene, camera_object=None, frame=None, view="") -> Camera:
    """Return the scene's camera as it is evaluated: parents, constraints, drivers, animation, timeline markers.

    ``camera_object``: default the scene's active camera at that frame. ``frame``: default the current one; its
    fraction is the subframe. ``view``: "" for the camera itself, else the name of a multi-view eye, "left" or "right".
    A camera whose pixels have each their own time comes with its motion: the scene is evaluated for it.
    Raises InputError where there is no camera, for what no model here can do, and for parameters without meaning.
    """
    with evaluated_camera(scene, camera_object, frame, view) as (active, depsgraph):
        eye = partial(eye_record, view=view)
        _, camera = camera_at(active, depsgraph, eye)
        return replace(camera, motion=motion_of(camera, active, partial(go_to, scene), eye))


def read_shapes(scene, frame=None, camera_object=None, view="") -> Shapes:
    """Return the scene's shapes as they are evaluated, in the world, and the names of what cannot be cast.

    The arguments are as in ``read_camera``. The camera counts only where its pixels have each their own time: the
    shapes then come with their motion, and InputError is raised for a camera that cannot be cast.
    Outside a render Blender has evaluated what the viewport shows, with the viewport's modifier and particle settings;
    what only a render shows is named among ``left_out``.
    """
    with evaluated_camera(scene, camera_object, frame, view) as (active, depsgraph):
        if has_pixel_times(active, depsgraph):
            return _with_motion(scene, active, depsgraph, view).shapes
        return shapes_record(depsgraph)


def _with_motion(scene, camera_object, depsgraph, view: str, passes=()) -> SceneRecord:
    eye, frame = partial(eye_record, view=view), depsgraph.scene_eval.frame_current_final
    found = scene_at(camera_object, depsgraph, eye)
    return with_other_frames(found, camera_object, frame, passes, partial(go_to, scene), eye)


_readings: list[bool] = []
"""One for the reading that is under way: what it evaluates calls handlers, which may read, too."""


@contextmanager
def evaluated_camera(scene, camera_object=None, frame=None, view="", goes_on=False):
    """Yield the camera object that ``read_camera`` reads for these arguments, and the depsgraph that evaluates it.

    Within another reading, in a handler that this one calls, the scene is read as it is evaluated then. Raises
    InputError where that would not do: for another frame, another camera or a view, for pixel times, and where the
    reading ``goes_on`` to other frames.
    """
    _check_scene(scene)
    frame = None if frame is None else number(frame, "frame", LAST_FRAME)
    view = word(view, "view")
    if camera_object is not None:
        check_camera(scene, camera_object)
    if _readings:
        depsgraph = _layer(scene).depsgraph
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
        with evaluated(scene, frame, camera_object), evaluated(scene, None, eye_object(scene, view)) as depsgraph:
            yield scene.camera, depsgraph
    finally:
        _readings.clear()


@contextmanager
def evaluated(scene, frame=None, camera_object=None):
    """Yield the scene's depsgraph at a frame with a camera active, and put frame and camera back in the end."""
    layer = _layer(scene)
    before = scene.frame_current, scene.frame_subframe, scene.camera
    try:
        if frame is not None:
            go_to(scene, frame)
        if camera_object is not None and camera_object != scene.camera:
            scene.camera = camera_object  # a camera that is hidden is evaluated only while it is the active one,
            scene.frame_current = scene.frame_current  # and animated only when the time is told to it
        layer.update()
        yield layer.depsgraph
    finally:
        if (scene.frame_current, scene.frame_subframe) != before[:2]:
            scene.frame_set(before[0], subframe=before[1])
        if scene.camera != before[2]:
            scene.camera = before[2]  # also where a timeline marker has bound another one
            layer.update()


def go_to(scene, frame: float):
    """Set a scene to a frame, its fraction the subframe, and return the depsgraph evaluated there."""
    scene.frame_set(math.floor(frame), subframe=frame - math.floor(frame))
    return _layer(scene).depsgraph


def _check_scene(scene) -> None:
    if not isinstance(scene, bpy.types.Scene):
        raise InputError(f"{shown(scene)} is no scene: give one, such as bpy.context.scene")
    if is_removed(scene):
        raise InputError("the scene has been removed from the file: give one that is there")


def _layer(scene):
    return bpy.context.view_layer if scene == bpy.context.scene else scene.view_layers[0]
