"""The points that the active camera's rays hit, drawn in the 3D View; of a scanner, those swept so far by choice."""

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader
from mathutils import Matrix

from ...core.camera.camera import Camera
from ...core.clouds.cloud import PointCloud, scan
from ...core.clouds.colors import colors_of
from ...core.records import InputError
from ..read.frames import frame_of
from ..read.scene_cache import CachedScene, cached_scene
from .shown import picture_frame

WIDTH = 3.0
"""Size of a point in pixels at interface scale 1."""
CLOSER = 0.003
"""Fraction of their distance by which points are drawn closer: otherwise half of the square of three pixels would be
inside a surface that is seen at an angle.
"""
MOST_RAYS = 1 << 20
"""Largest number of points that are drawn."""

_drawn: list[tuple] = []
"""The latest points, as (scene, points), and as (inputs, batch)."""


def draw() -> None:
    """Draw the points in space; called by Blender for each 3D View. A view through the camera shows its picture."""
    context = bpy.context
    settings, scene = context.scene.camera_ray_caster_overlay, None
    if settings.show and settings.show_points and context.space_data.overlay.show_overlays:
        scene = cached_scene(context)
    if scene is None or scene.camera is None or picture_frame(context) is not None:
        return
    batch = _batch(scene, settings.points_by, swept(context.scene, scene.camera) if settings.show_sweep else None)
    if batch is not None:
        gpu.state.depth_test_set("LESS_EQUAL")
        gpu.state.point_size_set(WIDTH * context.preferences.system.ui_scale)
        shader = gpu.shader.from_builtin("POINT_FLAT_COLOR")
        shader.bind()
        with gpu.matrix.push_pop():
            gpu.matrix.load_matrix(_closer(context.region_data) @ gpu.matrix.get_model_view_matrix())
            batch.draw(shader)
        gpu.state.depth_test_set("NONE")


def _closer(region) -> Matrix:
    """Return the matrix that moves what a view sees towards it; no point changes its place in the window."""
    if region.is_perspective:
        return Matrix.Scale(1 - CLOSER, 4)
    return Matrix.Translation((0.0, 0.0, CLOSER * region.view_distance))


def swept(scene, camera: Camera) -> float | None:
    """Return the seconds of the sweep that have passed at the scene's frame, if sweeps follow each other from its first
    frame on; None for a camera that does not sweep.
    """
    firing = camera.model.firing
    if firing is None:
        return None
    length = firing.per_column * camera.raster.width
    passed = (frame_of(scene) - scene.frame_start + 1) * scene.render.fps_base / scene.render.fps % length
    return passed if passed > firing.per_column else length  # a sweep that has just ended is shown whole


def points_by_now(cloud: PointCloud, camera: Camera, seconds: float | None) -> np.ndarray:
    """Return which points of a cloud are measured within so many seconds of the sweep, (n,) bool; all for None."""
    firing = camera.model.firing
    if seconds is None or firing is None:
        return np.ones(len(cloud), bool)
    return firing.per_column * cloud.column + firing.rows[camera.raster.y0 + cloud.row] <= seconds


def _batch(scene: CachedScene, by: str, seconds: float | None):
    """Return the batch of the points, None without any; make it again after a change."""
    camera = scene.camera
    if camera is None or camera.raster.width * camera.raster.height > MOST_RAYS:
        return None
    if not _drawn or _drawn[0][0] is not scene:
        try:
            _drawn[:] = [(scene, scan(camera, scene.shapes)), ((), None)]
        except InputError:  # the sidebar says why
            _drawn[:] = [(scene, None), ((), None)]
    cloud = _drawn[0][1]
    if cloud is not None and _drawn[1][0] != (by, seconds):
        is_seen = points_by_now(cloud, camera, seconds)
        content = {"pos": cloud.world[is_seen].astype(np.float32), "color": colors_of(cloud, by)[is_seen]}
        shader = gpu.shader.from_builtin("POINT_FLAT_COLOR")
        _drawn[1] = (by, seconds), batch_for_shader(shader, "POINTS", content) if is_seen.any() else None
    return _drawn[1][1]


def register(undo) -> None:
    undo.callback(_drawn.clear)
    undo.add_drawing(bpy.types.SpaceView3D, draw, "POST_VIEW")
