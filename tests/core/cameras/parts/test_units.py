"""Lengths of calibrated lenses in millimeters: Blender's own lens and sensor, and the same lens in pixels."""

import numpy as np
import pytest

from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.cameras.parts.calibration import UNIT
from camera_ray_caster.core.conventions import EPS

from ..model_examples import camera

MILLIMETERS = {"calibration_unit": "MILLIMETERS"}
SENSORS = [
    {},
    {"sensor_width": 22.3, "resolution_percentage": 37, "shift_x": 0.1, "shift_y": -0.05},
    {"sensor_height": 15.0, "sensor_fit": "VERTICAL", "resolution_x": 54, "resolution_y": 96, "shift_y": 0.2},
    {"resolution_x": 54, "resolution_y": 96, "pixel_aspect_x": 1.5},
]
BENT = {"k1": -0.05, "k2": 0.01, "p1": 2e-3, "p2": -1e-3, "s1": 1e-3, "s3": -1e-3, "unified_xi": 0.8, "fov_omega": 0.9}


def same_rays(left, right, atol=64 * EPS):
    first, second = left.rays(), right.rays()
    assert np.array_equal(first.valid, second.valid)
    assert first.valid.any()
    np.testing.assert_allclose(first.directions, second.directions, rtol=0, atol=atol)


@pytest.mark.parametrize("sensor", SENSORS)
def test_without_distortion_it_is_blender_s_perspective_camera(sensor):
    same_rays(camera("OPENCV_PINHOLE", MILLIMETERS | sensor), camera("PERSP", sensor))


@pytest.mark.parametrize("sensor", SENSORS)
def test_a_backward_polynomial_is_blender_s_own(sensor):
    """Of shifts none: panoramas of Blender count them in the frame's width and height."""
    sensor = {name: value for name, value in sensor.items() if "shift" not in name}
    blender = {"fisheye_polynomial_k1": -0.06, "fisheye_polynomial_k2": -1e-4, "fisheye_polynomial_k3": 2e-6}
    ftheta = {"ftheta_reference": "RADIUS_TO_ANGLE", "ftheta_radius_to_angle": "0 0.06 1e-4 -2e-6"}
    blender |= {"fisheye_polynomial_k0": 0.0, "fisheye_polynomial_k4": 0.0, "fisheye_fov": 2 * np.pi}
    same_rays(camera("FTHETA", MILLIMETERS | ftheta | sensor), camera("FISHEYE_LENS_POLYNOMIAL", blender | sensor))


@pytest.mark.parametrize("sensor", SENSORS[:2])
@pytest.mark.parametrize("key", [model.key for model in MODELS if UNIT in model.SETTINGS])
def test_it_is_the_lens_in_pixels_of_the_sensor_s_frame(key, sensor):
    """Of a frame of 96 x 54 pixels, whatever the percentage."""
    pixels = 96 / sensor.get("sensor_width", 36.0)
    shift = 96 * sensor.get("shift_x", 0.0), 96 * sensor.get("shift_y", 0.0)
    in_pixels = {
        "calibration_width": 96, "calibration_height": 54 if not sensor else 54 * 0.37 // 1 / (96 * 0.37 // 1) * 96,
        "cx": 47.5 - shift[0], "fx": 50 * pixels, "fy": 50 * pixels,
        "ftheta_angle_to_radius": f"0 {20 * pixels!r}", "ocam_polynomial": f"{-20 * pixels!r} 0 {0.01 / pixels!r}",
    }  # fmt: skip
    in_pixels["cy"] = in_pixels["calibration_height"] / 2 - 0.5 + shift[1]
    in_mm = {"ftheta_angle_to_radius": "0 20", "ocam_polynomial": "-20 0 0.01"}
    same_rays(camera(key, MILLIMETERS | BENT | in_mm | sensor), camera(key, BENT | sensor | in_pixels), 1e-12)


def test_the_camera_matrix_is_in_pixels_of_the_frame():
    K = camera("UCM", MILLIMETERS | {"sensor_width": 24.0, "shift_x": 0.25}).K
    np.testing.assert_allclose(K, [[200, 0, 47.5 - 24], [0, 200, 26.5], [0, 0, 1]], rtol=1e-14)


def test_a_calibration_file_is_in_pixels(tmp_path):
    path = tmp_path / "cameras.txt"
    path.write_text("1 PINHOLE 96 54 40 41 48 27\n")
    K = camera("OPENCV_PINHOLE", MILLIMETERS | {"calibration_file": str(path)}).K
    np.testing.assert_allclose(K, [[40, 0, 47.5], [0, 41, 26.5], [0, 0, 1]], rtol=1e-14)
