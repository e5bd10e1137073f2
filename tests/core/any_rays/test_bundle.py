"""Rays that begin near each other: a bundle gives the hits of a tree, to the bit."""

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.any_rays import body_search

from .test_brute_force import BALL, VERTICES
from .test_cast_rays import PASSES, scene

SHAPES = crc.join(BALL, scene())
RANDOM = np.random.default_rng(8)
ALL_AROUND = RANDOM.normal(size=(3000, 3))
EYE = np.array((0.2, 0.1, -0.1))
CUBE = np.stack(np.meshgrid(*3 * [(-1.0, 0.0, 1.0)]), axis=-1).reshape(-1, 3)

RAYS = {
    "one point": (EYE, ALL_AROUND),
    "points 2 cm apart": (EYE + RANDOM.uniform(-0.01, 0.01, ALL_AROUND.shape), ALL_AROUND),
    "vertices": (EYE, VERTICES - EYE),
    "from a vertex": (VERTICES[5].astype(float), ALL_AROUND),
    "edges of the cube": (EYE, np.tile(CUBE[np.abs(CUBE).any(axis=1)], (40, 1))),
    "parallel": (EYE + RANDOM.uniform(-0.02, 0.02, ALL_AROUND.shape), np.broadcast_to((1.0, 0.3, -1.0), (3000, 3))),
    "in a plane": (EYE, ALL_AROUND * (1, 1, 0)),
    "narrow": ((4.0, -9.0, 3.0), 0.02 * ALL_AROUND - (4.0, -9.0, 3.0)),
    "far away": ((4e7, -9e7, 3e7), ALL_AROUND - (4e7, -9e7, 3e7)),
    "of all lengths": (EYE, ALL_AROUND * 10 ** RANDOM.uniform(-90, 90, (3000, 1))),
    "not all": (EYE, np.where(ALL_AROUND[:, :1] > 0, ALL_AROUND, np.nan)),
}


@pytest.fixture
def bundles(monkeypatch):
    """The bundles of casts, in order, of any number of rays and pairs."""
    made, make = [], body_search.bundle_of
    monkeypatch.setattr(body_search, "BUNDLED", 1e-9)
    monkeypatch.setattr(body_search, "bundle_of", lambda *arguments: made.append(make(*arguments)) or made[-1])
    return made


@pytest.mark.parametrize("rays", RAYS)
def test_a_bundle_gives_the_hits_of_a_tree(bundles, monkeypatch, rays):
    monkeypatch.setattr("camera_ray_caster.core.any_rays.bundle.MOST_PAIRS", 10_000)
    origin, direction = RAYS[rays]

    def hits():
        nearest = crc.cast_rays(origin, direction, SHAPES, passes=PASSES)
        between = crc.cast_rays(origin, direction, SHAPES, passes=PASSES, near=0.5, far=4.0, all_hits=True)
        return {**nearest, **{f"all {name}": values for name, values in between.items()}}

    by_bundle = hits()
    assert [bundle is not None for bundle in bundles] == [True, True]
    monkeypatch.setattr(body_search, "BUNDLED", np.inf)
    by_tree = hits()
    assert len(bundles) == 2
    assert np.count_nonzero(by_tree["shape_index"] == 0) > 200
    for name, values in by_tree.items():
        assert values.tobytes() == by_bundle[name].tobytes(), name


def test_rays_that_begin_far_apart_are_left_to_a_tree(bundles):
    origin = np.random.default_rng(1).uniform(-3, 3, ALL_AROUND.shape)
    crc.cast_rays(origin, ALL_AROUND, SHAPES)
    assert bundles == [None]


def test_rays_that_begin_in_a_flat_mesh_hit_it_at_once(bundles, monkeypatch):
    monkeypatch.setattr("camera_ray_caster.core.any_rays.bundle.MOST_PAIRS", 10_000)
    grid = np.array([(x, y, 0.0) for y in range(-4, 5) for x in range(-4, 5)])
    corner = np.array([9 * row + column for row in range(8) for column in range(8)])
    quads = crc.mesh(grid, np.stack((corner, corner + 1, corner + 10, corner + 9), axis=1))
    across = np.abs(ALL_AROUND[:, 2]) > 0.1
    depth = crc.cast_rays((0.25, 0.5, 0.0), ALL_AROUND[across], quads, passes=("depth",))["depth"]
    assert bundles[-1] is not None
    np.testing.assert_array_equal(depth, 0.0)
