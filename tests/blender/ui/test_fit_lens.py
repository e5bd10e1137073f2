"""The button that sets Blender's own lens nearest to a model."""

import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_camera


def test_the_nearest_lens_of_blender_takes_the_place_of_the_model(blender, camera_scene):
    data, ops = camera_scene.camera.data, blender.ops.camera_ray_caster
    settings = data.camera_ray_caster
    settings.model, settings.fx, settings.fy, settings.cx, settings.cy = "OPENCV_PINHOLE", 70, 70, 50, 25
    render = camera_scene.render
    settings.calibration_width, settings.calibration_height = render.resolution_x, render.resolution_y
    before = read_camera(camera_scene).K
    ops.fit_lens()
    assert (data.type, settings.model) == ("PERSP", "BLENDER")
    assert np.abs(read_camera(camera_scene).K - before).max() < 1e-4
    settings.model, settings.fx, settings.fy = "OPENCV_FISHEYE", 30, 30
    ops.fit_lens()
    assert (data.type, data.panorama_type) == ("PANO", "FISHEYE_LENS_POLYNOMIAL")
    settings.model = "CYLINDRICAL"
    with pytest.raises(RuntimeError, match="No Blender camera type matches"):
        ops.fit_lens()
    settings.model, data.type, data.panorama_type = "BLENDER", "PANO", "EQUIRECTANGULAR"
    with pytest.raises(RuntimeError, match="Cycles renders it as it is"):
        ops.fit_lens()
