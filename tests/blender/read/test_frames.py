"""Time Stretching: frames are places on the timeline, wherever a frame is named or gone to."""

import json

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.blender.output import exports
from camera_ray_caster.blender.read import read_camera, read_scene, read_shapes
from camera_ray_caster.blender.read.motion import keyed_frames
from camera_ray_caster.blender.terminal import commands
from camera_ray_caster.core.cast import cast

from .time_scene import key


@pytest.fixture
def stretched(scene, sphere):
    """Actions are evaluated at twice the frame: the sphere moves by 0.1 in each frame. The current one is 10."""
    scene.render.frame_map_old, scene.render.frame_map_new = 100, 50
    scene.camera.data.camera_ray_caster.time_mode = "NONE"
    key(sphere, "location", (20, (0, 0, 0)), (40, (1, 0, 0)), (60, (5, 0, 0)))
    scene.frame_set(10)
    assert scene.frame_current_final == 20
    return scene


def test_flow_is_that_of_the_neighboring_frames(stretched):
    read = read_scene(stretched, passes=("flow_forward", "flow_backward"))
    assert read.camera.record.settings["frame"] == 10
    assert [read.shapes.center[0, 0], read.next.shapes.center[0, 0]] == pytest.approx([0, 0.1], abs=1e-6)
    assert read_shapes(stretched, frame=12.5).center[0, 0] == pytest.approx(0.25)
    images = cast(read.camera, read.shapes, passes=("flow_forward", "shape_index"), dtype=float)
    seen = images["shape_index"] == 0
    np.testing.assert_allclose(images["flow_forward"][seen][:, 0], 0.1 * 4, atol=1e-5)  # 4 pixels a unit
    assert (stretched.frame_current, stretched.frame_subframe) == (10, 0)


def test_a_rolling_shutter_is_around_its_frame(stretched):
    stretched.camera.data.camera_ray_caster.time_mode = "ROLLING_SHUTTER"
    stretched.frame_set(12, subframe=0.5)
    time = read_camera(stretched).pixel_time
    assert (time.first + time.last) / 2 == pytest.approx(12.5, abs=0.01)
    middle = read_scene(stretched).shapes.at(12.5)
    assert middle.center[0, 0] == pytest.approx(0.25)
    assert keyed_frames(stretched).tolist() == [10, 20, 30], "keys lie at frames, too"


def test_numbers_of_frames_are_what_was_asked_for(stretched, blender, tmp_path):
    blender.ops.wm.save_as_mainfile(filepath=str(tmp_path / "stretched.blend"))
    words = [str(tmp_path / "stretched.blend"), "--passes", "position", "--format", "npz", "--annotations", "--output"]
    assert commands.main("cast", [*words, str(tmp_path / "out"), "--cameras", "ALL"], "cast.py") == 0
    assert commands.main("cast", [*words, str(tmp_path / "out"), "--frames", "20:20"], "cast.py") == 0
    for name, frame, x in (("Camera_0010", 10, 0), ("stretched_0020", 20, 1)):
        report = name.replace("stretched", "report")
        assert json.loads((tmp_path / "out" / f"{report}.json").read_text())["frame"] == frame
        image = json.loads((tmp_path / "out" / f"{name}_coco.json").read_text())["images"][0]
        assert image["frame"] == frame
        with np.load(tmp_path / "out" / f"{name}.npz") as file:
            columns = np.flatnonzero(file["position"][..., 2].any(axis=0))
        assert columns.mean() + 0.5 == pytest.approx(24 + 4 * x), "the middle of the sphere"
    _, paths = exports.write(blender.context.scene, "json", [blender.context.scene.camera], [10, 20], tmp_path / "json")
    assert crc.camera_from_json(paths[0], frame=20).name == "Camera"
