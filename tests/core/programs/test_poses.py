"""Poses in files: each format's, read back from our exports, from COLMAP's own binary, and by hand."""

import json
import struct

import numpy as np
import pytest

from camera_ray_caster.core.exports import export_files
from camera_ray_caster.core.exports.rigid import with_rotation
from camera_ray_caster.core.programs.reading.mounted import mounted
from camera_ray_caster.core.records import InputError

from ..colmap import colmap, to_binary
from ..exports.shots import shots
from .test_formats import GOOD
from .test_other_programs import MATRIX, OKVIS, K, basalt, sensor

FILES = {"colmap": ".", "nerfstudio": "transforms.json", "bop": "scene_camera.json", "json": "camera.json"}
EXACT = {"json": 1e-15, "nerfstudio": 1e-15, "colmap": 3e-15, "bop": 1e-14}
"""Largest difference of axes: COLMAP's quaternions and inverses, and BOP's millimeters, are rounded."""


def read(path, rate=24.0, frame=(640, 480)):
    return mounted(str(path), "", frame, rate)


@pytest.mark.parametrize(("key", "name"), [*((key, "perspective") for key in FILES), ("colmap", "radtan")])
def test_exported_poses_are_read_back(tmp_path, key, name):
    shot = shots(name)
    files, _ = export_files(key, shot)
    for file, content in files:
        (tmp_path / file).write_text(content)
    (camera,) = read(tmp_path / FILES[key])
    assert camera.name == ("Camera" if key == "bop" else name)
    assert camera.frames == [1, 12, 10000]
    assert camera.lens is not None
    for view, pose in zip(shot, camera.poses, strict=True):
        near = with_rotation(view.camera)[0].pose if key != "json" else view.camera.pose
        assert np.abs(pose[:3, :3] - near.basis).max() <= EXACT[key]
        assert np.abs(pose[:3, 3] - near.eye).max() <= 20 * EXACT[key]


def test_images_bin_says_what_images_txt_says(tmp_path):
    files, _ = export_files("colmap", shots("radtan"))
    for file, content in files:
        (tmp_path / file).write_text(content)
    (text,) = read(tmp_path / "images.txt")
    (tmp_path / "bin").mkdir()
    colmap(to_binary, str(tmp_path), str(tmp_path / "bin"))
    (binary,) = read(tmp_path / "bin")
    assert binary.frames == text.frames
    assert binary.lenses == text.lenses
    assert np.abs(np.array(binary.poses) - text.poses).max() < 1e-14


def test_a_damaged_images_bin_is_refused(tmp_path):
    """The number of points of its first image leads beyond all files."""
    content = struct.pack("<QI7dI", 2, 1, 1, 0, 0, 0, 0, 0, 0, 1) + b"a.png\0" + struct.pack("<Q", 1 << 63)
    (tmp_path / "images.bin").write_bytes(content + bytes(100))
    (tmp_path / "cameras.txt").write_text("1 PINHOLE 64 48 50 50 32 24\n")
    with pytest.raises(InputError, match=r"images\.bin"):
        read(tmp_path / "images.bin")


def test_a_camera_of_kalibr_stands_beside_the_one_before(tmp_path):
    """cam1 is 0.1 to the right of cam0 and turned about the vertical: T_cn_cnm1 leads from cam0 to cam1."""
    turn = "  T_cn_cnm1:\n  - [0.0, 0.0, 1.0, 0.0]\n  - [0.0, 1.0, 0.0, 0.0]\n  - [-1.0, 0.0, 0.0, 0.1]\n"
    first = GOOD[: GOOD.index("  T_cam_imu")]
    (tmp_path / "chain.yaml").write_text(first + first.replace("cam0:", "cam1:") + turn)
    left, right = read(tmp_path / "chain.yaml")
    assert (left.name, right.name, right.frames) == ("cam0", "cam1", [None])
    assert np.allclose(left.poses[0], np.diag((1, -1, -1, 1)))  # the file's frame has y down, as cam0 has
    assert np.allclose(right.poses[0][:3, 3], (0.1, 0, 0))
    assert np.allclose(right.poses[0][:3, :3] @ (0, 0, -1), (-1, 0, 0))  # it looks along cam0's -x
    (tmp_path / "chain.yaml").write_text(first + first.replace("cam0:", "cam1:"))
    with pytest.raises(InputError, match="no T_cn_cnm1 of cam1"):
        read(tmp_path / "chain.yaml")


@pytest.mark.parametrize(
    ("text", "position"),
    [
        (sensor("radtan", [0.1, 0, 0, 0]), (0.1, 0.2, 0.3)),
        (OKVIS.replace("KIND", "equidistant").replace("0, 1, 0, 0]", "0, 1, 0, 5, 0, 0, 1, 0]"), (0, 5, 0)),
        (basalt("kb4", k1=0, k2=0, k3=0, k4=0).replace('"px": 0', '"px": 2').replace(
            ', {"px": 2, "py": 0, "pz": 0, "qx": 0, "qy": 0, "qz": 0, "qw": 1}]', "]"), (2, 0, 0)),
        (json.dumps({"CameraCalibrations": [{
            "Label": "rgb", "Projection": {"Name": "Linear", "Params": [*K.values()]},
            "T_Device_Camera": {"Translation": [1, 2, 3], "UnitQuaternion": [1, [0, 0, 0]]},
        }]}), (1, 2, 3)),
    ],
)  # fmt: skip
def test_a_camera_in_a_body_stands_where_the_file_says(tmp_path, text, position):
    (tmp_path / "rig").write_text(text)
    (camera,) = read(tmp_path / "rig")
    assert np.allclose(camera.poses[0][:3, 3], position)
    assert np.allclose(camera.poses[0][:3, :3], np.diag((1, -1, -1)))
    assert camera.size == ((640, 480) if "Calibrations" not in text else None)


@pytest.mark.parametrize("euroc", [False, True])
def test_a_trajectory_has_a_frame_for_each_time(tmp_path, euroc):
    half = np.sqrt(0.5)
    lines = ["# timestamp tx ty tz qx qy qz qw", f"100.5 1 2 3 0 0 {half} {half}", "101.0 4 5 6 0 0 0 1"]
    if euroc:
        lines = ["#timestamp,p", f"1403636580000000000,1,2,3,{half},0,0,{half},9,9"]
        lines += ["1403636580500000000,4,5,6,1,0,0,0"]
    (tmp_path / "path.txt").write_text("\n".join(lines))
    (path,) = read(tmp_path / "path.txt")
    assert path.lenses == []
    assert path.frames == pytest.approx([1, 13], abs=1e-5)
    assert np.allclose(path.poses[0][:3], [[0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 3]])


def test_a_lens_may_change_from_frame_to_frame(tmp_path):
    frames = [{"file_path": f"zoom_{i:04}.png", "fl_x": 300.0 + i, "w": 640, "h": 480,
               "transform_matrix": np.eye(4).tolist()} for i in (1, 2)]  # fmt: skip
    (tmp_path / "transforms.json").write_text(json.dumps({"frames": frames}))
    (camera,) = read(tmp_path / "transforms.json")
    assert camera.lens is None
    assert [lens.settings["fx"] for lens in camera.lenses] == [301, 302]
    assert (camera.name, camera.size) == ("zoom", (640, 480))


LENSES = "1 PINHOLE 64 48 30 30 32 24\n2 OPENCV_FISHEYE 64 64 20 20 32 32 0 0 0 0\n3 PINHOLE 64 48 40 40 32 24\n"


@pytest.mark.cases(2)
@pytest.mark.parametrize(
    ("images", "expected"),
    [
        ({"b.jpg": 1, "a.jpg": 2, "d/c.jpg": 3}, {"b": [1], "a": [2], "c": [3]}),
        ({"x_0004.png": 1, "x_0005.png": 2, "x_0006.png": 3, "x_0007.png": 2}, {"x-1": [4], "x-2": [5, 7], "x-3": [6]}),
        ({"x_0004.png": 1, "x_0005.png": 3}, {"x": [4, 5]}),
        ({"left/x_0004.png": 1, "right/x_0004.png": 3}, {"left": [4], "right": [4]}),
        ({"a/x.jpg": 1, "b/x.jpg": 2}, {"a": [1], "b": [1]}),
        ({"left/x_0004.png": 1, "right/x_0004.png": 1, "right/x_0006.png": 1}, {"left": [4], "right": [4, 6]}),
        ({"00010.png": 3, "00025.png": 3, "20200102.png": 3}, {"Camera 3": [1, 2, 3]}),
        ({"00010.png": 3, "00025.png": 3}, {"Camera 3": [10, 25]}),
        ({"a/0004.png": 1, "b/0004.png": 2}, {"a": [4], "b": [4]}),
    ],
)
def test_an_image_may_have_a_camera_of_its_own(tmp_path, images, expected):
    (tmp_path / "cameras.txt").write_text(LENSES)
    lines = [f"{k} 1 0 0 0 {-k} 0 0 {camera} {name}\n\n" for k, (name, camera) in enumerate(images.items(), 1)]
    (tmp_path / "images.txt").write_text("".join(lines))
    cameras = read(tmp_path)
    assert {camera.name: camera.frames for camera in cameras} == expected
    places = {pose[0, 3]: lens.name for rig in cameras for pose, lens in zip(rig.poses, rig.lenses, strict=True)}
    assert places == {k: str(camera) for k, camera in enumerate(images.values(), 1)}


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (json.dumps({"K": MATRIX}), "it has no poses that are read: give a file of "),
        ('{"fl_x": 3, "frames": [{"transform_matrix": [[1, 2]]}]}', "has 2 numbers: a pose has 3 or 4 rows"),
        (json.dumps({"fl_x": 3, "frames": [{"transform_matrix": (2 * np.eye(4))[:3].tolist()}]}), "is no rotation"),
        ("1 0 0 0 0 0 0 0\n", "the rotation of pose 1 is 0"),
        ("1 0 0 0 0 0 0 1e-170\n", "the rotation of pose 1 is 0"),
        ("1 2 0 0 0 0 0 1\n5 5\n", "pose 2 is .* 8 finite numbers"),
        ("1 2 0 0 0 0 0 1\n2,3,0,0,0,0,0,1\n", "pose 2 is '2,3,.*': all lines must have commas, or none"),
        ("1 2 0 0 0 0 0 1\n2e6 3 0 0 0 0 0 1\n", "its times span 2e.06 s, more than the 1,048,574 frames"),
        ('{"fl_x": 3, "frames": []}', "it has no pose of a camera"),
        (json.dumps({"fl_x": 3, "frames": [{"transform_matrix": np.eye(4).tolist()}, {"file_path": "y"}]}),
         "it has no transform_matrix of y"),
        (json.dumps({"fl_x": 3, "frames": [{"transform_matrix": (np.eye(4) + np.eye(4)[[3]].T * 2).tolist()}]}),
         "the last row of transform_matrix of 0 is .*: it must be 0 0 0 1, of a matrix by rows"),
        (json.dumps({"0": {"cam_K": MATRIX, "cam_R_w2c": list(np.eye(3).ravel()), "cam_t_w2c": [0, 0, 1]},
                     "1": {"cam_K": MATRIX}}), "it has no cam_R_w2c of 1"),
    ],
)
def test_what_is_no_pose_is_refused_in_one_line(tmp_path, text, says):
    (tmp_path / "file").write_text(text)
    with pytest.raises(InputError, match=says):
        read(tmp_path / "file")


def test_a_pose_of_a_camera_that_the_file_does_not_have_is_refused(tmp_path):
    (tmp_path / "cameras.txt").write_text("1 PINHOLE 64 48 30 30 32 24\n")
    (tmp_path / "images.txt").write_text("1 1 0 0 0 1 2 3 7 a.png\n\n")
    with pytest.raises(InputError, match="it has a pose of camera '7', and no lens of it"):
        read(tmp_path)


def test_a_folder_without_a_model_of_colmap_is_refused_as_such(tmp_path):
    for folder in (tmp_path, "/"):  # the root has no name
        with pytest.raises(InputError, match=r"^folder '.*' has no images.bin or images.txt, nor its sparse/0"):
            read(folder)


def test_a_path_that_is_too_long_is_refused():
    with pytest.raises(InputError, match=r"^calibration file '.*' cannot be read: File name too long$"):
        read("x" * 300)
