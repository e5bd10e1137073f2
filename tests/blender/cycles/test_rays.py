"""Our rays are the rays that Blender renders: every pixel's primary ray, read out of Cycles."""

import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_camera
from camera_ray_caster.core.conventions import EPS32

from .cycles import cycles_directions, cycles_surface

DIRECTION = 32 * EPS32
"""Radians. Cycles takes a pixel through three float32 matrices (raster, camera, world; 5 operations each), normalizes
(5) and the witness stores it to 1 EPS32 of 2: the sum for components of at most 1, where the lens is not extreme."""

PORTRAIT = {"resolution_x": 20, "resolution_y": 32}
SHIFT = {"shift_x": 0.35, "shift_y": -0.6}
BORDER = {"use_border": True, "border_min_x": 0.2, "border_max_x": 0.7, "border_min_y": 0.1, "border_max_y": 0.45}
CAMERAS = {
    "landscape": {},
    "portrait": PORTRAIT,
    "portrait, horizontal fit": PORTRAIT | {"sensor_fit": "HORIZONTAL"},
    "landscape, vertical fit": {"sensor_fit": "VERTICAL", "sensor_height": 30.0},
    "shift": SHIFT,
    "portrait with shift": PORTRAIT | SHIFT,
    "vertical fit with shift": SHIFT | {"sensor_fit": "VERTICAL"},
    "wide pixels": {"pixel_aspect_x": 2.0},
    "high pixels that make a portrait": SHIFT | {"pixel_aspect_y": 1.9},
    "percentage": {"resolution_x": 101, "resolution_y": 67, "resolution_percentage": 33},
    "percentage in portrait with shift": SHIFT | {"resolution_x": 67, "resolution_y": 101, "resolution_percentage": 33},
    "border": BORDER | SHIFT,
    "border of a rounded product": {"use_border": True, "border_min_x": 0.7, "resolution_x": 10, "resolution_y": 10},
}
POSES = {
    "plain": ((1, 1, 1), (0, 0, 0)),
    "not uniform": ((2, 0.5, 3), (0, 0, 0)),
    "mirrored": ((-1, 1, 1), (0.5, 0, 0)),
    "upside down and backwards": ((1, -1, -1), (0, 0, 0)),
    "sheared": ((1, 2.5, 0.6), (0.4, 0.7, -0.3)),
}


def set_up(bpy, kind, settings, pose):
    scene = bpy.context.scene
    data = bpy.data.cameras.new("Camera")
    camera = bpy.data.objects.new("Camera", data)
    parent = bpy.data.objects.new("Parent", None)
    camera.parent = parent
    for item in (camera, parent):
        scene.collection.objects.link(item)
    scene.camera = camera
    scene.render.resolution_x, scene.render.resolution_y = 32, 20
    data.type, data.lens, data.ortho_scale = kind, 30.0, 5.0
    for name, value in settings.items():
        setattr(scene.render if hasattr(scene.render, name) else data, name, value)
    parent.scale, camera.rotation_euler = POSES[pose]
    parent.rotation_euler, parent.location = (0.9, 0.2, 0.7), (1.5, -2, 0.7)
    return scene, camera


CASES = [
    *((kind, settings, "plain") for kind in ("PERSP", "ORTHO") for settings in CAMERAS),
    *((kind, "portrait with shift", pose) for kind in ("PERSP", "ORTHO") for pose in POSES),
]


@pytest.mark.parametrize(("kind", "settings", "pose"), CASES)
def test_rays_are_those_of_cycles(blender, kind, settings, pose):
    scene, camera = set_up(blender, kind, CAMERAS[settings], pose)
    rays = read_camera(scene).rays()
    seen = cycles_directions(scene)
    assert seen.shape == rays.directions.shape
    assert not np.isnan(seen).any()
    assert np.linalg.norm(seen - rays.directions, axis=-1).max() <= DIRECTION
    if kind == "ORTHO":
        add_wall(blender, camera)
        position = cycles_surface(scene, "Position", reach=32)
        beside = np.cross(position - rays.origins, rays.directions)
        # 32 operations on numbers up to 16, as for directions, and a witness that stores to EPS32 of 64
        assert np.linalg.norm(beside, axis=-1).max() <= (32 * 16 + 64) * EPS32


def add_wall(bpy, camera):
    """Put a wall across all rays, in front of the camera and askew."""
    bpy.context.view_layer.update()
    matrix = np.array(camera.matrix_world.normalized(), np.float64)
    corners = np.array([(-9, -9, -4), (9, -9, -5), (9, 9, -6), (-9, 9, -5)]) @ matrix[:3, :3].T + matrix[:3, 3]
    mesh = bpy.data.meshes.new("Wall")
    mesh.from_pydata(corners.tolist(), [], [range(4)])
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("Wall", mesh))
