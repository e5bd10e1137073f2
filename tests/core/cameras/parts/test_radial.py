"""The parts that radial lenses share."""

import numpy as np
import pytest
from mpmath import mp

from camera_ray_caster.core.cameras.parts.radial import factors_of
from camera_ray_caster.core.conventions import gamma


@pytest.mark.parametrize("around", [0.0, np.pi / 2, np.pi, 2 * np.pi, 3 * np.pi])
@pytest.mark.parametrize("width", [1e-8, 1e-3, 1.0])
def test_sine_and_cosine_of_angles_are_those_of_50_digits_within_their_bound(around, width):
    theta = np.maximum(np.abs(around + np.linspace(-width, width, 301)), 1e-300)
    factors = factors_of(theta, theta)
    with mp.workdps(50):
        for angle, over_theta, along in zip(*(values.tolist() for values in (theta, *factors)), strict=True):
            sine = mp.sin(angle) / angle
            assert abs(over_theta - sine) <= gamma(10) * abs(sine)
            assert abs(along - mp.cos(angle)) <= gamma(8)
