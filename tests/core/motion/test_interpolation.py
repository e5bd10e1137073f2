"""Shapes between the evaluations of an interval: what is interpolated, and what is not."""

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.motion.interpolation import TimeInterval
from camera_ray_caster.core.records import SPHERE

from ..cameras.model_examples import camera
from ..errors.extreme_cases import shapes_of

FRAMES = 1.0, 2.0, 4.0, 5.0


@pytest.mark.parametrize(("frame", "last"), [(1.0, 0), (1.5, 0), (3.0, 1), (4.0, 2), (4.5, 2), (5.0, 3)])
def test_places_are_interpolated_and_the_rest_is_of_the_last_evaluation(frame, last):
    still, states = camera("PERSP"), {}
    for number, at in enumerate(FRAMES):
        ball = shapes_of([(SPHERE, (at, 0, -5), 1.0)])
        looks = {"object_index": np.array([number], np.int32), "color": np.full((1, 4), number / 4, np.float32)}
        states[at] = still, replace(ball, **looks)
    found = TimeInterval.of(states, FRAMES).shapes_at(frame)
    np.testing.assert_allclose(found.center, [[frame, 0, -5]], rtol=1e-15)
    assert found.object_index == [last]
    assert (found.color == last / 4).all()
