"""The button that sets Blender's own lens nearest to a model."""

import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_camera


def test_the_nearest_lens_of_blender_takes_the_place_of_the_model(blender, camera_scene):
    data, ops = camera_scene.camera.data, blender.ops.camera_ray_caster
    own = data.camera_ray_caster
    own.model, own.fx, own.fy, own.cx, own.cy = "OPENCV_PINHOLE", 70, 70, 50, 25
    own.calibration_width, own.calibration_height = camera_scene.render.resolution_x, camera_scene.render.resolution_y
    before = read_camera(camera_scene).K
    ops.fit_lens()
    assert (data.type, own.model) == ("PERSP", "BLENDER")
    assert np.abs(read_camera(camera_scene).K - before).max() < 1e-4
    own.model, own.fx, own.fy = "OPENCV_FISHEYE", 30, 30
    ops.fit_lens()
    assert (data.type, data.panorama_type) == ("PANO", "FISHEYE_LENS_POLYNOMIAL")
    own.model = "CYLINDRICAL"
    with pytest.raises(RuntimeError, match="No Blender camera type matches"):
        ops.fit_lens()
    own.model, data.type, data.panorama_type = "BLENDER", "PANO", "EQUIRECTANGULAR"
    with pytest.raises(RuntimeError, match="Cycles renders it as it is"):
        ops.fit_lens()
