"""Presets of the camera model: those of the extension, and one that is added, chosen and removed."""

from pathlib import Path

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.read.scene import read_camera
from camera_ray_caster.blender.ui import presets

OURS = sorted((presets.FOLDER / "presets" / "camera_ray_caster").glob("*.py"))


def listed():
    return {path.stem for folder in bpy.utils.preset_paths("camera_ray_caster") for path in Path(folder).glob("*.py")}


@pytest.mark.parametrize("path", OURS, ids=lambda path: path.stem)
def test_a_preset_makes_a_camera_that_sees(blender, camera_scene, path):
    assert path.stem in listed()
    context = {"camera": camera_scene.camera.data}
    with blender.context.temp_override(**context):
        blender.ops.script.execute_preset(filepath=str(path), menu_idname=presets.ModelPresets.bl_idname)
    camera_scene.render.resolution_x, camera_scene.render.resolution_y = 64, 48
    blender.context.view_layer.update()
    camera = read_camera(camera_scene)
    assert camera.rays().valid[24, 32]


def test_the_camera_of_euroc_projects_as_opencv_does(blender, camera_scene):
    cv2 = pytest.importorskip("cv2")
    with blender.context.temp_override(camera=camera_scene.camera.data):
        blender.ops.script.execute_preset(filepath=str(OURS[1]), menu_idname=presets.ModelPresets.bl_idname)
    camera_scene.render.resolution_x, camera_scene.render.resolution_y = 752, 480
    blender.context.view_layer.update()
    points = np.array([[0.3, -0.2, 2.0], [-1.0, 0.5, 3.0]])  # OpenCV: y down, z ahead
    matrix = np.array([[458.654, 0, 367.215], [0, 457.296, 248.375], [0, 0, 1]])
    lens = np.array([-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05])
    expected = cv2.projectPoints(points, np.zeros(3), np.zeros(3), matrix, lens)[0].reshape(-1, 2)
    found = read_camera(camera_scene).project(points * (1, -1, -1))
    assert np.abs(found - (expected + 0.5) * (1, -1) - (0, 480)).max() < 1e-4  # the file's numbers, as float32


def test_a_preset_is_added_chosen_and_removed(blender, camera_scene):
    camera = camera_scene.camera.data
    own = camera.camera_ray_caster
    own.model, own.fov, own.tilt = "DOME_MASTER", 2.5, 0.25
    with blender.context.temp_override(camera=camera):
        blender.ops.camera_ray_caster.preset_add(name="Mine")
        assert "Mine" in listed()
        own.model, own.fov, own.tilt = "OMNIMAX", 1.0, 0.0
        (path,) = (folder / "Mine.py" for folder in map(Path, bpy.utils.preset_paths("camera_ray_caster"))
                   if (folder / "Mine.py").is_file())  # fmt: skip
        blender.ops.script.execute_preset(filepath=str(path), menu_idname=presets.ModelPresets.bl_idname)
        assert (own.model, own.fov, own.tilt) == ("DOME_MASTER", 2.5, 0.25)
        blender.ops.camera_ray_caster.preset_add(name="Mine", remove_name=True)
    assert "Mine" not in listed()
