"""The inverse of a growing function: how far it is right, and how long it takes."""

import numpy as np

from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.maths.inversion import Inverse


def test_rounding_does_not_lead_back_and_forth_between_two_numbers():
    """An array goes on until its last entry is settled, so that one such entry would cost hundreds of steps."""
    calls = 0
    k = 0.4, -0.5, 0.25, 1.2, -1.7, 0.6

    def function(x):
        nonlocal calls
        calls += 1
        s = x * x
        return x * (1 + s * (k[0] + s * (k[1] + s * (k[2] + s * (k[3] + s * (k[4] + s * k[5]))))))

    def slope(x):
        return np.polynomial.polynomial.polyval(x * x, [1, *((2 * i + 3) * term for i, term in enumerate(k))])

    inverse = Inverse(function, slope, 0.0, 1.4)
    target = np.linspace(0, float(function(1.4)), 200_001)
    calls = 0
    root = inverse(target)
    assert calls < 64  # the bits of a bracket, and some
    # the terms are up to 100 times as large as the target
    assert np.abs(function(root) - target).max() < 256 * EPS * target.max()
