"""The edge of a distorted picture: what lies beyond is not searched for, and nothing that is seen lies beyond."""

import numpy as np
import pytest

from camera_ray_caster.core.cameras.parts.radial_tangential import RadialTangential

LENSES = [
    {"k1": -0.2},
    {"k1": -0.3, "k2": 0.02, "p1": 0.02, "p2": -0.03},
    {"k1": -0.05, "s1": 0.02, "s2": -1e-3, "s3": -0.03, "s4": 2e-3},
    {"k1": 0.1, "k4": 0.4, "p1": -0.1, "s1": 0.1},
]


@pytest.mark.parametrize("values", LENSES)
def test_nothing_that_is_seen_lies_beyond_the_edge(values):
    lens, rng = RadialTangential(**values), np.random.default_rng(2)
    assert lens.limit < 10
    angle, radius = rng.uniform(-np.pi, np.pi, 100_000), np.sqrt(rng.uniform(0, 1, 100_000))
    radius[::2] = 1
    u, v = lens.distort(lens.limit * radius * np.cos(angle), lens.limit * radius * np.sin(angle))
    assert lens.edge.may_hold(u, v, np.hypot(u, v)).all()


@pytest.mark.parametrize("values", LENSES)
def test_all_but_little_of_what_lies_beyond_is_known_at_once(values):
    lens, rng = RadialTangential(**values), np.random.default_rng(3)
    u, v = rng.uniform(-2, 2, (2, 3000)) * lens.farthest(lens.limit)
    has_ray, sure = ~np.isnan(lens.undistort(u, v)[0]), ~lens.edge.may_hold(u, v, np.hypot(u, v))
    assert 100 < has_ray.sum() < 2900
    assert (~has_ray & ~sure).sum() <= 3
    x, _ = lens._careful(u, v)  # which asks everywhere
    np.testing.assert_array_equal(np.isnan(x), ~has_ray)
