"""The models that Blender does not have: chosen in a box, stored in the .blend, read as they are set."""

import numpy as np
import pytest

from camera_ray_caster.blender.properties.calibration_choice import set_calibration
from camera_ray_caster.blender.properties.groups import CameraProperties
from camera_ray_caster.blender.read.scene_reader import read_camera
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.records import InputError

from ...core.cameras.central_examples import FACTS
from ...core.cameras.table_examples import pinhole

BLENDERS = {
    "PERSP", "ORTHO", "EQUIRECTANGULAR", "EQUIANGULAR_CUBEMAP_FACE", "MIRRORBALL", "FISHEYE_EQUIDISTANT",
    "FISHEYE_EQUISOLID", "FISHEYE_LENS_POLYNOMIAL", "CENTRAL_CYLINDRICAL",
}  # fmt: skip
CALIBRATION = """%YAML:1.0
---
image_width: 96
image_height: 54
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 48., 0., 47.5, 0., 48., 26.5, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 1
   cols: 4
   dt: d
   data: [ 0.5, 0., 0., 0. ]
"""


@pytest.fixture
def scene(blender):
    scene = blender.context.scene
    camera = blender.data.objects.new("Camera", blender.data.cameras.new("Camera"))
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.resolution_x, scene.render.resolution_y = 96, 54
    return scene


def test_every_model_that_blender_does_not_have_can_be_chosen(blender):
    items = CameraProperties.bl_rna.properties["model"].enum_items
    assert {item.identifier for item in items} == {"BLENDER"} | {model.key for model in MODELS} - BLENDERS


CENTRAL = [(key, *fact) for key, facts in FACTS.items() for fact in facts]


@pytest.mark.parametrize(("key", "settings", "pixel", "origin", "direction"), CENTRAL)
def test_settings_reach_the_camera(blender, scene, key, settings, pixel, origin, direction):
    group = scene.camera.data.camera_ray_caster
    group.model = key
    calibration = {"cx": 47.5, "cy": 26.5, "calibration_width": 0, "calibration_height": 0, "fx": 60.0, "fy": 61.0}
    for name, value in (calibration | settings).items():
        setattr(scene.render if hasattr(scene.render, name) else group, name, value)
    camera = read_camera(scene)
    assert camera.model.key == key
    seen = camera.rays_at(*pixel).directions
    # settings are stored as float32: angles of up to 2 pi and pixels of up to 96
    np.testing.assert_allclose(seen, np.array(direction) / np.linalg.norm(direction), rtol=0, atol=5e-7)


def test_the_model_is_stored_in_the_file(blender, scene, tmp_path):
    settings = scene.camera.data.camera_ray_caster
    settings.model, settings.tilt = "OMNIMAX", 0.25
    blender.ops.wm.save_as_mainfile(filepath=str(tmp_path / "dome.blend"))
    blender.ops.wm.open_mainfile(filepath=str(tmp_path / "dome.blend"))
    camera = read_camera(blender.context.scene)
    assert camera.model.key == "OMNIMAX"
    assert camera.model.elevation == 0.25


def test_a_calibration_file_beside_the_blend_is_found_and_a_missing_one_named(blender, scene, tmp_path):
    (tmp_path / "lens.yml").write_text(CALIBRATION)
    blender.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    settings = blender.context.scene.camera.data.camera_ray_caster
    settings.model, settings.calibration_file = "OPENCV_PINHOLE", "//lens.yml"
    seen = read_camera(blender.context.scene).rays_at(48 + 48 * 9 / 16, 27).directions
    np.testing.assert_allclose(seen, np.array([1, 0, -2]) / np.sqrt(5), rtol=0, atol=1e-15)
    settings.calibration_file = "//lost.yml"
    with pytest.raises(InputError, match="lost"):
        read_camera(blender.context.scene)


CAMERAS = "1 PINHOLE 640 480 500 501 320 240\n2 OPENCV_FISHEYE 640 480 300 301 320 240 0.01 0 0 0\n"


def test_the_model_follows_from_a_calibration_file(blender, scene, tmp_path):
    path = tmp_path / "cameras.txt"
    path.write_text(CAMERAS)
    group, scene.render.resolution_y = scene.camera.data.camera_ray_caster, 72
    with pytest.raises(RuntimeError, match="set Camera in File to one of 1, 2"):
        blender.ops.camera_ray_caster.load_calibration(filepath=str(path))
    assert (group.model, group.calibration_file) == ("BLENDER", "")
    for name, model in (("2", "OPENCV_FISHEYE"), ("1", "OPENCV_PINHOLE")):
        blender.ops.camera_ray_caster.load_calibration(filepath=str(path), camera=name)
        assert group.model == model
        assert read_camera(scene).model.key == model
    path.write_text("nothing\n")
    with pytest.raises(RuntimeError, match="cameras"):
        blender.ops.camera_ray_caster.load_calibration(filepath=str(path))
    assert group.model == "OPENCV_PINHOLE"


def test_what_was_read_is_said(scene, tmp_path):
    path = tmp_path / "cameras.txt"
    path.write_text(CAMERAS)
    message = set_calibration(scene.camera.data, str(path), "2")
    assert message.startswith("Camera 2: OpenCV Fisheye, ")
    assert "fx 300, fy 301" in message


def test_a_table_of_rays_is_chosen_as_a_calibration_and_its_choices_stay(scene, tmp_path):
    path = tmp_path / "rays.npy"
    np.save(path, pinhole(24, 14))
    settings = scene.camera.data.camera_ray_caster
    settings.ray_interpolation = "LINEAR"
    message = set_calibration(scene.camera.data, str(path))
    assert message.startswith("Camera without a name: Ray Table, ")
    assert (settings.model, settings.calibration_file, settings.ray_interpolation) == ("RAY_TABLE", str(path), "LINEAR")
    model = read_camera(scene).model
    assert (model.key, model.grid.kind, model.grid.shape) == ("RAY_TABLE", "LINEAR", (14, 24))
    assert read_camera(scene).model.grid is model.grid, "the table is prepared once"
    settings.calibration_file = ""
    with pytest.raises(InputError, match="no table of rays: choose its file"):
        read_camera(scene)
