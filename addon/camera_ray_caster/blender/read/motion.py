"""A scene at the times of a picture whose pixels have each their own: evaluated as often as its motion asks for."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ...core.camera.build import camera_from
from ...core.camera.camera import Camera
from ...core.motion.evaluations import measure, resolve
from ...core.records import Shapes
from ..terminal.signals import heed
from .camera import camera_record
from .shapes import shapes_record

CHECKS = 4
"""Frames at which the interpolation is held against the scene itself, beside those that resolved it."""


def with_motion(
    camera: Camera, shapes: Shapes, camera_object, go_to: Callable, eye: Callable
) -> tuple[Camera, Shapes]:
    """Return camera and shapes that know their motion over the camera's clock; without a clock as they are.

    ``go_to(frame)`` evaluates the scene at a frame and returns its depsgraph; the frame is not put back. ``eye(raw)``
    is the record of the eye that the camera is, of the record of its object.
    """
    pixel_time = camera.pixel_time
    if pixel_time is None:
        return camera, shapes

    def evaluate(frame: float) -> tuple[Camera, Shapes]:
        depsgraph = go_to(frame)
        heed()
        raw = eye(camera_record(depsgraph.scene_eval, camera_object, depsgraph))
        return replace(camera_from(raw), pixel_time=pixel_time), shapes_record(depsgraph)

    motion = resolve(evaluate, pixel_time.first, pixel_time.last, pixel_time.tolerance, pixel_time.most)
    places = np.random.default_rng(0).uniform(pixel_time.first, pixel_time.last, CHECKS)
    motion = replace(motion, measured=measure(motion, evaluate, places))
    return replace(camera, motion=motion), replace(shapes, motion=motion)
