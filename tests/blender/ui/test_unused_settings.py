"""Settings in whose place a device, a file or the fit of the sensor stands."""

from itertools import product

import numpy as np

from camera_ray_caster.blender.read.scene_reader import read_camera
from camera_ray_caster.blender.ui.camera_panels import SidebarSettings
from camera_ray_caster.blender.ui.model_panels import LensPanel, ModelPanel

from .test_model_panels import drawn


def test_settings_without_effect_are_not_shown(blender):
    data = blender.data.cameras.new("Camera")
    group = data.camera_ray_caster
    group.model = "SCANNER"
    beside_device = ("calibration_file", "scanner_device", "scanner_rate", "scanner_start")
    custom, _ = drawn(blender, ModelPanel, data)
    assert set(custom) > {*beside_device, "scanner_elevations", "scanner_low", "scanner_columns"}
    group.scanner_elevations = " "
    assert drawn(blender, ModelPanel, data)[0] == custom, "as without a text"
    group.scanner_elevations, group.scanner_period = "-10 10", 50.0
    assert set(custom) - set(drawn(blender, ModelPanel, data)[0]) == {"scanner_low", "scanner_high", "scanner_columns"}
    group.scanner_device = "OS1_64"
    assert drawn(blender, ModelPanel, data)[0] == beside_device
    group.calibration_file = "beams.json"
    assert drawn(blender, ModelPanel, data)[0] == (
        "calibration_file", "calibration_camera", "scanner_rate", "scanner_start",
    )  # fmt: skip
    group.model = "OMNIMAX"
    assert drawn(blender, ModelPanel, data)[0] == ("tilt",), "it reads no file"
    blender.context.scene.camera = blender.data.objects.new("Camera", data)
    group.model, data.sensor_fit = "CROSS_SLIT", "VERTICAL"
    shown = drawn(blender, SidebarSettings, data)[0]
    assert "sensor_height" in shown
    assert "sensor_width" not in shown


def test_what_only_the_eyes_of_a_stereo_scene_read_is_shown(blender, camera_scene):
    data, render = camera_scene.camera.data, camera_scene.render
    stereo, data.stereo.pivot, data.sensor_fit = data.stereo, "CENTER", "VERTICAL"

    def left_eye(name, value):
        setattr(data, name, value)
        blender.context.view_layer.update()
        rays = read_camera(camera_scene, view="left" if render.use_multiview else "").rays()
        return np.concatenate((rays.origins, rays.directions))

    cases = product(("PERSP", "ORTHO"), ("OFFAXIS", "PARALLEL"), (True, False), (True, False))
    for data.type, stereo.convergence_mode, stereo.use_spherical_stereo, render.use_multiview in cases:
        for name in ("sensor_width",) if data.type == "PERSP" else ("sensor_width", "lens"):
            is_read = not np.array_equal(left_eye(name, 30.0), left_eye(name, 60.0))
            for panel, engine in (LensPanel, "CAMERA_RAY_CASTER"), (SidebarSettings, "CYCLES"), (ModelPanel, "CYCLES"):
                assert (name in drawn(blender, panel, data, engine)[0]) == is_read, panel
    stereo.convergence_mode, render.use_multiview, data.sensor_fit = "OFFAXIS", True, "AUTO"
    for panel in LensPanel, ModelPanel:
        assert "sensor_width" not in drawn(blender, panel, data)[0], "beside the panel of the sensor"


def test_the_focal_length_is_shown_where_an_aperture_reads_it(blender, scene, tmp_path):
    path = tmp_path / "cameras.txt"
    path.write_text("1 PINHOLE 24 16 17 17 12 8\n")
    data = scene.camera.data
    data.camera_ray_caster.model, data.camera_ray_caster.calibration_width = "OPENCV_PINHOLE", 0
    data.camera_ray_caster.calibration_height = 0

    def radius(lens):
        data.lens = lens
        blender.context.view_layer.update()
        aperture = read_camera(scene).aperture
        return aperture and aperture.radius

    for file in ("", str(path)):
        data.camera_ray_caster.calibration_file = file
        for has_blur in (False, True):
            data.dof.use_dof = has_blur
            assert (radius(30.0) != radius(60.0)) == has_blur
            assert ("lens" in drawn(blender, SidebarSettings, data)[0]) == has_blur
