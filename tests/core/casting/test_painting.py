"""What is painted shape by shape is bit for bit what every pixel looks up; and it is painted where that was planned."""

from __future__ import annotations

import numpy as np
import pytest

from camera_ray_caster.core import cast as core_cast
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.casting import hits, painting, plan
from camera_ray_caster.core.records import INFINITE_PLANE, PLANE, SPHERE

from ..camera.test_pixel_time import turn
from .test_cast import camera_at, pose, random_shapes, shapes_of

PASSES = "normal", "object_index", "material_index", "shape_index"
SIZE = {"resolution_x": 400, "resolution_y": 300}
FLOOR = INFINITE_PLANE, (0, -1, 0), [[1, 0, 0], [0, 0, 1], [0, -1, 0]]
BALLS = [(SPHERE, (-1, 0, -6), 1.0), (SPHERE, (1, 0.5, -7), 1.5), (SPHERE, (0.9, 0.4, -12), 1.0)]
TURNED = [[1, 0, 0.5], [0, 1, 0], [-0.5, 0, 1]]
SCENES = {
    "balls": shapes_of(*BALLS),
    "balls before a wall": shapes_of(*BALLS, (PLANE, (0, 0, -20), 40.0)),
    "balls on a floor": shapes_of(*BALLS, FLOOR),
    "a large ball": shapes_of((SPHERE, (0, -2, -12), 4.0), *BALLS),
    "planes": shapes_of(FLOOR, (PLANE, (1, 0, -8), TURNED), (PLANE, (-1, 0, -9), 2.0)),
    "in a ball": shapes_of((SPHERE, (0, 0, 0), 30.0), *BALLS),
    "behind the camera": shapes_of((SPHERE, (0, 0, 9), 1.0)),
}


@pytest.fixture(autouse=True)
def small_pictures(monkeypatch):
    """Plan for these pictures as for ones of millions of pixels."""
    monkeypatch.setattr(plan, "SMALL_PIXELS", 100)
    monkeypatch.setattr(hits, "BLOCK_PIXELS", 1 << 13)
    monkeypatch.setattr(painting, "BLOCK_PIXELS", 3000)
    monkeypatch.setattr(core_cast, "TILE_PIXELS", (1 << 14, 1 << 15))


def looked_up(monkeypatch, *arguments, **settings):
    with monkeypatch.context() as patch:
        patch.setattr(plan, "PAINTED", -1.0)
        images = cast(*arguments, **settings)
    assert not images.plan.is_painted
    return images


def same(painted, other):
    assert painted.plan.is_painted
    for name in PASSES:
        assert painted[name].tobytes() == other[name].tobytes(), name


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize(
    "settings",
    [{}, {"clip_end": 7.5}, {"clip_end": 20.2}, {"lens": 20.0, "shift_x": 0.3}, {"type": "ORTHO", "ortho_scale": 8.0}],
)
def test_painted_or_looked_up_is_all_the_same(monkeypatch, scene, dtype, settings):
    monkeypatch.setattr(plan, "PAINTED", 9.0)
    camera = camera_at(pose(turn(0.1, 0) @ turn(-0.2, 1) @ turn(0.3), (0.3, 0.1, 0.2)), **SIZE, **settings)
    painted = cast(camera, SCENES[scene], PASSES, dtype)
    same(painted, looked_up(monkeypatch, camera, SCENES[scene], PASSES, dtype))


@pytest.mark.parametrize("seed", range(20))
def test_random_large_shapes_are_painted_alike(monkeypatch, seed):
    shapes = random_shapes(np.random.default_rng(seed), 4)
    camera = camera_at(**SIZE)
    monkeypatch.setattr(plan, "PAINTED", 9.0)
    monkeypatch.setattr(plan, "SMALL_PIXELS", 1)
    painted = cast(camera, shapes, PASSES)
    same(painted, looked_up(monkeypatch, camera, shapes, PASSES))


def test_few_large_shapes_are_not_looked_up(monkeypatch):
    def forbidden(*_):
        raise AssertionError("this was not needed")

    monkeypatch.setattr(hits.Hits, "look_up", forbidden)
    images = cast(camera_at(**SIZE), SCENES["balls before a wall"], PASSES)
    ball, wall = (images["shape_index"] == shape for shape in (0, 3))
    assert ball.sum() > 1000 < wall.sum()
    assert (images["normal"][wall] == (0, 0, 1)).all()
    towards_eye = np.array((1, 0, 6)) / np.sqrt(37)  # the ball's center is at (-1, 0, -6), so at x = 166.7, y = 150
    assert np.abs(images["normal"][150, 166] - towards_eye).max() < 0.02  # half a pixel is 0.013 on the ball


@pytest.mark.parametrize(
    "shapes", [shapes_of(*[(SPHERE, (0, 0, -4), 2.0)] * 6), shapes_of(*BALLS, (SPHERE, (0, 0, -50), 0.5))]
)
def test_many_shapes_and_small_ones_are_looked_up(shapes):
    assert not cast(camera_at(**SIZE), shapes, PASSES).plan.is_painted
