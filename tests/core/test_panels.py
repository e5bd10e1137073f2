"""Polynomials in place of a function: as right as it is, or not given; against the function itself, pixel by pixel."""

from __future__ import annotations

import numpy as np
import pytest

from camera_ray_caster.core.cameras.panels import COLUMNS, POINTS, ROWS, on_grid
from camera_ray_caster.core.conventions import EPS

NOISE = 4 * EPS
ONE_CORE = 1 << 18


def smooth(x, y):
    return np.sin(2 * x) * np.exp(y), np.cos(x - y)


def grid(columns, rows):
    return np.linspace(-1, 1, columns)[None], np.linspace(-0.6, 0.6, rows)[:, None]


@pytest.mark.parametrize("size", [(1920, 1080), (500, 300), (97, 145), (1, 400), (400, 1)])
def test_the_polynomials_are_as_right_as_the_function(size):
    x, y = grid(*size)
    found, exact = on_grid(smooth, x, y, NOISE), np.stack(smooth(*np.broadcast_arrays(x, y)))
    assert found.shape == (2, *size[::-1])
    assert np.abs(found - exact).max() < 8 * np.exp(0.6) * EPS + 4 * NOISE


def test_places_that_do_not_stand_evenly_are_as_right():
    rng = np.random.default_rng(1)
    x, y = np.sort(rng.uniform(-1, 1, (1, 700))), rng.uniform(-0.6, 0.6, (200, 1))
    assert np.abs(on_grid(smooth, x, y, NOISE) - smooth(x, y)).max() < 8 * np.exp(0.6) * EPS + 4 * NOISE


def test_what_is_not_known_to_be_right_is_not_given():
    """Beside a pole, and where the function has no value."""

    def pole(x, y):
        return np.where(y > 0.5, np.nan, x), 1 / np.hypot(x - 0.3, y + 0.1)

    x, y = grid(1920, 1080)
    found, exact = on_grid(pole, x, y, NOISE), np.stack(pole(*np.broadcast_arrays(x, y)))
    known = ~np.isnan(found[1])
    assert 0.2 < known.mean() < 0.95
    assert np.abs(found - exact)[:, known].max() < 1e-13  # of values up to 10
    assert not known[(np.hypot(x - 0.3, y + 0.1) < 0.02) | (y > 0.5)].any()
    assert (np.isnan(found[0]) == ~known).all()


def test_the_function_is_asked_at_few_points_and_at_more_only_where_few_do_not_suffice():
    asked = []

    def counted(x, y, function=smooth):
        asked.append(x.size)
        return function(x, y)

    x, y = grid(1920, 1080)
    few, more = (20 * points**2 for points in POINTS)  # in each of 8 rows of 20 panels
    on_grid(lambda x, y: counted(x, y, lambda x, y: (x * x * y, y**3)), x, y, NOISE)
    assert asked == [few] * 8
    asked.clear()
    on_grid(lambda x, y: counted(x, y, lambda x, y: (np.sin(40 * x), y)), x, y, NOISE)
    assert asked == [few, more] * 8
    assert sum(asked) < x.size * y.size / 25


def test_no_product_is_large_enough_to_wake_a_thread_of_the_linear_algebra():
    assert ROWS * COLUMNS * max(POINTS) <= ONE_CORE
