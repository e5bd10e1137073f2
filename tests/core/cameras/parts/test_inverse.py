"""The numerical inverse of rays: of several pixels, of none, at rims, and of points all around."""

import numpy as np

from camera_ray_caster.core.cameras.parts.inverse import pixels_of

FRAME = 200, 100


def disc(x, y):
    """An equidistant fisheye of 180 degrees, without a ray beyond its rim."""
    a, b = (x - 100) / 50, (y - 50) / 50
    r = np.maximum(np.hypot(a, b), 1e-300)
    theta = np.where(r <= 1, r * np.pi / 2, np.nan)
    return (0.0, 0.0, 0.0), (a / r * np.sin(theta), b / r * np.sin(theta), -np.cos(theta))


def twice(x, y):
    """A pinhole that shows everything twice: on the left half, and on the right one."""
    half = np.where(x < 100, x, x - 100)
    return (0.0, 0.0, 0.0), ((half - 50) / 50, (y - 50) / 50, -1.0)


def test_of_two_pixels_the_one_nearer_to_the_middle_is_found():
    points = np.array([(0.5, 0.2, -1.0), (-0.5, 0.2, -1.0)])
    np.testing.assert_allclose(pixels_of(twice, FRAME, points), [(75, 60), (125, 60)], rtol=0, atol=1e-12)


def test_what_no_ray_meets_has_no_pixel():
    points = np.array([(0.0, 0.0, 1.0), (1.0, 0.0, 0.1), (np.nan, 0.0, -1.0), (0.0, 0.0, 0.0)])
    assert np.isnan(pixels_of(disc, FRAME, points)).all()


def test_points_at_the_rim_and_on_the_axis_are_found():
    angle = np.linspace(0, 2 * np.pi, 50)
    theta = np.pi / 2 * (1 - 1e-9)
    rim = np.stack((np.cos(angle) * np.sin(theta), np.sin(angle) * np.sin(theta), np.full(50, -np.cos(theta))), axis=1)
    pixels = pixels_of(disc, FRAME, rim)
    np.testing.assert_allclose(pixels, 50 * np.stack((2 + np.cos(angle), 1 + np.sin(angle)), 1), rtol=0, atol=1e-6)
    np.testing.assert_allclose(pixels_of(disc, FRAME, (0.0, 0.0, -3.0)), (100, 50), rtol=0, atol=1e-12)


def test_a_pixel_beyond_the_frame_is_found_where_its_ray_goes_on():
    pixels = pixels_of(lambda x, y: ((0.0, 0.0, 0.0), ((x - 100) / 50, (y - 50) / 50, -1.0)), FRAME, (6.0, 0.0, -1.0))
    np.testing.assert_allclose(pixels, (400, 50), rtol=1e-13)


def test_any_shape_of_points_and_none_at_all():
    assert pixels_of(disc, FRAME, np.zeros((0, 3))).shape == (0, 2)
    assert pixels_of(disc, FRAME, np.ones((2, 3, 4, 3))).shape == (2, 3, 4, 2)
