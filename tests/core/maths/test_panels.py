"""Polynomials in place of a function of the pixel: as right as it is, and its own values where they are not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.errors.ray_errors import world_rays
from camera_ray_caster.core.maths.chebyshev import COEFFICIENT_ROUNDING, PIECE, POINTS
from camera_ray_caster.core.maths.panels import COLUMNS, SMALLEST_SIZE, Disc, on_raster

from ..cameras.model_examples import camera, raw_of
from ..truth import truth

ONE_CORE = 1 << 18
FRAME = {"calibration_width": 96, "calibration_height": 54}
LENSES = {
    "barrel": ("OPENCV_PINHOLE", {"k1": -0.28, "k2": 0.07, "k3": 0.01}),
    "tangential": ("OPENCV_PINHOLE", {"k1": -0.2, "k2": 0.05, "p1": 4e-3, "p2": -6e-3}),
    "weak": ("OPENCV_PINHOLE", {"p1": 1e-3, "p2": -5e-4}),
    "fisheye": ("OPENCV_FISHEYE", {"k1": 0.05, "k2": 0.01, "k3": -0.003, "k4": -1e-4}),
    "polynomial": ("FISHEYE_LENS_POLYNOMIAL", {}),
}
"""Pictures that polynomials give, all or most of them."""


def smooth(x, y):
    a, b = x / 1000 - 1, y / 1000 - 0.5
    return np.sin(2 * a) * np.exp(b), np.cos(a - b)


def centers(columns, rows, left=0, low=0):
    return left + np.arange(columns)[None] + 0.5, low + np.arange(rows)[:, None] + 0.5


class Counted:
    def __init__(self, function):
        self.function, self.asked = function, 0

    def __call__(self, x, y):
        self.asked += np.broadcast(x, y).size
        return self.function(x, y)


@pytest.mark.parametrize("size", [(1920, 1080), (500, 300), (257, 145)])
@pytest.mark.parametrize("corner", [(0, 0), (37, 1001), (-500, -77)])
def test_polynomials_are_as_right_as_the_function_and_ask_it_little(size, corner):
    x, y = centers(*size, *corner)
    function = Counted(smooth)
    values = on_raster(function, x, y)
    assert function.asked < x.size * y.size / (20 if size[0] == 1920 else 10)
    assert values.shape == (2, *size[::-1])
    exact = np.stack(smooth(x, y))
    assert np.abs(values - exact).max() < 16 * EPS * np.abs(exact).max()


def test_a_pixel_has_the_same_value_in_whatever_part_of_the_picture():
    x, y = centers(700, 500)
    whole = on_raster(smooth, x, y)
    for low, high, left, right in ((0, 40, 0, 700), (100, 460, 95, 400), (143, 200, 0, 300)):
        rows, columns = slice(low, high), slice(left, right)
        alone = on_raster(smooth, x[:, columns], y[rows])
        np.testing.assert_array_equal(alone, whole[:, rows, columns])


@pytest.mark.parametrize(
    ("x", "y"),
    [
        (3.5, 7.5),
        (np.arange(999) + 0.5, np.arange(999) + 0.5),
        (np.arange(999)[None] + 0.5, np.array([[4.5]])),
        (np.arange(SMALLEST_SIZE[1] - 1)[None] + 0.5, np.arange(400)[:, None] + 0.5),
        (np.arange(999)[None] * 2.0 + 0.5, np.arange(400)[:, None] + 0.5),
        (np.arange(999)[None] + 0.25, np.arange(400)[:, None] + 0.5),
    ],
    ids=["a pixel", "a list", "a row", "a narrow window", "every other pixel", "beside the centers"],
)
def test_other_places_are_asked_each_for_itself(x, y):
    for ours, exact in zip(on_raster(smooth, x, y), smooth(x, y), strict=True):
        np.testing.assert_array_equal(ours, exact)


def test_where_polynomials_are_not_right_the_function_is_asked():
    """Beside a pole, at a kink, and where there is no value."""

    def rough(x, y):
        beyond = x * x + y * y > 2.6e6
        kink, pole = np.abs(x - 1100) / 100, 1 / np.hypot(x - 700.3, y - 420.8)
        return np.where(beyond, np.nan, kink), np.where(beyond, np.nan, pole)

    x, y = centers(1920, 1080)
    function = Counted(rough)
    ours, exact = on_raster(function, x, y), np.stack(rough(x, y))
    np.testing.assert_array_equal(np.isnan(ours), np.isnan(exact))
    assert np.nanmax(np.abs(ours - exact)) < 16 * EPS * np.nanmax(exact)
    assert 0.2 < function.asked / exact[0].size < 0.9


@pytest.mark.parametrize("middle", [(500, 400), (-90, 700), (5000, 300)], ids=["inside", "at the side", "far away"])
@pytest.mark.parametrize(("ends", "most"), [(True, 0.35), (False, 0.06)], ids=["with the picture", "never"])
def test_outside_a_disc_there_is_nothing_and_only_points_of_panels_are_asked(middle, ends, most):
    """And the panels at the rim, where the function ends there, too."""

    def offset(x, y):
        return (x - middle[0]) / 400, (y - middle[1]) / 300

    def holds(x, y):
        a, b = offset(x, y)
        return a * a + b * b <= 1

    def values(x, y):
        a, b = offset(x, y)
        return a * b, a + b

    def ending(x, y):
        return [np.where(holds(x, y), value, np.nan) for value in values(x, y)]

    x, y = centers(1000, 800)
    function = Counted(ending if ends else values)
    ours, exact = on_raster(function, x, y, Disc(middle, holds)), np.stack(list(ending(x, y)))
    largest = 2.0  # in a panel at the rim
    np.testing.assert_allclose(ours, exact, rtol=0, atol=(8 + COEFFICIENT_ROUNDING) * EPS * largest)
    assert function.asked < most * x.size * y.size


@pytest.mark.parametrize("name", LENSES)
def test_the_rays_of_a_picture_are_within_their_bounds(name):
    """Against 60 digits, all over a picture; those of the tests of all models are too small for polynomials."""
    key, lens = LENSES[name]
    changes = {"resolution_x": 700, "resolution_y": 500, **FRAME, **lens}
    raw, cam = raw_of(key, changes), camera(key, changes)
    rng = np.random.default_rng(7)
    columns, rows = rng.integers(0, 700, 40), rng.integers(0, 500, 40)
    whole = cam.camera_rays(cam.raster.columns(), cam.raster.rows())[1]
    picture = np.stack([np.broadcast_to(values, (500, 700))[rows, columns] for values in whole]).T @ cam.pose.basis.T
    x, y = columns + 0.5, rows + 0.5
    bound = world_rays(cam, x, y).direction_error
    alone = np.stack(cam.camera_rays(x, y)[1][:2])
    assert (alone != np.stack([np.broadcast_to(values, (500, 700))[rows, columns] for values in whole[:2]])).any()
    for k in range(40):
        exact = truth.ray(raw, x[k], y[k])
        error = truth.norm([truth.mpf(p) - e for p, e in zip(picture[k], exact.direction, strict=True)])
        assert error <= bound[k]


def test_a_picture_without_distortion_stays_a_row_and_a_column():
    cam = camera("OPENCV_PINHOLE", {"resolution_x": 700, "resolution_y": 500})
    cam = replace(cam, model=replace(cam.model, distortion=type(cam.model.distortion)()))
    across, up, ahead = cam.camera_rays(cam.raster.columns(), cam.raster.rows())[1]
    assert (across.shape, up.shape, ahead) == ((1, 700), (500, 1), -1.0)


def test_no_product_is_large_enough_to_wake_a_thread_of_the_linear_algebra():
    assert 3 * PIECE * COLUMNS * (POINTS + 1) <= ONE_CORE
