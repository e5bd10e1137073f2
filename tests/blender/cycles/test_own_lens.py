"""Blender's own lens in place of a dome's: the same rays in a Cycles without the Open Shading Language."""

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_camera
from camera_ray_caster.core.conventions import EPS32

from .cycles import cycles_directions, cycles_surface

FLOAT32 = 4e-6
"""Radians: some ten operations in float32 in Cycles, and angles up to 2 from k1 and rotations of float32."""


def test_a_dome_master_is_a_fisheye_of_cycles_that_follows_the_camera(camera_scene, monkeypatch):
    """By its rays in Cycles, and by the points of a floor and a ceiling that they meet, at another frame."""
    import _cycles

    monkeypatch.setattr(_cycles, "with_osl", False)
    scene, camera = camera_scene, camera_scene.camera
    scene.render.engine, scene.render.resolution_x, scene.render.resolution_y = "CYCLES", 40, 32
    camera.data.camera_ray_caster.model, camera.data.camera_ray_caster.tilt = "DOME_MASTER", 0.3
    camera.scale, camera.location, camera.rotation_euler = (1, 2, 3), (1.5, -2, 0.7), (0.5, 0.2, 0.7)
    with pytest.raises(RuntimeError, match="use Fit Blender's Lens"):
        bpy.ops.camera_ray_caster.use_in_cycles()
    assert bpy.ops.camera_ray_caster.fit_lens() == {"FINISHED"}
    assert scene.camera is not camera
    assert (scene.camera.parent, scene.camera.data.type) == (camera, "PANO")
    camera.location, camera.rotation_euler = (0.3, 0.1, -0.2), (1.1, 0.4, 0.2)
    bpy.context.view_layer.update()
    rays, seen = read_camera(scene, camera).rays(), cycles_directions(scene)
    assert np.array_equal(~np.isnan(seen[..., 0]), rays.valid)
    assert np.nanmax(np.linalg.norm(seen - rays.directions, axis=-1)) <= FLOAT32
    for height in (-3, 3):
        bpy.ops.mesh.primitive_plane_add(size=40, location=(0, 0, height))
    position = cycles_surface(scene, "Position", reach=32)
    met = np.isfinite(position).all(axis=-1) & rays.valid & (np.linalg.norm(position, axis=-1) < 12)
    beside = np.linalg.norm(np.cross(position - rays.origins, rays.directions), axis=-1)
    assert met.mean() > 0.3
    assert beside[met].max() <= 12 * FLOAT32 + 64 * EPS32  # the witness stores to EPS32 of 64
