"""A real lens in the 3D View: its glass, stop, pupils and film in their place, and the rays of Step Through in them."""

from collections.abc import Iterator

import gpu
import numpy as np

from ...core.camera.camera import Camera
from ...core.cameras.real_lens import RealLens
from ...core.lesson.diagram import segments_of
from ...core.lesson.lens_diagram import chief_path, fan_of, lens_drawing
from ...core.lesson.lesson import Lesson
from ..read.scene_cache import cached_scene
from ..read.view import camera_frame
from .overlay import batch_of, draw_batch

CHIEF, FAN, STOPPED = (1.0, 0.45, 0.1, 1.0), (1.0, 0.8, 0.3, 0.6), (0.7, 0.25, 0.2, 0.6)
STYLES = {
    "glass": ((0.55, 0.8, 1.0, 0.6), 1.0),
    "pupils": ((0.45, 0.9, 0.6, 0.8), 1.0),
    "stop": ((0.95, 0.95, 0.95, 0.9), 2.0),
    "film": ((0.95, 0.95, 0.95, 0.9), 2.0),
}
"""Color and line width, in pixels at interface scale 1, of the parts of a lens."""

_drawn: list[tuple[Camera, dict]] = []
"""The camera of the latest drawing, and its batches."""


def parts_of_paths(camera: Camera, steps: Lesson) -> Iterator[tuple[str, np.ndarray, tuple, float]]:
    """Yield (kind of shader, points, color, width) of a pixel's chief ray and fan from the film through a real lens;
    rays that pass go on to where the chief ray ends.
    """
    if not isinstance(camera.model, RealLens):
        return
    x, y = (coordinate + 0.5 for coordinate in steps.seen.pixel)
    for path, color, width in (*((path, FAN, 1.0) for path in fan_of(camera.model, x, y)),
                               (chief_path(camera.model, x, y), CHIEF, 2.5)):  # fmt: skip
        points = path.points
        if path.direction is None:
            color = STOPPED
        elif np.isfinite(steps.seen.distance):
            points = np.concatenate((points, [points[-1] + steps.seen.distance * path.direction]))
        yield "POLYLINE", segments_of(in_world(camera, points)[None]), color, width


def in_world(camera: Camera, points: np.ndarray) -> np.ndarray:
    """Return points (..., 3) of the camera's frame in the world."""
    return points @ camera.pose.basis.T + camera.pose.eye


def draw_lens(context, in_steps: bool) -> None:
    """Draw the real lens of the active camera in space, if steps of a pixel or the overlay's frustum are shown."""
    overlay = context.scene.camera_ray_caster_overlay
    if not (in_steps or (overlay.show and overlay.show_frustum)) or not context.space_data.overlay.show_overlays:
        return
    camera = cached_scene(context).camera
    if camera is None or not isinstance(camera.model, RealLens) or camera_frame(context) is not None:
        return
    if not _drawn or _drawn[0][0] is not camera:
        lens = lens_drawing(camera.model)
        batches = {name: batch_of("POLYLINE", in_world(camera, getattr(lens, name))) for name in STYLES}
        _drawn[:] = [(camera, batches)]
    scale = context.preferences.system.ui_scale
    gpu.state.blend_set("ALPHA")
    for name, (color, width) in STYLES.items():
        draw_batch(_drawn[0][1][name], "POLYLINE", color, width * scale)
    gpu.state.blend_set("NONE")


def forget_lens() -> None:
    """Forget the drawing: another file is loaded."""
    _drawn.clear()
