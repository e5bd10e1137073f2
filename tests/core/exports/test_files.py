"""NPZ, BOP, nerfstudio and ROS files: what is in them, by the formats' own words."""

import json
from io import BytesIO

import cv2
import numpy as np
import pytest

from camera_ray_caster.core.exports import EXPORT_FORMATS, export_files
from camera_ray_caster.core.exports.format import Shot
from camera_ray_caster.core.exports.rigid import with_rotation
from camera_ray_caster.core.maths.rotations import half_turn_vector, quaternion
from camera_ray_caster.core.records import InputError

from ..cameras.model_examples import BORDER, TURNED, camera
from .shots import CAMERAS, FRAME, pose, shots, views


def files(key, made):
    return dict(export_files(key, made)[0])


def choices(key, made):
    """The formats that are named in place of one that refuses, and what it says before them."""
    with pytest.raises(InputError) as refusal:
        export_files(key, made)
    reason, _, names = str(refusal.value).partition(": choose one of ")
    return reason, names.removesuffix(", or Fit Nearest Lens (--fit)").split(", ")


@pytest.mark.parametrize("key", ["PERSP", "CROSS_SLIT", "FISHEYE_EQUIDISTANT"])
def test_npz_has_the_rays_of_the_window(key):
    there = camera(key, BORDER | {"matrix_world": pose(3)})
    ((name, content),) = export_files("npz", [Shot("Camera", 12, there)])[0]
    assert name == "Camera_0012.npz"
    arrays = np.load(BytesIO(content))
    rays = there.rays()
    assert sorted(arrays) == ["area", "directions", "origins", "pose", "valid"]
    for field in ("directions", "origins", "valid"):
        assert arrays[field].dtype == getattr(rays, field).dtype
        assert np.array_equal(arrays[field], getattr(rays, field), equal_nan=field == "directions")


def test_npz_has_the_times_of_pixels():
    there = camera("PERSP", {"time_mode": "ROWS", "time_start": 1.0, "time_end": 2.0, "time_tolerance": 0.1,
                             "time_evaluations": 4})  # fmt: skip
    arrays = np.load(BytesIO(files("npz", [Shot("Camera", 1, there)])["Camera_0001.npz"]))
    assert np.array_equal(arrays["time"], there.rays().time)
    reason, able = choices("colmap", [Shot("Camera", 1, there)])
    assert reason.endswith("each pixel of which has its own time")
    assert {"npz", "json"} <= set(able)
    assert not {"colmap", "opencv", "ros", "stmap"} & set(able)


@pytest.mark.parametrize("name", ["perspective", "shifted", "portrait", "pinhole"])
def test_bop_projects_as_we_do(name):
    made = [Shot(view.name, view.frame, view.camera, meters=0.5) for view in shots(name)]
    images = json.loads(files("bop", made)["scene_camera.json"])
    assert list(images) == ["1", "12", "10000"]
    for image, (points, pixels) in zip(images.values(), views(name), strict=True):
        turn, move = np.reshape(image["cam_R_w2c"], (3, 3)), np.array(image["cam_t_w2c"])
        there = (points * 500.0 @ turn.T + move) @ np.reshape(image["cam_K"], (3, 3)).T  # millimeters
        assert np.abs(there[:, :2] / there[:, 2:] + 0.5 - pixels).max() < 1e-9
        assert image["depth_scale"] == 500


def test_bop_has_a_file_for_each_of_several_cameras():
    both = [*shots("perspective"), *shots("shifted")]
    assert list(files("bop", both)) == ["scene_camera_perspective.json", "scene_camera_shifted.json"]
    with pytest.raises(InputError, match="whose frame is not a whole number"):
        export_files("bop", shots("perspective", [1.5]))


@pytest.mark.parametrize("name", ["perspective", "shifted", "portrait", "radtan", "five", "scaled", "fisheye"])
def test_transforms_json_projects_as_we_do(name):
    document = json.loads(files("nerfstudio", shots(name))["transforms.json"])
    assert [frame["file_path"] for frame in document["frames"]] == [
        f"{name}_0001.png", f"{name}_0012.png", f"{name}_10000.png",
    ]  # fmt: skip
    for frame, (points, pixels) in zip(document["frames"], views(name), strict=True):
        matrix = np.array(frame["transform_matrix"]) @ np.diag([1, -1, -1, 1])  # from OpenCV's camera to the world
        seen = (points - matrix[:3, 3]) @ matrix[:3, :3]
        K = np.array([[frame["fl_x"], 0, frame["cx"]], [0, frame["fl_y"], frame["cy"]], [0, 0, 1.0]])
        still = np.zeros(3)
        if document["camera_model"] == "OPENCV_FISHEYE":
            terms = np.array([frame[f"k{i}"] for i in (1, 2, 3, 4)])
            theirs = cv2.fisheye.projectPoints(seen[:, None], still, still, K, terms)[0]
        else:
            terms = np.array([frame[term] for term in ("k1", "k2", "p1", "p2", "k3")])
            theirs = cv2.projectPoints(seen, still, still, K, terms)[0]
        assert np.abs(theirs.reshape(-1, 2) - pixels).max() < 1e-9  # whose center of the first pixel is (0.5, 0.5)


def test_transforms_json_has_one_model():
    with pytest.raises(InputError, match="'radtan' is OPENCV and 'fisheye' is OPENCV_FISHEYE: export them separately"):
        files("nerfstudio", [*shots("radtan"), *shots("fisheye")])


@pytest.mark.parametrize("name", CAMERAS)
def test_each_format_writes_or_refuses_with_those_that_can(name):
    (shot,) = shots(name, [1])
    able = {export.key for export in EXPORT_FORMATS if export.refusal(shot) is None}
    assert able >= {"npz", "json", "stmap"}
    for export in EXPORT_FORMATS:
        if export.key in able:
            assert files(export.key, [shot])
        else:
            assert choices(export.key, [shot])[1] == [other.key for other in EXPORT_FORMATS if other.key in able]


@pytest.mark.parametrize("change", ["mirrored", "sheared"])
def test_axes_that_are_no_rotation_are_refused_where_poses_are_rotations(change):
    matrix = np.array(TURNED, float)
    matrix[:3, 0] = -matrix[:3, 0] if change == "mirrored" else matrix[:3, 0] + 0.01 * matrix[:3, 1]
    shot = Shot("Camera", 1, camera("PERSP", FRAME | {"matrix_world": matrix.tolist()}))
    free = [export.key for export in EXPORT_FORMATS if not export.rigid]
    assert {"ros", "stmap", "npz", "json"} <= set(free)
    for export in EXPORT_FORMATS:
        if export.rigid:
            reason, able = choices(export.key, [shot])
            assert f"whose axes are {change}, " in reason
            assert able == free
        else:
            assert files(export.key, [shot])


def test_ros_has_every_letter_of_a_name():
    """YAML's escapes of JSON would be two halves of a letter beyond 16 bits."""
    (_, text), *_ = export_files("ros", [Shot("Cam😀", 1.0, camera("PERSP"), 1.0)])[0]
    assert 'camera_name: "Cam😀"' in text.splitlines()


def test_what_is_left_out_is_said():
    lens = {"use_dof": True, "focus_distance": 3.0, "aperture_fstop": 1.4, "aperture_blades": 0, "aperture_rotation": 0,
            "aperture_ratio": 1.0, "focus_position": None}  # fmt: skip
    shot = [Shot("Camera", frame, camera("PERSP", lens | BORDER)) for frame in (1, 2)]
    blur = "the depth of field of camera 'Camera' is not in the files"
    border = "the files are of the full frame of camera 'Camera', without its render border"
    assert export_files("ros", shot)[1] == [blur, border]
    assert export_files("npz", shot)[1] == [blur]
    assert export_files("json", shot)[1] == []
    assert export_files("bop", shot)[1] == [blur, border]


def test_pixels_without_a_ray_to_which_a_format_gives_one_are_said():
    shot = [Shot("Camera", 1, camera("FISHEYE_EQUIDISTANT", {"resolution_x": 96, "resolution_y": 96}))]
    line = "corners of the frame of camera 'Camera' have no ray, but the files' formula gives them one"
    keys = [key for key in ("colmap", "opencv", "npz", "json") if line in export_files(key, shot)[1]]
    assert keys == ["colmap", "opencv"]
    whole = [Shot("Camera", 1, camera("OPENCV_FISHEYE"))]
    assert line not in export_files("colmap", whole)[1]


@pytest.mark.parametrize("degrees", [0, 1e-7, 90, 179.9999, 180, 270])
@pytest.mark.parametrize("axis", [(1, 0, 0), (0, 0, -1), (0.6, -0.48, 0.64)])
def test_vectors_and_quaternions_of_rotations_are_exact_up_to_half_a_turn(axis, degrees):
    turn = cv2.Rodrigues(np.array(axis) * np.radians(degrees))[0]
    vector = half_turn_vector(turn)
    assert np.linalg.norm(vector) <= np.pi * (1 + 1e-15)
    assert np.abs(cv2.Rodrigues(vector)[0] - turn).max() < 1e-15 * 4
    w, x, y, z = quaternion(turn)
    assert w >= 0
    assert w * w + x * x + y * y + z * z == pytest.approx(1, abs=1e-15)


def test_the_nearest_rotation_is_nearer_than_the_matrix():
    (shot,) = shots("perspective", [1])
    near, moved = with_rotation(shot.camera)
    gram = near.pose.basis.T @ near.pose.basis
    assert np.abs(gram - np.eye(3)).max() < 4e-15
    assert 0 < np.abs(near.pose.basis - shot.camera.pose.basis).max() < 1e-7
    assert 0 < moved < 1e-4


@pytest.mark.parametrize("meters", [np.nan, np.inf, 0.0])
def test_a_unit_scale_that_is_no_length_is_refused(meters):
    view = Shot("Camera", 1, camera("PERSP"), meters=meters)
    with pytest.raises(InputError, match=f"^the scene's Unit Scale is {meters:g}: set it to a number above 0$"):
        export_files("colmap", [view])
