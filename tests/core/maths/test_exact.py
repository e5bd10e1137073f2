"""The arithmetic that keeps its rounding, the inverses and the rays, each against exact numbers."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.errors.ray_errors import world_rays
from camera_ray_caster.core.maths.exact import FLAT, invert, solve, square_less_one, total, two_product, two_sum

from ..cameras.model_examples import EXAMPLES, camera, raw_of
from ..truth import truth

RNG = np.random.default_rng(3)
NUMBERS = RNG.normal(size=(200, 2)) * 10.0 ** RNG.uniform(-40, 40, (200, 2))


def test_sums_and_products_keep_what_rounding_loses():
    a, b = NUMBERS.T
    for operation, exact in ((two_sum, Fraction.__add__), (two_product, Fraction.__mul__)):
        for row in zip(a, b, *operation(a, b), strict=True):
            left, right, high, low = map(Fraction, row)
            assert high + low == exact(left, right)


def test_a_sum_as_if_with_twice_the_digits():
    terms = [*NUMBERS[:20, 0], *-NUMBERS[:20, 0], 1e-30]
    assert total(terms)[0] == pytest.approx(1e-30, abs=1e40 * EPS**2 * 1600)


def test_solutions_and_squares_against_60_digits():
    for skew in (1e-3, 1e-8, 1e-12):
        matrix = RNG.normal(size=(3, 3))
        matrix[:, 1] = matrix[:, 0] + skew * matrix[:, 1]
        right = RNG.normal(size=3)
        high, low = solve(matrix[None], invert(matrix[None])[0], right[None], np.zeros((1, 3)))
        exact = truth.times(truth.inverse(truth.exact(matrix)), truth.exact(right))
        for h, e in zip(high[0], exact, strict=True):
            assert abs(h - e) <= EPS * abs(e) * 2
        less = truth.dot(exact, exact) - 1
        assert abs(square_less_one(high, low)[0] - less) <= 4 * EPS * abs(less) + 1e-30 * truth.dot(exact, exact)


@pytest.mark.parametrize("skew", [1.0, 1e-1, 1e-3, 1e-6, 1e-9, 1e-12])
def test_inverses_are_right_to_their_bound_row_by_row(skew):
    for _ in range(20):
        axes = RNG.normal(size=(3, 3)) @ np.diag(10.0 ** RNG.uniform(-6, 6, 3))
        axes[:, 2] = axes[:, 0] * RNG.normal() + axes[:, 1] * RNG.normal() + skew * axes[:, 2]
        with np.errstate(all="ignore"):
            (inverse,), (bound,), (skewness,) = invert(axes[None])
        if not skewness < FLAT:
            continue
        for row, exact in zip(inverse, truth.inverse(truth.exact(axes)), strict=True):
            assert truth.norm(truth.minus(truth.exact(row), exact)) <= bound * truth.norm(exact)


@pytest.mark.parametrize("key", [model.key for model in MODELS])
def test_rays_are_exact_within_their_bound(key):
    for settings in EXAMPLES[key]:
        raw, cam = raw_of(key, settings), camera(key, settings)
        height, width = cam.raster.shape
        x, y = cam.raster.columns()[0, :: max(1, width // 6)], cam.raster.rows()[:: max(1, height // 6), 0]
        x, y = np.meshgrid(x, y)
        with np.errstate(all="ignore"):
            rays = world_rays(cam, x, y)
        errors = (np.broadcast_to(e, x.shape) for e in (rays.origin_error, rays.direction_error))
        vectors = (np.stack([np.broadcast_to(c, x.shape) for c in v], -1) for v in (rays.origin, rays.direction))
        parts = list(zip(errors, vectors, strict=True))
        for pixel in np.ndindex(x.shape):
            exact = truth.ray(raw, x[pixel], y[pixel])
            if exact is None:
                assert np.isnan(parts[1][1][pixel]).any()
                continue
            origin = truth.minus(exact.origin, truth.exact(cam.pose.eye))
            for (error, vector), expected in zip(parts, (origin, exact.direction), strict=True):
                away = truth.norm(truth.minus(truth.exact(vector[pixel]), expected))
                assert away <= error[pixel]
                assert error[pixel] <= 1e-6
