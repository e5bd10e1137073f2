"""Other frames of a scene: the frames that pixels with their own times need, and the neighboring frames for flow."""

from collections.abc import Callable, Collection
from dataclasses import replace

import bpy
import numpy as np

from ...core.camera.camera import Camera
from ...core.casting.flow import NEXT, PREVIOUS
from ...core.casting.pass_needs import frames_of
from ...core.motion.evaluations import Motion, measured, resolve
from ...core.records import Shapes
from ...core.scene import Scene
from ..process.signals import raise_if_stopping
from .evaluated import Read
from .frames import action_time
from .physics import prepare

CHECKS = 4
"""Number of frames at which the interpolation is compared with the scene, in addition to those that resolved it."""

NEIGHBOR_STEPS = {NEXT: 1.0, PREVIOUS: -1.0}
"""Steps from the frame that is read to its neighbors, in frames."""


def with_other_frames(
    scene: Scene,
    depsgraph,
    camera_object,
    frame: float,
    passes: Collection[str],
    visit: Callable,
    read: Read,
) -> Scene:
    """Return the record of a scene with its motion, and with its next and previous frame if passes need them.

    The motion is None unless pixels have their own times. All frames are of the same camera object. See ``motion_of``
    for ``visit`` and ``read``.
    """
    neighbors = {name: frame + NEIGHBOR_STEPS[name] for name in frames_of(passes)}
    if neighbors:
        prepare(depsgraph, neighbors.values())
    motion = motion_of(scene.camera, depsgraph, camera_object, visit, read)
    others = {}
    for name, other in neighbors.items():
        there = read(camera_object, visit(other))
        others[name] = there.with_timeline(motion_of(there.camera, depsgraph, camera_object, visit, read))
    return scene.with_timeline(motion, **others)


def motion_of(camera: Camera, depsgraph, camera_object, visit: Callable, read: Read) -> Motion | None:
    """Return the motion of a camera and its scene over the times of its pixels; None if all pixels have the same time.

    ``visit(frame)`` evaluates the scene at a frame and returns its depsgraph, which ``read`` reads. The frame is not
    restored.
    """
    pixel_time = camera.pixel_time
    if pixel_time is None:
        return None

    def evaluate(frame: float) -> tuple[Camera, Shapes]:
        depsgraph = visit(frame)
        raise_if_stopping()
        scene = read(camera_object, depsgraph)
        return replace(scene.camera, pixel_time=pixel_time), scene.shapes

    first, last = pixel_time.first, pixel_time.last
    prepare(depsgraph, (first, last))
    keys = keyed_frames(depsgraph.scene)
    motion = resolve(evaluate, first, last, pixel_time.tolerance, pixel_time.max_evaluations, keys)
    return measured(motion, evaluate, np.random.default_rng(0).uniform(first, last, CHECKS))


def keyed_frames(scene) -> np.ndarray:
    """Return the frames of a scene at which some property of the file has a key; an action is read as it is, also if an
    NLA strip moves it.
    """
    keys = [np.zeros(0, np.float32)]
    for action in bpy.data.actions:
        bags = [bag for layer in action.layers for strip in layer.strips for bag in strip.channelbags]
        for curve in (curve for bag in bags for curve in bag.fcurves):
            places = np.empty(2 * len(curve.keyframe_points), np.float32)
            curve.keyframe_points.foreach_get("co", places)
            keys.append(places[::2])
    return np.unique(np.concatenate(keys)) / action_time(scene)
