"""The descent of a tree in float32: the hits of float64, to the bit, and float64 where float32 would not tell."""

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.any_rays import body_search, traversal
from camera_ray_caster.core.any_rays.body_search import search_of

from .test_brute_force import VERTICES
from .test_bundle import ALL_AROUND, RANDOM, RAYS, SHAPES
from .test_cast_rays import PASSES

ANYWHERE = {
    "random": (RANDOM.uniform(-4, 4, ALL_AROUND.shape), ALL_AROUND),
    "between vertices": (np.roll(VERTICES, 1, axis=0), VERTICES - np.roll(VERTICES, 1, axis=0)),
    "along axes from vertices": (np.repeat(VERTICES, 3, axis=0), np.tile(np.eye(3), (len(VERTICES), 1))),
    "on the floor": (RANDOM.uniform(-4, 4, ALL_AROUND.shape) * (1, 1, 0) - (0, 0, 2), ALL_AROUND * (1, 1, 0)),
}


@pytest.fixture
def by_tree(monkeypatch):
    monkeypatch.setattr(body_search, "BUNDLED", np.inf)


@pytest.mark.parametrize("rays", RAYS | ANYWHERE)
def test_float32_gives_the_hits_of_float64(by_tree, monkeypatch, rays):
    origin, direction = (RAYS | ANYWHERE)[rays]

    def hits():
        nearest = crc.cast_rays(origin, direction, SHAPES, passes=PASSES)
        between = crc.cast_rays(origin, direction, SHAPES, passes=PASSES, near=0.5, far=4.0, all_hits=True)
        return {**nearest, **{f"all {name}": values for name, values in between.items()}}

    single = hits()
    monkeypatch.setattr(traversal, "FAR", -1.0)
    for name, values in hits().items():
        assert values.tobytes() == single[name].tobytes(), name


def test_small_boxes_far_from_each_other_are_tested_in_float64(by_tree):
    wide = crc.join(SHAPES, crc.spheres([[1e9, 0, 0]], 1.0))
    trees = [search_of(shapes)._tree for shapes in (SHAPES, wide)]
    assert [tree.near_faces is not None for tree in trees] == [True, False]
    some, same = (
        crc.cast_rays(*ANYWHERE["random"], shapes, passes=("depth", "shape_index", "face_index"))
        for shapes in (SHAPES, wide)
    )
    for name, values in some.items():
        assert values.tobytes() == same[name].tobytes(), name
