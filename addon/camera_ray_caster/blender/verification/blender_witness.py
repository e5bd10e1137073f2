"""Blender's own answers on where the pixels of a perspective or orthographic camera look, as plain arrays."""

from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import bpy  # noqa: F401 (it brings the two below)
import numpy as np
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Vector

TYPES = ("PERSP", "ORTHO")
"""Camera types that Blender answers for. For any other it describes the perspective camera with the same lens."""

SMALLEST, LARGEST = 4, 65536
"""Range of the properties resolution_x and resolution_y; with a percentage, frames can lie outside of it."""


@dataclass(frozen=True)
class Witness:
    """Blender's answers for one evaluated camera at the effective raster, float32 widened to float64."""

    size: tuple[int, int]
    """Width and height of the full frame in pixels."""
    matrix_world: np.ndarray
    """World matrix of the evaluated object, (4, 4)."""
    frame: np.ndarray
    """Camera.view_frame, (4, 3): top right, bottom right, bottom left, top left, in the camera's frame."""
    matrix: np.ndarray
    """Object.calc_matrix_camera, (4, 4): from camera coordinates to clip coordinates."""
    camera: Any
    depsgraph: Any

    def view_coordinates(self, points: np.ndarray) -> np.ndarray:
        """Return world_to_camera_view of world points, (n, 3) each; NaN where it fails. Points are rounded to float32.
        """
        with _frame_of(self.size, self.depsgraph.scene_eval) as scene:
            return _widened([_seen(scene, self.camera, Vector(point)) for point in points]).reshape(-1, 3)


def ask(camera_object, depsgraph) -> Witness | None:
    """Return Blender's answers for a camera as the depsgraph evaluated it.

    Return None if Blender has no answers: for types not in TYPES, and for frames with a side larger than LARGEST.
    """
    camera = camera_object.evaluated_get(depsgraph)
    render = depsgraph.scene_eval.render
    size = tuple(
        getattr(render, name) * render.resolution_percentage // 100 for name in ("resolution_x", "resolution_y")
    )
    if camera.data.type not in TYPES or max(size) * _enlarged(size) > LARGEST:
        return None
    with _frame_of(size, depsgraph.scene_eval) as scene:
        frame = camera.data.view_frame(scene=scene)
    matrix = camera.calc_matrix_camera(
        depsgraph, x=size[0], y=size[1], scale_x=render.pixel_aspect_x, scale_y=render.pixel_aspect_y
    )
    return Witness(size, _widened(camera.matrix_world), _widened(frame), _widened(matrix), camera, depsgraph)


def _seen(scene, camera, point):
    try:
        return world_to_camera_view(scene, camera, point)
    except (ValueError, ZeroDivisionError):  # a matrix that float32 cannot invert, a frame without size
        return np.full(3, np.nan)


def _widened(answer) -> np.ndarray:
    return np.array(answer, dtype=np.float64)


def _enlarged(size) -> int:
    """Return the factor that enlarges a frame to a valid size: a power of two, which changes no bit of the answer."""
    return SMALLEST if min(size) < SMALLEST else 1


@contextmanager
def _frame_of(size, scene):
    """Yield the evaluated scene with the rendered frame's aspect, since view_frame ignores the percentage.

    Only the depsgraph's own copy of the scene is changed, and restored afterwards; the user's scene is not touched.
    It is changed only for another aspect: that tags the copy of the camera, and Blender before 5.2 crashes at another
    frame then, if the visibility of an object has keys.
    """
    render = scene.render
    before, meant = (render.resolution_x, render.resolution_y), tuple(side * _enlarged(size) for side in size)
    if meant[0] * before[1] == meant[1] * before[0]:
        yield scene
        return
    render.resolution_x, render.resolution_y = meant
    try:
        yield scene
    finally:
        render.resolution_x, render.resolution_y = before
