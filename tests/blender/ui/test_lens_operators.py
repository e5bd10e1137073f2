"""The buttons of a real lens: a lens that comes with the add-on, and its own focal length."""

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.blender.read.scene_reader import read_camera


def test_a_chosen_lens_has_its_own_focal_length_and_the_rays_of_python(blender, camera_scene):
    data, ops = camera_scene.camera.data, blender.ops.camera_ray_caster
    data.camera_ray_caster.model = "REAL_LENS"
    ops.choose_lens(name="tessar_100mm")
    assert data.lens == pytest.approx(100.001, abs=1e-3)
    data.lens = 35
    ops.own_focal_length()
    camera = read_camera(camera_scene)
    other = crc.camera("REAL_LENS", camera.raster.size, camera_scene.camera.matrix_world, lens=data.lens,
                       lens_file="tessar_100mm", focus_distance=data.dof.focus_distance)  # fmt: skip
    np.testing.assert_allclose(camera.rays().directions, other.rays().directions, atol=1e-7)
    data.camera_ray_caster.lens_file = "/nowhere/lens.dat"
    with pytest.raises(RuntimeError, match="cannot be read"):
        ops.own_focal_length()
