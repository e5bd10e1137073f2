"""Frames: what every frame number here means, and the evaluation of a scene at a frame.

A frame is a place on the timeline: Blender's current frame, plus its subframe as a fraction. Time Stretching changes
the time at which Blender evaluates actions and physics for a frame, but not the number of the frame. Blender's own
``frame_current_final`` is that time: setting it as a frame would stretch it twice.
"""

import math

import bpy

from ...core.records import InputError


def frame_of(scene) -> float:
    """Return the current frame of a scene, original or evaluated, with its subframe."""
    return float(scene.frame_current + scene.frame_subframe)


def go_to(scene, frame: float):
    """Set a scene to a frame, and return the depsgraph evaluated there."""
    scene.frame_set(math.floor(frame), subframe=frame - math.floor(frame))
    return layer_of(scene).depsgraph


def action_time(scene, frame: float = 1.0) -> float:
    """Return the time at which Blender evaluates actions and physics for a frame."""
    return frame * scene.render.frame_map_old / scene.render.frame_map_new


def frame_rate(scene) -> float:
    """Return the frames of a second; a damaged file may have the base 0, which counts as 1."""
    return scene.render.fps / (scene.render.fps_base or 1.0)


def layer_of(scene):
    """Return the view layer in which a scene is read: the window's, or the first of another scene."""
    return bpy.context.view_layer if scene == bpy.context.scene else scene.view_layers[0]


def check_layers(scene) -> None:
    """Raise InputError if no view layer is enabled for rendering."""
    if not any(layer.use for layer in scene.view_layers):
        raise InputError(f"no view layer of scene {scene.name!r} is used for rendering: enable one")
