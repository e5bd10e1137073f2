"""Lenses under further names and forms: numbers by hand."""

import json

import numpy as np
import pytest

import camera_ray_caster as crc


def load(folder, text, name="lens.yaml", **options):
    path = folder / name
    path.write_text(text)
    return crc.load_calibration(path, **options)


def test_rectilinear_is_opencv_s_pinhole(tmp_path):
    matrix = [[700.5, 0, 310.25], [0, 702.0, 250.0], [0, 0, 1]]
    terms = {"distortion_coefficients": [0.03, -0.04, 1e-4, 2e-3, -3e-3], "distortion_model": "rectilinear"}
    text = json.dumps({"camera_matrix": matrix, **terms, "img_size": [640, 480]})
    camera = load(tmp_path, text, "lens.json")
    assert camera.raster.size == (640, 480)
    assert camera.settings["k3"] == -3e-3
    np.testing.assert_allclose(camera.K, matrix)


@pytest.mark.parametrize("form", ["Camera:\n  model: \"equirectangular\"\n  cols: 640\n  rows: 320\n",
                                  "Camera.model: equirectangular\nCamera.cols: 640\nCamera.rows: 320\n"])  # fmt: skip
def test_a_panorama_of_stella_vslam_looks_ahead_in_its_middle(tmp_path, form):
    camera = load(tmp_path, form)
    assert (camera.model.key, camera.raster.size) == ("EQUIRECTANGULAR", (640, 320))
    np.testing.assert_allclose(camera.rays_at(320.0, 160.0).directions, (0, 0, -1), atol=1e-12)


def test_ocam_s_center_may_stand_in_a_matrix(tmp_path):
    matrix = [[400, 0, 310.5, 0], [0, 400, 260.5, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    terms = [-200.0, 0.0, 1e-3, 1e-7]
    text = json.dumps({"size": [640, 512], "intrinsic": matrix, "polynomialC2W": terms, "affine": [1, 0, 0]})
    camera = load(tmp_path, text, "lens.json")
    ray = camera.rays_at(310.5 + 100 + 0.5, 512 - 260.5 - 0.5).directions
    expected = np.array((100.0, 0.0, -(200 - 1e-3 * 100**2 - 1e-7 * 100**3)))
    np.testing.assert_allclose(ray, expected / np.linalg.norm(expected), atol=1e-12)


def test_an_entry_may_have_no_space_behind_its_colon(tmp_path):
    lines = [f"Camera.{name}: {value}" for name, value in {"fx": 400.5, "fy": 401.0, "cx": 320.0, "cy": 240.0}.items()]
    camera = load(tmp_path, "\n".join(["%YAML:1.0", *lines, "Viewer.PointSize:2"]), size=(640, 480))
    assert camera.K[0, 0] == pytest.approx(400.5)


def test_cameras_of_hot3d_s_whole_data_set_have_their_places(tmp_path):
    cameras = [
        {"label": f"camera-{k}", "imageWidth": 640, "imageHeight": 480,
         "projectionModelType": "CameraModelType.FISHEYE624",
         "projectionParams": [300.5, 300.5, 320.0, 240.0, 0.01 * k, *11 * [0.0]],
         "T_Device_Camera": {"quaternion_wxyz": [1.0, 0, 0, 0], "translation_xyz": [0.1 * k, -0.2, 0.3]}}
        for k in (1, 2)
    ]  # fmt: skip
    camera = load(tmp_path, json.dumps(cameras), "camera_models.json", camera="camera-2")
    assert (camera.model.key, camera.raster.size) == ("FISHEYE624", (640, 480))
    assert camera.settings["k1"] == 0.02
    np.testing.assert_allclose(camera.pose.eye, (0.2, -0.2, 0.3))
