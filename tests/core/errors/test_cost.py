"""What error bounds cost: what follows from a shape alone is not worked out again for each of its pixels."""

from __future__ import annotations

import time

import pytest

from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.records import PLANE, SPHERE

from .extreme_cases import Case

MOST = 40
"""How many times what depth costs: measured are 10 to 15, and 160 or more where each pixel works out all of it."""


@pytest.mark.parametrize("bound", ["distance_bound", "position_bound", "normal_bound"])
def test_bounds_cost_a_small_multiple_of_depth(bound):
    balls = [(SPHERE, (2 * i - 9, i % 3 - 1, -12 - i % 4), 0.9) for i in range(10)]
    case = Case("", "", [*balls, (PLANE, (0, 0, -20), 30.0)], {"resolution_x": 1920, "resolution_y": 1080})

    def seconds(name):
        began = time.process_time()
        cast(case.camera, case.shapes, (name,), threads=1)
        return time.process_time() - began

    assert min(seconds(bound) / seconds("depth") for _ in range(4)) < MOST
