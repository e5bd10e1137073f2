"""The order in which a sensor is read, with every calibrated lens: when each pixel is cast, and where the camera is."""

from dataclasses import replace
from itertools import cycle

import numpy as np
import pytest

from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.motion.evaluations import resolve

from ..cameras.model_examples import raw_of
from .test_pixel_time import shapes

WIDTH, HEIGHT = 24, 18
SHUTTER = {
    "time_mode": "ROLLING_SHUTTER", "time_tolerance": 0.01, "time_evaluations": 256, "frame": 5.0,
    "motion_blur_position": "START", "motion_blur_shutter": 2.0, "rolling_shutter_duration": 0.25,
    "resolution_x": WIDTH, "resolution_y": HEIGHT, "calibration_width": WIDTH, "calibration_height": HEIGHT,
    "cx": 11.0, "cy": 8.5, "fx": 20.0, "fy": 21.0, "ftheta_angle_to_radius": "0 20", "ocam_polynomial": "-20",
}  # fmt: skip
READ = {
    "TOP_TO_BOTTOM": np.broadcast_to((HEIGHT - np.arange(HEIGHT))[:, None] / HEIGHT, (HEIGHT, WIDTH)),
    "BOTTOM_TO_TOP": np.broadcast_to((np.arange(HEIGHT) + 1)[:, None] / HEIGHT, (HEIGHT, WIDTH)),
    "LEFT_TO_RIGHT": np.broadcast_to((np.arange(WIDTH) + 1) / WIDTH, (HEIGHT, WIDTH)),
    "RIGHT_TO_LEFT": np.broadcast_to((WIDTH - np.arange(WIDTH)) / WIDTH, (HEIGHT, WIDTH)),
}
"""Which part of the rows or columns has been read with a pixel's own."""


def moving(key, readout, frame=5.0):
    """A camera that moves by 0.1 a frame along x, and by -0.2 along z."""
    record = raw_of(key, SHUTTER | {"readout": readout})
    matrix = np.eye(4)
    matrix[[0, 2], 3] = 0.1 * frame, -0.2 * frame
    return camera_from(replace(record, matrix_world=matrix))


CALIBRATED = [model.key for model in MODELS if model.group == "Calibrated"]


@pytest.mark.parametrize(("key", "readout"), [*zip(CALIBRATED, cycle(READ), strict=False)])
def test_each_ray_is_cast_at_its_pixel_s_time_from_where_the_camera_is_then(key, readout):
    still = moving(key, readout)
    first, last = still.pixel_time.first, still.pixel_time.last
    motion = resolve(lambda frame: (moving(key, readout, frame), shapes(((0, 0, -9), 1.0))), first, last, 0.01, 256)
    cam = replace(still, motion=motion)
    rays, time = cam.rays(), 5 + 2 * (0.75 * READ[readout] + 0.25 / 2)
    np.testing.assert_allclose(rays.time, time, rtol=8 * EPS)
    expected = np.stack((0.1 * time, 0 * time, -0.2 * time), axis=-1)
    np.testing.assert_allclose(rays.origins, expected, rtol=0, atol=1e-12)
    plain = replace(still, pixel_time=None).rays()
    assert np.array_equal(rays.valid, plain.valid)
    np.testing.assert_allclose(rays.directions, plain.directions, rtol=0, atol=8 * EPS)
    at = (HEIGHT // 2, WIDTH // 2), (3, 7), (HEIGHT - 2, WIDTH - 3)
    points = np.array([rays.origins[k] + 7 * rays.directions[k] for k in at])
    np.testing.assert_allclose(cam.project(points), [(i + 0.5, j + 0.5) for j, i in at], rtol=0, atol=1e-9)
