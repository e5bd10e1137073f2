"""The motion of a scene whose pixels have each their own time: it is evaluated as often as the motion asks for."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ...core.camera.camera import Camera
from ...core.motion.evaluations import Motion, measure, resolve
from ...core.records import Shapes
from ..terminal.signals import raise_if_stopping
from .evaluated import Eye, scene_at

CHECKS = 4
"""Frames at which the interpolation is compared with the scene itself, beside those that resolved it."""


def motion_of(camera: Camera, camera_object, visit: Callable, eye: Eye | None = None) -> Motion | None:
    """Return the motion of a camera and its scene over the times of its pixels; None where they share one time.

    ``visit(frame)`` evaluates the scene at a frame and returns its depsgraph; the frame is not put back.
    """
    pixel_time = camera.pixel_time
    if pixel_time is None:
        return None

    def evaluate(frame: float) -> tuple[Camera, Shapes]:
        depsgraph = visit(frame)
        raise_if_stopping()
        found = scene_at(camera_object, depsgraph, eye)
        return replace(found.camera, pixel_time=pixel_time), found.shapes

    motion = resolve(evaluate, pixel_time.first, pixel_time.last, pixel_time.tolerance, pixel_time.most)
    frames = np.random.default_rng(0).uniform(pixel_time.first, pixel_time.last, CHECKS)
    return replace(motion, measured=measure(motion, evaluate, frames))
