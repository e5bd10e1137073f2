"""Omnimax and the dome master: the film's table, where its picture ends, and how the dome's tilt turns it."""

import math

import numpy as np
import pytest

from .model_examples import camera

ASPECT = 1.283458


def omnimax(width, height, **settings):
    return camera("OMNIMAX", {"resolution_x": width, "resolution_y": height, **settings})


def degrees_from_ahead(direction):
    return math.degrees(math.atan2(math.hypot(direction[0], direction[1]), -direction[2]))


@pytest.mark.parametrize(
    ("radius", "degrees", "digits"), [(0.25, 20.1448, 4), (0.5, 40.2136, 4), (0.75, 61.854, 3), (1, 90.1617, 4)]
)
def test_the_angle_grows_with_the_radius_as_published(radius, degrees, digits):
    cam = omnimax(2000, 2000)
    direction = cam.rays_at(1000, 1000 + 1000 * radius).directions
    assert degrees_from_ahead(direction) == pytest.approx(degrees, abs=0.5 * 10**-digits)
    assert direction[0] == 0


def test_azimuth_is_kept():
    x, y = cam_pixels = np.array([300.0, 1400.0]), np.array([1500.0, 1100.0])
    direction = omnimax(2000, 2000).rays_at(*cam_pixels).directions
    np.testing.assert_allclose(np.arctan2(direction[:, 1], direction[:, 0]), np.arctan2(y - 1000, x - 1000), rtol=1e-14)


def test_the_bottom_of_the_film_lies_45_degrees_below_the_axis():
    # 1283458 x 1000000 has exactly the film's shape; y = 1 - 2 / aspect there
    cam = omnimax(1283458, 1000000)
    below = cam.rays_at(1283458 / 2, 0).directions
    assert degrees_from_ahead(below) == pytest.approx(44.99997, abs=1e-5)
    assert below[1] < 0
    assert cam.project(cam.pose.eye + below) == pytest.approx([1283458 / 2, 0], abs=1e-7)


@pytest.mark.parametrize(("width", "height"), [(192, 96), (120, 100), (128, 100), (100, 100), (60, 100)])
def test_the_circle_touches_top_and_sides_and_is_round(width, height):
    """In a frame wider than the film only the top, in one higher than wide only the sides."""
    cam = omnimax(width, height)
    aspect = width / height
    radius = height * min(aspect, ASPECT) / 2
    center = np.array([width / 2, height - radius if aspect > 1 else height / 2])
    rays = cam.rays()
    x, y = cam.raster.columns() - center[0], cam.raster.rows() - center[1]
    r = np.hypot(x, y) / radius
    theta = 1.411269 * r - 0.09439 * r**3 + 0.25674 * r**5
    below = np.sin(theta) * y / np.hypot(x, y) < -np.cos(theta)  # more than 45 degrees below the axis
    np.testing.assert_array_equal(rays.valid, (r <= 1) & ~below)
    angle = np.arctan2(np.hypot(rays.directions[..., 0], rays.directions[..., 1]), -rays.directions[..., 2])
    np.testing.assert_allclose(angle[rays.valid], theta[rays.valid], rtol=1e-13)


def test_the_film_shows_45_degrees_below_and_90_above_and_to_the_sides():
    """A level camera; a tilt of 23 degrees makes these the 22 below the horizon, and past the zenith."""
    seen = omnimax(385, 300).rays()
    up, level = seen.directions[..., 1], np.hypot(seen.directions[..., 0], seen.directions[..., 2])
    ahead = np.abs(seen.directions[..., 0]) < 0.01
    elevation = np.degrees(np.arctan2(up, level))[seen.valid & ahead & (seen.directions[..., 2] < 0)]
    assert elevation.min() == pytest.approx(-45, abs=0.5)
    assert elevation.max() == pytest.approx(90, abs=0.5)
    assert np.abs(seen.directions[..., 0][seen.valid]).max() == pytest.approx(1, abs=1e-4)


@pytest.mark.parametrize("key", ["OMNIMAX", "DOME_MASTER"])
@pytest.mark.parametrize("tilt", [15, 30, 60])
def test_tilt_turns_the_dome_about_the_camera_s_x_axis(key, tilt):
    angle = math.radians(tilt) * (1 if key == "OMNIMAX" else -1)  # the dome's zenith comes down to the front
    turn = np.array([[1, 0, 0], [0, math.cos(angle), -math.sin(angle)], [0, math.sin(angle), math.cos(angle)]])
    level, tilted = camera(key).rays(), camera(key, {"tilt": math.radians(tilt)}).rays()
    np.testing.assert_array_equal(level.valid, tilted.valid)
    np.testing.assert_allclose(tilted.directions, level.directions @ turn.T, rtol=0, atol=1e-15)


def test_the_dome_master_has_its_rim_on_the_horizon_and_its_front_at_the_bottom():
    cam = camera("DOME_MASTER", {"resolution_x": 64, "resolution_y": 64})
    azimuth = np.radians(np.arange(0, 360, 30))
    rim = cam.rays_at(32 + 31.999999 * np.cos(azimuth), 32 + 31.999999 * np.sin(azimuth)).directions
    assert np.abs(rim[:, 1]).max() < 1e-7
    np.testing.assert_allclose(rim[:, 0], np.cos(azimuth), atol=1e-7)
    np.testing.assert_allclose(rim[:, 2], np.sin(azimuth), atol=1e-7)
    # evenly from the zenith: a third of the radius is 30 degrees
    np.testing.assert_allclose(cam.rays_at(32, 32 - 32 / 3).directions, [0, math.sqrt(3) / 2, -0.5], atol=1e-15)
