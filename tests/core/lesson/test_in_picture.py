"""What is drawn over a picture lies where the picture shows it: by the rays, which are no inverse of their own."""

import numpy as np
import pytest

from camera_ray_caster.core.lesson.in_picture import lines_in_picture, points_in_picture

from ..cameras.model_examples import camera

KEYS = ("PERSP", "OMNIMAX", "EQUIRECTANGULAR", "FISHEYE_EQUIDISTANT", "CROSS_SLIT", "PUSHBROOM")


def on_rays(cam, pixels, away):
    rays = cam.rays_at(pixels[:, 0], pixels[:, 1])
    return rays.origins + away * rays.directions


@pytest.mark.parametrize("key", KEYS)
def test_a_point_on_a_pixel_s_ray_is_drawn_in_that_pixel(key):
    cam = camera(key)
    width, height = cam.raster.size
    wanted = np.array([[0.5, 0.5], [0.3, 0.6], [0.62, 0.45]]) * (width, height)
    np.testing.assert_allclose(points_in_picture(cam, on_rays(cam, wanted, 3.0)), wanted, atol=1e-6)


@pytest.mark.parametrize("key", KEYS)
def test_a_line_is_drawn_through_the_pixels_whose_rays_meet_it(key):
    cam = camera(key)
    ends = np.array([[0.45, 0.5], [0.55, 0.56]]) * cam.raster.size
    a, b = on_rays(cam, ends, 4.0)
    drawn = lines_in_picture(cam, [[a, b]])
    np.testing.assert_allclose(drawn[[0, -1], [0, 1]], ends, atol=1e-6)
    np.testing.assert_allclose(drawn[1:, 0], drawn[:-1, 1])
    for pixel in drawn[:, 0]:
        rays = cam.rays_at(*pixel)
        across = np.cross(rays.directions, b - a)  # the distance of two lines
        assert abs((rays.origins - a) @ across) / np.linalg.norm(across) < 1e-6


def test_what_lies_behind_a_pinhole_or_outside_of_its_frame_is_not_drawn():
    cam = camera("PERSP", {"matrix_world": np.eye(4)})
    width, height = cam.raster.size
    assert len(points_in_picture(cam, [[0, 0, 1.0], [9, 0, -1.0], [0, 0, -1.0]])) == 1
    beside = [[5, 0, -1], [6, 0, -1]]
    drawn = lines_in_picture(cam, [[[0, 0, -1.0], [2, 0, -1.0]], [[0, 0, 1.0], [0.1, 0, 2.0]], beside])
    assert drawn[..., 0].min() == pytest.approx(width / 2)
    assert drawn[..., 0].max() == pytest.approx(width)
    np.testing.assert_allclose(drawn[..., 1], height / 2)
    along = lines_in_picture(cam, [[[0, -9, -20.0], [0, 9, -20.0]]])
    assert along[..., 1].min() == pytest.approx(0)
    assert along[..., 1].max() == pytest.approx(height)


def test_a_line_over_the_seam_of_a_panorama_does_not_cross_the_picture():
    cam = camera("EQUIRECTANGULAR", {"matrix_world": np.eye(4)})
    width, _ = cam.raster.size
    drawn = lines_in_picture(cam, [[[-1, 0, 5.0], [1, 0, 5.0]]])
    assert len(drawn) > 8
    assert (np.minimum(drawn[..., 0], width - drawn[..., 0]) < width / 8).all()
    assert np.abs(drawn[:, 1] - drawn[:, 0]).max() < width / 8
