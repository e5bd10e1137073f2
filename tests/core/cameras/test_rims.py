"""Where a round picture ends: a pixel has a ray there exactly where points on that ray have a pixel."""

import numpy as np
import pytest

from camera_ray_caster.core.cameras import MODELS

from .model_examples import EXAMPLES, IDENTITY, camera


@pytest.mark.parametrize("size", [(1, 3000), (3000, 1), (7, 900), (101, 53)])
@pytest.mark.parametrize("key", [model.key for model in MODELS])
def test_a_point_on_any_ray_of_a_picture_has_a_pixel(key, size):
    """Pictures of one column or row put pixels on the very rim."""
    frame = {"resolution_x": size[0], "resolution_y": size[1], "resolution_percentage": 100, "use_border": False}
    for settings in EXAMPLES.get(key, [{}]):
        cam = camera(key, settings | frame)
        rays = cam.rays()
        for distance in (0.1, 50.0):
            points = (rays.origins + distance * rays.directions)[rays.valid]
            assert not np.isnan(cam.project(points)).any()


@pytest.mark.parametrize("fov", [0.5, 2.0, np.pi])
@pytest.mark.parametrize("key", ["FISHEYE_ORTHOGRAPHIC", "FISHEYE_STEREOGRAPHIC", "DOME_MASTER"])
def test_beyond_the_rim_there_is_neither_ray_nor_pixel(key, fov):
    cam = camera(key, {"fov": fov, "resolution_x": 300, "resolution_y": 300, "matrix_world": IDENTITY})
    angle = np.linspace(0, 2 * np.pi, 40)
    for theta, seen in ((fov / 2 * (1 - 1e-6), True), (fov / 2 + 1e-6, False)):
        flat = np.stack((np.sin(theta) * np.cos(angle), np.sin(theta) * np.sin(angle), np.full(40, -np.cos(theta))))
        points = flat[[0, 2, 1]] * ((1,), (-1,), (1,)) if key == "DOME_MASTER" else flat
        assert (np.isnan(cam.project(points.T)).any(axis=1) != seen).all()


def test_a_measured_fisheye_projects_beyond_the_frame():
    """theta = r: 41 degrees, 0.7156 mm up, lie 715.6 pixels above the middle, where the corner is at 707.1."""
    settings = {"sensor_width": 1.0, "resolution_x": 1000, "resolution_y": 1000, "fisheye_fov": np.pi}
    cam = camera("FISHEYE_LENS_POLYNOMIAL", {**settings, "fisheye_polynomial_k1": -1.0})
    angles = np.radians([40.5, 41.0, 60.0, 89.999])
    pixels = cam.project(np.stack((0 * angles, np.sin(angles), -np.cos(angles)), axis=-1))
    np.testing.assert_allclose(pixels, np.stack((500 + 0 * angles, 500 + 1000 * angles), axis=-1), rtol=1e-12)
    np.testing.assert_allclose(pixels[:2, 1], (1206.9, 1215.6), atol=0.05)
    assert np.isnan(cam.project((0, 1, 0.01))).all()  # beyond 90 degrees there is no ray
