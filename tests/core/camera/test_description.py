"""What a camera says of itself, which cameras are equal, and cameras with other settings."""

import pickle
from copy import copy
from dataclasses import replace
from pathlib import Path
from subprocess import run
from sys import executable

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.camera.equality import same
from camera_ray_caster.core.records import no_shapes

SIZE = 640, 480
LENS = {"fx": 210.0, "fy": 211.0, "cx": 300.0, "cy": 239.0, "k1": 0.1}
POSE = crc.look_at((1, 2, 3), (0, 0, 0))


def fisheye(**changed):
    return crc.camera("OPENCV_FISHEYE", SIZE, POSE, **(LENS | changed))


def test_equal_cameras_are_equal():
    assert fisheye() == fisheye()
    assert len({fisheye(), fisheye(), fisheye(k1=0.2), fisheye(name="other")}) == 3
    assert fisheye() != fisheye().with_pose(np.eye(4))
    assert fisheye() != "camera"
    assert fisheye() == fisheye().with_settings() == fisheye(k1=0.2).with_settings(k1=0.1) == fisheye().with_pose(POSE)
    table = np.array([[(0, 0, -1.0), (0.1, 0, -1)], [(0, 0.1, -1), (0.1, 0.1, -1)]])
    first, second, third = (
        crc.camera("RAY_TABLE", (8, 8), ray_directions=rays) for rays in (table, table + 0, table[::-1])
    )
    assert first == second
    assert first != third


@pytest.mark.parametrize("second", [np.array(3.0), np.array(3), np.float32(3), 3, 3.0])
def test_a_number_equals_an_array_of_no_axis(second):
    first = np.array(3.0)
    assert same(first, second)
    assert same({"fx": [first]}, {"fx": np.array([3.0])})
    assert not any(same(first, other) for other in (np.array(4.0), 4, [3.0], "3", None))
    camera = fisheye()
    with_array = replace(camera, record=replace(camera.record, settings=camera.record.settings | {"k1": np.array(0.1)}))
    assert with_array == camera
    assert with_array != fisheye(k1=0.2)


def test_what_was_the_timeline_is_named():
    shapes = crc.spheres((0, 0, -4))
    for thing in (fisheye(), shapes):
        with pytest.raises(AttributeError, match="no timeline: use motion, next and previous"):
            thing.timeline  # noqa: B018
    with pytest.raises(AttributeError, match="shapes have no centre: use center"):
        shapes.centre  # noqa: B018
    assert not hasattr(shapes, "_private")
    assert len(pickle.loads(pickle.dumps(shapes))) == len(copy(shapes)) == 1


@pytest.mark.parametrize("key", ["PERSP", "OPENCV_FISHEYE", "RAY_TABLE", "PUSHBROOM"])
def test_a_camera_of_a_file_is_the_one_that_was_written(key):
    """Which numbers are lists, arrays or whole does not count."""
    table = np.array([[(x, y, -1.0 - x * x) for x in (-0.4, -0.1, 0.3)] for y in (-0.2, 0.2)])
    settings = {
        "OPENCV_FISHEYE": LENS, "RAY_TABLE": {"ray_directions": table}, "PUSHBROOM": {"slit_1": [(0, 0, 8), (0, 1, 0)]},
    }  # fmt: skip
    camera = crc.camera(key, SIZE, POSE, **settings.get(key, {}))
    again = crc.camera_from_json(crc.camera_to_json(camera))
    assert again == camera
    assert hash(again) == hash(camera)
    assert crc.camera("OPENCV_FISHEYE", SIZE, fx=30, fy=30) == crc.camera("OPENCV_FISHEYE", SIZE, fx=30.0, fy=30.0)


def test_a_camera_is_one_line_with_its_own_settings():
    line = repr(fisheye(name="left"))
    assert "\n" not in line
    for words in ("'left'", "OPENCV_FISHEYE", "640 x 480", "fx=210.0", "k1=0.1", "at (1, 2, 3)"):
        assert words in line
    assert not any(word in line for word in ("pitch", "calibration"))
    assert "lens=35.0" in repr(crc.camera("PERSP", SIZE, lens=35.0))
    assert "lens" not in repr(crc.camera("PERSP", SIZE))


def test_shapes_scenes_images_and_fits_are_one_line():
    shapes = crc.join(crc.spheres(2 * [(0, 0, -4)]), crc.mesh([(0, 0, -9), (1, 0, -9), (0, 1, -9)], [(0, 1, 2)]))
    assert repr(shapes) == "<Shapes sphere: 2, mesh: 1>"
    assert repr(no_shapes()) == "<Shapes none>"
    scene = crc.Scene(crc.camera("PERSP", (8, 6)), shapes)
    assert repr(scene) == f"<Scene {scene.camera}, {shapes}>"
    assert repr(crc.cast(scene, passes=("depth", "normal"))) == "<Images: depth (6, 8), normal (6, 8, 3)>"
    assert repr(crc.cast(scene, passes="depth", rows="top")) == "<TopDown: depth (6, 8)>"
    assert repr(crc.cast_rays((0, 0, 0), [(0, 0, -1)] * 9, shapes, passes="distance")) == "<RayImages: distance (9,)>"
    assert repr(scene.camera.rays()) == "<Rays (6, 8): 48 valid>"
    assert repr(scene.camera.rays_jacobian()) == "<RaysJacobian (6, 8)>"
    assert repr(crc.scan(scene)) == f"<PointCloud 'Camera': {len(crc.scan(scene))} points>"
    assert "\n" not in repr(scene.camera.pose)
    line = repr(crc.fit(fisheye(), "OPENCV_FISHEYE"))
    assert line.startswith("<Fit: OpenCV Fisheye, at most ")
    assert "\n" not in line


def test_matrices_and_size():
    camera = fisheye()
    assert (camera.width, camera.height) == SIZE
    np.testing.assert_allclose(camera.world_from_camera, POSE, atol=1e-15)
    axes = np.linalg.inv(camera.world_from_camera) @ np.linalg.inv(camera.opencv_from_world)
    np.testing.assert_allclose(axes, np.diag((1, -1, -1, 1)), atol=1e-15)
    assert np.array_equal(camera.world_to_opencv, camera.opencv_from_world)


@pytest.mark.parametrize(
    ("key", "before", "after"),
    [
        ("OPENCV_FISHEYE", LENS, {"k1": 0.2, "clip_end": 9.0}),
        ("PERSP", {"lens": 20.0}, {"lens": 35.0, "use_dof": True, "focus_distance": 3.0}),
        ("PUSHBROOM", {"slit_1": [(0, 0, 8), (0, 1, 0)]}, {"slit_1": [(0, 1, 8), (0, 1, 0)], "lens": 40.0}),
        ("PERSP", {}, {"port": "flat", "port_distance": 10.0}),
        ("PERSP", {"lens": 20.0}, {"time_mode": "rolling_shutter", "name": "b", "frame": 3.0}),
        ("SCANNER", {"scanner_device": "VLP_16"}, {"scanner_rate": 5.0}),
    ],
)
def test_other_settings_are_those_of_a_new_camera(key, before, after):
    assert crc.camera(key, (64, 48), POSE, **before).with_settings(**after).rays_at(20, 10).directions == pytest.approx(
        crc.camera(key, (64, 48), POSE, **(before | after)).rays_at(20, 10).directions, abs=0
    )
    assert (
        crc.camera(key, (64, 48), POSE, **before).with_settings().settings
        == crc.camera(key, (64, 48), POSE, **before).settings
    )


def test_settings_of_a_file_stay_when_one_is_changed(tmp_path):
    (path,) = crc.export(fisheye(), tmp_path / "left.yml").paths
    read = crc.load_calibration(path, pose=POSE, model="OPENCV_FISHEYE")
    changed = read.with_settings(k1=0.2)
    assert changed.settings["calibration_file"] == ""
    np.testing.assert_array_equal(changed.rays_at(20, 10).directions, fisheye(k1=0.2).rays_at(20, 10).directions)


def test_what_cannot_be_changed_is_refused_in_one_line():
    for settings, message in {
        ("foo", 1): "unknown setting",
        ("lens", 3.0): "no effect unless",
        ("fx", -1.0): "fx",
    }.items():
        with pytest.raises(crc.InputError, match=message):
            fisheye().with_settings(**dict([settings]))


USES = {
    "near": "clip_start", "unproject": "rays_at", "fov": "settings", "K_inv": "K, or numpy",
    "getW2C": "opencv_from_world", "projct": "project",
}  # fmt: skip


@pytest.mark.parametrize(("name", "use"), USES.items())
def test_names_of_other_libraries_lead_to_the_right_one(name, use):
    with pytest.raises(AttributeError, match=f"no {name}: use {use}"):
        getattr(fisheye(), name)
    assert not hasattr(fisheye(), name)


@pytest.mark.parametrize(("name", "use"), {"load_mesh": "mesh", "render": "cast", "undistort": "export"}.items())
def test_functions_of_other_libraries_lead_to_the_right_one(name, use):
    with pytest.raises(AttributeError, match=rf"use {use}\("):
        getattr(crc, name)


@pytest.mark.full
def test_a_type_checker_sees_what_is_there_and_nothing_else(tmp_path):
    pytest.importorskip("mypy")
    good = Path(__file__).parents[1] / "library" / "every_name.py"
    (tmp_path / "bad.py").write_text(
        "import camera_ray_caster as crc\ncrc.load_mesh\ncrc.camera('PERSP', (1, 1)).near\n"
    )
    options = "--strict", "--follow-imports=silent", f"--cache-dir={tmp_path}"
    command = [executable, "-m", "mypy", *options, good, "bad.py"]
    path = str(Path(crc.__file__).parents[1])
    checker = run(
        command, cwd=tmp_path, env={"MYPYPATH": path, "PATH": ""}, capture_output=True, text=True, check=False
    ).stdout
    assert [line.split(":")[0] for line in checker.splitlines()[:-1]] == ["bad.py", "bad.py"], checker
