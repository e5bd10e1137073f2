"""Shapes between the evaluations of an interval: what is interpolated, and what is not."""

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.motion.interpolation import TimeInterval
from camera_ray_caster.core.records import SPHERE, Lights, Slots

from ..cameras.model_examples import camera
from ..errors.extreme_cases import shapes_of
from ..shapes.meshes import grid
from ..shapes.meshes import shapes_of as mesh_shapes

FRAMES = 1.0, 2.0, 4.0, 5.0


@pytest.mark.parametrize(("frame", "last"), [(1.0, 0), (1.5, 0), (3.0, 1), (4.0, 2), (4.5, 2), (5.0, 3)])
def test_places_are_interpolated_and_where_indices_differ_the_rest_is_of_the_last_evaluation(frame, last):
    still, states = camera("PERSP"), {}
    for number, at in enumerate(FRAMES):
        ball = shapes_of([(SPHERE, (at, 0, -5), 1.0)])
        looks = {"object_index": np.array([number], np.int32), "color": np.full((1, 4), number / 4, np.float32)}
        states[at] = still, replace(ball, **looks)
    between = TimeInterval.of(states, FRAMES).shapes_at(frame)
    np.testing.assert_allclose(between.center, [[frame, 0, -5]], rtol=1e-15)
    assert between.object_index == [last]
    assert (between.color == last / 4).all()


@pytest.mark.parametrize("frame", [1.0, 1.5, 3.25, 5.0])
def test_colors_lights_and_maps_are_interpolated(frame):
    still, states = camera("PERSP"), {}
    for at in FRAMES:
        sheet = grid(1, 1, lambda u, v: (u, v, 0 * u))
        uv = np.float32([[at, -at]]).repeat(6, axis=0)
        mesh = replace(sheet, loops=np.arange(6, dtype=np.int32).reshape(3, 2), uv=uv)
        shapes = mesh_shapes((mesh, (0, 0, -5), 1.0))
        states[at] = still, replace(
            shapes, color=np.full((1, 4), 0.1 * at, np.float32), world_color=(0.2 * at, 0.0, 0.5, 1.0),
            slots=Slots(np.array([0]), np.array([7], np.int32), np.full((1, 4), 0.05 * at, np.float32)),
            lights=Lights(np.array([[at, 0.0, 0.0]]), np.array([False]), np.array([[10 * at, 0.0, 1.0]])),
        )  # fmt: skip
    between = TimeInterval.of(states, FRAMES).shapes_at(frame)
    near = {"rtol": 1e-6}
    np.testing.assert_allclose(between.color, np.full((1, 4), 0.1 * frame), **near)
    np.testing.assert_allclose(between.slots.color, np.full((1, 4), 0.05 * frame), **near)
    np.testing.assert_allclose(between.world_color, (0.2 * frame, 0.0, 0.5, 1.0), **near)
    np.testing.assert_allclose(between.lights.position, [[frame, 0, 0]], **near)
    np.testing.assert_allclose(between.lights.color, [[10 * frame, 0, 1]], **near)
    np.testing.assert_allclose(between.meshes[0].uv, [[frame, -frame]] * 6, **near)
