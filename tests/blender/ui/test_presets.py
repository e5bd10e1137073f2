"""Presets of the camera model: those of the extension, and one that is added, chosen and removed."""

from pathlib import Path

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_camera
from camera_ray_caster.blender.ui import presets

OURS = sorted((presets.FOLDER / "presets" / "camera_ray_caster").glob("*.py"))


def run(bpy, camera, name):
    """Choose a preset of ours for a camera."""
    (path,) = (path for path in OURS if path.stem == name)
    with bpy.context.temp_override(camera=camera):
        bpy.ops.script.execute_preset(filepath=str(path), menu_idname=presets.ModelPresets.bl_idname)


def listed():
    return {path.stem for folder in bpy.utils.preset_paths("camera_ray_caster") for path in Path(folder).glob("*.py")}


@pytest.mark.parametrize("path", OURS, ids=lambda path: path.stem)
def test_a_preset_makes_a_camera_that_sees(blender, camera_scene, path):
    assert path.stem in listed()
    run(blender, camera_scene.camera.data, path.stem)
    camera_scene.render.resolution_x, camera_scene.render.resolution_y = 64, 48
    blender.context.view_layer.update()
    camera = read_camera(camera_scene)
    assert camera.rays().valid[24, 32]


PINHOLE, FISHEYE = ("k1", "k2", "p1", "p2", "k3"), ("k1", "k2", "k3", "k4")
OPENCV = {
    "TUM_RGB-D_freiburg1": PINHOLE, "KITTI_odometry_00": PINHOLE, "TUM_VI_cam0_512": FISHEYE,
    "GoPro_HERO10_Wide_16_colon_9": FISHEYE, "GoPro_HERO10_Wide_4_colon_3": FISHEYE,
    "GoPro_HERO10_Linear_16_colon_9": FISHEYE, "GoPro_HERO11_Wide_8_colon_7": FISHEYE,
}  # fmt: skip
"""The coefficients of the presets of OpenCV's models."""


@pytest.mark.parametrize("name", OPENCV)
def test_a_preset_projects_as_opencv_does_and_sees_in_every_corner(blender, camera_scene, name):
    cv2 = pytest.importorskip("cv2")
    run(blender, camera_scene.camera.data, name)
    group, render = camera_scene.camera.data.camera_ray_caster, camera_scene.render
    width, height = render.resolution_x, render.resolution_y = group.calibration_width, group.calibration_height
    render.resolution_percentage = 10  # rays are cast at a tenth of the size
    blender.context.view_layer.update()
    assert read_camera(camera_scene).rays().valid.all()
    render.resolution_percentage = 100
    blender.context.view_layer.update()
    points = np.array([[[0.3, -0.2, 2.0], [-1.0, 0.5, 3.0]]])  # OpenCV: y down, z ahead
    matrix = np.array([[group.fx, group.skew, group.cx], [0, group.fy, group.cy], [0, 0, 1]])
    project = cv2.projectPoints if OPENCV[name] == PINHOLE else cv2.fisheye.projectPoints
    lens = np.array([getattr(group, key) for key in OPENCV[name]])
    expected = project(points, np.zeros(3), np.zeros(3), matrix, lens)[0].reshape(-1, 2)
    pixels = read_camera(camera_scene).project(points[0] * (1, -1, -1))
    assert np.abs(pixels - (expected + 0.5) * (1, -1) - (0, height)).max() < 1e-9 * width


@pytest.mark.parametrize(("name", "degrees"), [("Project_Aria_RGB", 110), ("Project_Aria_SLAM_left", 150)])
def test_a_camera_of_project_aria_is_as_wide_as_its_documentation_says(blender, camera_scene, name, degrees):
    """Up to a twentieth: there the angle is nominal, and devices differ."""
    run(blender, camera_scene.camera.data, name)
    group, render = camera_scene.camera.data.camera_ray_caster, camera_scene.render
    render.resolution_x, render.resolution_y = group.calibration_width, group.calibration_height
    blender.context.view_layer.update()
    rays = read_camera(camera_scene).model.rays(np.array([0.5, render.resolution_x - 0.5]), render.resolution_y / 2)[1]
    left, right = np.transpose(np.broadcast_arrays(*rays))
    assert np.degrees(np.arccos(left @ right)) == pytest.approx(degrees, rel=0.05)


def test_the_camera_of_euroc_projects_as_opencv_does(blender, camera_scene):
    cv2 = pytest.importorskip("cv2")
    run(blender, camera_scene.camera.data, "EuRoC_MAV_cam0")
    camera_scene.render.resolution_x, camera_scene.render.resolution_y = 752, 480
    blender.context.view_layer.update()
    points = np.array([[0.3, -0.2, 2.0], [-1.0, 0.5, 3.0]])  # OpenCV: y down, z ahead
    matrix = np.array([[458.654, 0, 367.215], [0, 457.296, 248.375], [0, 0, 1]])
    lens = np.array([-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05])
    expected = cv2.projectPoints(points, np.zeros(3), np.zeros(3), matrix, lens)[0].reshape(-1, 2)
    pixels = read_camera(camera_scene).project(points * (1, -1, -1))
    assert np.abs(pixels - (expected + 0.5) * (1, -1) - (0, 480)).max() < 1e-4  # the file's numbers, as float32


def test_a_preset_is_added_chosen_and_removed(blender, camera_scene):
    camera = camera_scene.camera.data
    settings = camera.camera_ray_caster
    settings.model, settings.fov, settings.tilt = "DOME_MASTER", 2.5, 0.25
    with blender.context.temp_override(camera=camera):
        blender.ops.camera_ray_caster.preset_add(name="Mine")
        assert "Mine" in listed()
        settings.model, settings.fov, settings.tilt = "OMNIMAX", 1.0, 0.0
        (path,) = (folder / "Mine.py" for folder in map(Path, bpy.utils.preset_paths("camera_ray_caster"))
                   if (folder / "Mine.py").is_file())  # fmt: skip
        blender.ops.script.execute_preset(filepath=str(path), menu_idname=presets.ModelPresets.bl_idname)
        assert (settings.model, settings.fov, settings.tilt) == ("DOME_MASTER", 2.5, 0.25)
        blender.ops.camera_ray_caster.preset_add(name="Mine", remove_name=True)
    assert "Mine" not in listed()


def test_a_preset_of_blender_s_own_model_keeps_the_type_and_the_lens(blender, camera_scene):
    camera = camera_scene.camera.data
    camera.type, camera.panorama_type, camera.fisheye_fov = "PANO", "FISHEYE_EQUIDISTANT", 2.5
    with blender.context.temp_override(camera=camera):
        blender.ops.camera_ray_caster.preset_add(name="Own")
        camera.type, camera.fisheye_fov, camera.camera_ray_caster.model = "PERSP", 1.0, "OMNIMAX"
        (path,) = (folder / "Own.py" for folder in map(Path, bpy.utils.preset_paths("camera_ray_caster"))
                   if (folder / "Own.py").is_file())  # fmt: skip
        blender.ops.script.execute_preset(filepath=str(path), menu_idname=presets.ModelPresets.bl_idname)
        assert (camera.camera_ray_caster.model, camera.type, camera.fisheye_fov) == ("BLENDER", "PANO", 2.5)
        blender.ops.camera_ray_caster.preset_add(name="Own", remove_name=True)


@pytest.mark.parametrize(("name", "problem"), [("gone.py", "No such file"), ("broken.py", "division"), ("", "type")])
def test_a_preset_that_cannot_be_used_is_refused_in_a_line(blender, camera_scene, tmp_path, name, problem):
    (tmp_path / "broken.py").write_text("1 / 0\n")
    with pytest.raises(RuntimeError, match=f"^Error: Preset '.*' cannot be used: .*{problem}.*\n$"):
        blender.ops.camera_ray_caster.preset_execute(filepath=str(tmp_path / name))
