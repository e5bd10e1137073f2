"""Poses of calibration files: those that a file has are the camera's, and what is left out is said."""

import json
import re
import warnings

import numpy as np
import pytest

import camera_ray_caster as crc

POSE = crc.look_at((1.0, 2.0, 3.0), (0.0, 0.0, 0.0))
LENS = """
  camera_model: pinhole
  distortion_model: radtan
  distortion_coeffs: [0.1, 0.0, 0.0, 0.0]
  intrinsics: [500.0, 500.0, 320.0, 240.0]
  resolution: [640, 480]
"""
KALIBR = f"cam0:{LENS}cam1:{LENS}  T_cn_cnm1: [[1, 0, 0, -0.12], [0, 1, 0, 0], [0, 0, 1, 0.01], [0, 0, 0, 1]]\n"


def transforms(*poses):
    frames = [{"file_path": f"view_{i:04}.png", "transform_matrix": pose} for i, pose in enumerate(poses, 1)]
    return json.dumps({"fl_x": 500, "fl_y": 500, "cx": 320, "cy": 240, "w": 640, "h": 480, "frames": frames})


def loaded(tmp_path, text, **more):
    """The camera, and what was said."""
    path = tmp_path / "lens.txt"
    path.write_text(text)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        return crc.load_calibration(path, **more), [str(warning.message) for warning in caught]


def test_the_second_camera_of_kalibr_stands_beside_the_first(tmp_path):
    """x1 = x0 - (0.12, 0, -0.01) in OpenCV's axes: the world is that of the first camera."""
    camera, messages = loaded(tmp_path, KALIBR, camera="cam1")
    np.testing.assert_allclose(camera.pose.eye, (0.12, 0.0, -0.01), atol=1e-12)
    np.testing.assert_allclose(camera.opencv_from_world[:3, 3], (-0.12, 0.0, 0.01), atol=1e-12)
    assert (messages, loaded(tmp_path, KALIBR, camera="cam0")[0].pose.eye.tolist()) == ([], [0, 0, 0])


def test_the_pose_of_a_picture_is_that_of_the_file_unless_it_is_given(tmp_path):
    rounded = POSE.round(4).tolist()
    camera, messages = loaded(tmp_path, transforms(rounded))
    np.testing.assert_allclose(camera.pose.basis, POSE[:3, :3], atol=1e-4)
    np.testing.assert_allclose(camera.pose.basis.T @ camera.pose.basis, np.eye(3), atol=1e-12)
    np.testing.assert_allclose(camera.pose.eye, (1, 2, 3))
    assert not messages
    assert loaded(tmp_path, transforms(rounded), pose=np.eye(4))[0].pose.eye.tolist() == [0, 0, 0]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (transforms(POSE.tolist(), POSE.tolist()), "the 2 poses of camera 'camera' in .* are left out: give pose="),
        (transforms(POSE.T.tolist()), "the poses in .* are left out: .*the last row"),
        (LENS.replace("\n  ", "\n") + "rotation: [0, 0, 0]\n", "may have in 'rotation' are not read: give pose="),
    ],
)
def test_poses_that_are_left_out_are_said(tmp_path, text, words):

    camera, (message,) = loaded(tmp_path, text)
    assert re.search(words, message)
    assert "\n" not in message
    assert camera.pose.eye.tolist() == [0, 0, 0]


def test_a_table_of_rays_stands_where_it_was_written(tmp_path):
    first = crc.camera("OPENCV_FISHEYE", (8, 6), POSE, fx=5.0)
    (path,) = crc.export(first, tmp_path, "npz").paths
    camera = crc.load_calibration(path)
    np.testing.assert_allclose(camera.rays().directions, first.rays().directions, atol=1e-12)
    np.testing.assert_allclose(camera.pose.eye, (1, 2, 3))


def test_a_file_without_poses_says_nothing(tmp_path):
    assert loaded(tmp_path, LENS.replace("\n  ", "\n"))[1] == []
