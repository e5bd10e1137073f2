"""The bounds of a shader's rays hold for float32 itself: formulas evaluated in numpy's float32."""

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.conventions import EPS32
from camera_ray_caster.core.maths.recording import NUMPY, record
from camera_ray_caster.core.shaders.camera_shader import ray_record
from camera_ray_caster.core.shaders.rounding import Rounded, rounded
from camera_ray_caster.core.shaders.shader_accuracy import ray_bounds

from ..cameras.model_examples import EXAMPLES, camera

CASES = [pytest.param(model.key, example) for model in MODELS for example in EXAMPLES[model.key]]
FLOAT32 = NUMPY | {
    "constant": lambda value: value if isinstance(value, bool) else np.float32(value),
    "parameter": lambda value, name: np.float32(value),
    "roundoff": lambda: np.float32(EPS32),
    "take": lambda index, table: NUMPY["take"](index, np.float32(table)).astype(np.float32),
    "searchsorted": lambda number, table, side: np.searchsorted(table, number, side).astype(np.float32),
}


@pytest.mark.parametrize(("key", "settings"), CASES)
def test_float32_stays_within_the_bound(key, settings):
    cam = replace(camera(key, settings), aperture=None)
    frame = np.float32(cam.model.size)
    x, y = (np.float32(np.random.default_rng(0).uniform(0, side, 200)) for side in frame)
    bounds = ray_bounds(cam, x.astype(float), y.astype(float), (0.0, 0.0))
    with np.errstate(all="ignore"):
        in_float32 = ray_record(cam).evaluate(FLOAT32, (x, y, np.float32(0), np.float32(0)))
    direction = np.stack(np.broadcast_arrays(*in_float32[3:], x)[:3], axis=-1) @ cam.pose.basis.T
    rays = cam.rays_at(x.astype(float), y.astype(float))
    unit = direction / np.linalg.norm(direction, axis=-1, keepdims=True)
    decided = ~np.isinf(bounds.direction)
    assert np.array_equal(np.isnan(unit[decided, 0]), ~rays.valid[decided])
    off = np.linalg.norm(unit - rays.directions, axis=-1)[decided & rays.valid]
    assert (off <= bounds.direction[decided & rays.valid]).all()
    assert decided.mean() > 0.9


def test_a_sum_that_cancels_has_the_error_of_its_parts():
    (result,) = rounded(record(lambda x: (x - 1000.0,), 1), [Rounded(np.array([1000.25]), 0.0)])
    assert result.value == 0.25
    assert 1000 * EPS32 <= result.error[0] <= 1001 * EPS32


def test_a_root_at_the_end_of_its_range_may_be_none():
    (result,) = rounded(record(lambda x: (np.sqrt(1.0 - x),), 1), [Rounded(np.array([0.5, 1 - 1e-9, 2.0]), 0.0)])
    assert np.isnan(result.value[2])
    assert result.error[0] < 8 * EPS32
    assert np.isinf(result.error[1])
    assert result.error[2] == 0  # it is none for sure


def test_a_branch_that_is_undecided_counts_with_both():
    formula = record(lambda x: (np.where(x < 1.0, 3.0, 5.0), np.where(x < 1.0, x, np.nan)), 1)
    step, end = rounded(formula, [Rounded(np.array([0.5, 1.0]), 1e-6)])
    assert step.error.tolist() == [pytest.approx(0, abs=1e-6), 2.0]
    assert end.error[0] < 2e-6
    assert np.isinf(end.error[1])
