"""Cameras behind glass in Cycles: its rays, and the points that they meet, are ours."""

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.cycles import to_cycles
from camera_ray_caster.blender.read.scene_reader import read_camera
from camera_ray_caster.core.conventions import EPS32

from .cycles import cycles_directions, cycles_surface

FLOAT32 = 2e-6
"""Radians, as in test_to_cycles: some ten operations in float32."""
PORTS = {
    "flat": {"port": "FLAT", "port_tilt_x": 0.2, "port_tilt_y": -0.1},
    "dome": {"model": "CYLINDRICAL", "port": "DOME", "port_decenter": (3.0, -5.0, 30.0)},
}


@pytest.mark.parametrize("name", PORTS)
def test_cycles_has_the_rays_behind_glass_and_meets_the_same_points(osl, camera_scene, name):
    """Each ray begins elsewhere: positions on a wall askew, seen by Cycles, lie on our rays."""
    scene, render, camera = camera_scene, camera_scene.render, camera_scene.camera
    render.engine, render.resolution_x, render.resolution_y = "CYCLES", 48, 32
    camera.location, camera.rotation_euler = (1.5, -2, 0.7), (0.5, 0.2, 0.7)
    camera.data.lens, camera.data.shift_x = 18.0, 0.2
    for setting, value in PORTS[name].items():
        setattr(camera.data.camera_ray_caster, setting, value)
    before = read_camera(scene).rays()
    to_cycles(scene)
    rays, seen = read_camera(scene).rays(), cycles_directions(scene)
    np.testing.assert_array_equal(rays.directions, before.directions)
    assert np.array_equal(~np.isnan(seen[..., 0]), rays.valid)
    assert np.nanmax(np.linalg.norm(seen - rays.directions, axis=-1)) <= FLOAT32
    wall = bpy.data.meshes.new("Wall")
    wall.from_pydata([(-9, -9, -4), (9, -9, -3), (9, 9, -2), (-9, 9, -3)], [], [range(4)])
    scene.collection.objects.link(bpy.data.objects.new("Wall", wall))
    position = cycles_surface(scene, "Position", reach=32)
    met = np.isfinite(position).all(axis=-1) & (np.linalg.norm(position, axis=-1) < 12)
    beside = np.linalg.norm(np.cross(position - rays.origins, rays.directions), axis=-1)
    assert met.mean() > 0.1
    # directions to FLOAT32 at distances up to 16, and a witness that stores to EPS32 of 64
    assert beside[met].max() <= 16 * FLOAT32 + 64 * EPS32
