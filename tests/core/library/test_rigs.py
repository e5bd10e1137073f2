"""Cameras of files with their poses, without Blender; and lenses of panoramas, and of cameras with the same numbers."""

import json

import numpy as np
import pytest

import camera_ray_caster as crc

POSE = crc.look_at((1.0, 2.0, 3.0), (0.0, 0.0, 0.0))
K = [[500.0, 0, 319.5], [0, 510.0, 239.5], [0, 0, 1]]
NUMBERS = [number for row in K for number in row]


def moving(folder):
    """A camera that moves, in a file of nerfstudio."""
    for frame, x in ((1, 1.0), (3, 2.0)):
        pose = crc.look_at((x, 2.0, 3.0), (0.0, 0.0, 0.0))
        camera = crc.camera("OPENCV_PINHOLE", (640, 480), pose, fx=500.0, name="a", frame=frame)
        crc.export(camera, folder / str(frame), "nerfstudio")
    both = [json.loads((folder / str(frame) / "transforms.json").read_text()) for frame in (1, 3)]
    path = folder / "transforms.json"
    path.write_text(json.dumps(both[0] | {"frames": both[0]["frames"] + both[1]["frames"]}))
    return path


def test_a_camera_that_moves_has_its_pose_at_each_of_its_frames(tmp_path):
    (camera,) = crc.load_rig(moving(tmp_path)).values()
    assert camera.frames == (1.0, 3.0)
    np.testing.assert_allclose(camera.pose.eye, (1, 2, 3), atol=1e-12)
    np.testing.assert_allclose(camera.at(3).pose.eye, (2, 2, 3), atol=1e-12)
    assert [view.pose.eye[0] for view in camera] == pytest.approx([1, 2])
    assert len(camera) == 2
    assert camera[1].record.settings["frame"] == 3
    with pytest.raises(crc.InputError, match="no pose at frame 2: the nearest is 1"):
        camera.at(2)
    crc.export(list(camera), tmp_path / "again", "colmap")
    (again,) = crc.load_rig(tmp_path / "again").values()
    np.testing.assert_allclose([view.pose.eye for view in again], [view.pose.eye for view in camera], atol=1e-12)
    distance = crc.cast(camera, crc.spheres((0, 0, 0), 1.0), passes=("distance",))["distance"]
    assert distance[240, 320] == pytest.approx(14**0.5 - 1, rel=1e-5)  # half a pixel beside the middle


def test_cameras_of_a_rig_stand_still_in_its_body(tmp_path):
    lens = "  camera_model: ds\n  distortion_model: none\n  intrinsics: [-0.2, 0.6, 300, 301, 320, 240]\n"
    lens += "  resolution: [640, 480]\n"
    beside = "  T_cn_cnm1: [[1, 0, 0, -0.12], [0, 1, 0, 0], [0, 0, 1, 0.01], [0, 0, 0, 1]]\n"
    (tmp_path / "chain.yaml").write_text(f"cam0:\n{lens}cam1:\n{lens}{beside}")
    rig = crc.load_rig(tmp_path / "chain.yaml")
    assert list(rig) == ["cam0", "cam1"]
    np.testing.assert_allclose(rig["cam1"].pose.eye, (0.12, 0, -0.01), atol=1e-15)
    assert rig["cam1"].frames == ()
    assert rig["cam1"].at(7).name == "cam1"
    assert rig["cam1"].settings["fx"] == 300


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("a.txt", "1.0 1 2 3 0 0 0 1\n", "is a trajectory, which has no lens: give a file with lenses and poses"),
        ("a.json", json.dumps({"K": K}), "it has no poses that are read"),
        ("a.json", json.dumps({"7": {"cam_K": NUMBERS, "cam_R_w2c": np.eye(3).ravel().tolist(),
                                     "cam_t_w2c": [0, 0, 0], "depth_scale": 1}}), "give size="),
    ],
)  # fmt: skip
def test_what_is_missing_is_said(tmp_path, name, text, words):
    (tmp_path / name).write_text(text)
    with pytest.raises(crc.InputError, match=words):
        crc.load_rig(tmp_path / name)


def test_a_file_without_sizes_has_the_given_one(tmp_path):
    entry = {"cam_K": NUMBERS, "cam_R_w2c": np.eye(3).ravel().tolist(), "cam_t_w2c": [0, 0, 1000]}
    (tmp_path / "scene_camera.json").write_text(json.dumps({"7": entry | {"depth_scale": 1}}))
    (camera,) = crc.load_rig(tmp_path / "scene_camera.json", size=(640, 480)).values()
    assert (camera.frames, camera.pose.eye.tolist(), camera.K[1, 1]) == ((7.0,), [0, 0, -1], 510)


@pytest.mark.filterwarnings("ignore:the poses that")
@pytest.mark.parametrize("key", ["colmap", "mrcal"])
def test_a_panorama_is_loaded_from_what_is_exported(tmp_path, key):
    paths, _ = crc.export(crc.camera("EQUIRECTANGULAR", (200, 100)), tmp_path, key)
    path = next(path for path in paths if path.name in ("cameras.txt", "Camera_0000.cameramodel"))
    camera = crc.load_calibration(path)
    assert (camera.model.key, camera.raster.size) == ("EQUIRECTANGULAR", (200, 100))
    if key == "colmap":
        assert crc.load_rig(tmp_path)["Camera"].model.key == "EQUIRECTANGULAR"


def test_parallel_rays_are_loaded(tmp_path):
    entries = {"camera_model": "ORTHOPHOTO", "fl_x": 50, "fl_y": 50, "cx": 100, "cy": 50, "w": 200, "h": 100}
    frame = {"file_path": "a_0001.png", "transform_matrix": POSE.tolist()}
    (tmp_path / "transforms.json").write_text(json.dumps(entries | {"frames": [frame]}))
    camera = crc.load_calibration(tmp_path / "transforms.json")
    assert (camera.model.key, camera.settings["ortho_scale"], camera.raster.size) == ("ORTHO", 4.0, (200, 100))


def test_cameras_with_the_same_numbers_keep_their_names(tmp_path):
    same = {"camera_matrix": K, "image_width": 640, "image_height": 480}
    (tmp_path / "two.json").write_text(json.dumps({"cam0": same, "cam1": same}))
    assert crc.load_calibration(tmp_path / "two.json", camera="cam1").name == "cam1"
    with pytest.raises(crc.InputError, match=r"no camera 'cam2'.* to one of cam0, cam1"):
        crc.load_calibration(tmp_path / "two.json", camera="cam2")
