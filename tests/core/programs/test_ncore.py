"""NCore's sensors: their pixels and poses, by hand from its documentation's formulas."""

import json

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.records import InputError

POINT = np.array([0.3, -0.2, 1.0])
"""x right, y down, z ahead."""
POSE = [[0, 0, 1, 1], [-1, 0, 0, 2], [0, -1, 0, 3], [0, 0, 0, 1]]


def sensor(kind, **intrinsics):
    return {"camera_model_type": kind, "resolution": [640, 480], "T_sensor_rig": POSE,
            "intrinsics": {"principal_point": [322.5, 239.0], **intrinsics}}  # fmt: skip


FISHEYE = sensor("opencv-fisheye", focal_length=[305.0, 304.0], radial_coeffs=[-0.02, 0.004, 0, 0])
PINHOLE = sensor("opencv-pinhole", focal_length=[500.0, 510.0], radial_coeffs=[-0.1, 0.02, 0, 0, 0, 0],
                 tangential_coeffs=[0.001, -0.002], thin_prism_coeffs=[0] * 4)  # fmt: skip
FTHETA = sensor("ftheta", reference_poly="2", angle_to_pixeldist_poly=[0, 300.0, 0, 2.0, 0, 0],
                pixeldist_to_angle_poly=[0, 1 / 300, 0, 0, 0, 0], max_angle_rad=1.2, linear_cde=[1, 0, 0])  # fmt: skip


def of_fisheye(x, y, z):
    angle = np.arctan2(np.hypot(x, y), z)
    gain = angle * (1 - 0.02 * angle**2 + 0.004 * angle**4) / np.hypot(x, y)
    return 305 * gain * x + 322.5, 304 * gain * y + 239


def of_pinhole(x, y, z):
    square = x * x + y * y
    gain = 1 - 0.1 * square + 0.02 * square**2
    return (500 * (gain * x + 2 * 0.001 * x * y - 0.002 * (square + 2 * x * x)) + 322.5,
            510 * (gain * y + 0.001 * (square + 2 * y * y) - 2 * 0.002 * x * y) + 239)  # fmt: skip


def of_ftheta(x, y, z):
    angle = np.arctan2(np.hypot(x, y), z)
    gain = (300 * angle + 2 * angle**3) / np.hypot(x, y)
    return gain * x + 323, gain * y + 239.5  # the first pixel's center is (0, 0)


def test_pixels_and_poses(tmp_path):
    file = tmp_path / "sensors.json"
    file.write_text(json.dumps({"fisheye": FISHEYE, "pinhole": PINHOLE, "ftheta": FTHETA}))
    rig = crc.load_rig(file)
    for name, pixel in {"fisheye": of_fisheye, "pinhole": of_pinhole, "ftheta": of_ftheta}.items():
        x, y = pixel(*POINT)
        world = np.array(POSE, float)[:3, :3] @ POINT + (1, 2, 3)
        np.testing.assert_allclose(rig[name].project(world[None]), [[x, 480 - y]], atol=1e-9)


@pytest.mark.parametrize(
    ("change", "line"),
    [
        ({"camera_model_type": "mei"}, "camera_model_type of front .*mei.*: it must be one of"),
        ({"intrinsics": {"focal_length": [1, 1]}}, "it has no principal_point of front"),
        ({"T_sensor_rig": [1, 2]}, "T_sensor_rig of front has 2 numbers"),
    ],
)
def test_what_is_wrong_is_told(tmp_path, change, line):
    file = tmp_path / "sensors.json"
    file.write_text(json.dumps({"front": FISHEYE | change}))
    with pytest.raises(InputError, match=line):
        crc.load_rig(file)
