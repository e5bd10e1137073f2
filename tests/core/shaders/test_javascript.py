"""Rays by JavaScript: those of numpy, for every example of every model; and every operation by itself."""

import numpy as np
import pytest

from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.errors.ray_errors import world_rays
from camera_ray_caster.core.maths.recording import DOMAIN, NUMPY, look_up, loop, record
from camera_ray_caster.core.maths.recording.record import COMPARISONS, LOGICAL, NUMERIC
from camera_ray_caster.core.shaders.javascript import JavaScriptWriter

from ..cameras.model_examples import EXAMPLES, camera
from .javascript import evaluated

CASES = [(key, k) for key, examples in sorted(EXAMPLES.items()) for k in range(len(examples))]
PIXELS = 2000
TWO = {"add", "subtract", "multiply", "divide", "remainder", "power", "minimum", "maximum", "hypot", "arctan2"}


@pytest.mark.full
@pytest.mark.parametrize(("key", "example"), CASES)
def test_rays_are_those_of_numpy(key, example):
    cam = camera(key, EXAMPLES[key][example])
    generator = np.random.default_rng(example)
    x, y = (generator.uniform(0.0, side, PIXELS) for side in cam.raster.size)
    with np.errstate(all="ignore"):  # pixels without a ray
        expected = np.array([np.broadcast_to(values, x.shape) for vector in cam.camera_rays(x, y) for values in vector])
        bounds = world_rays(cam, x, y)
    values = evaluated(record(lambda x, y: [number for vector in cam.camera_rays(x, y) for number in vector], 2), x, y)
    assert np.array_equal(np.isnan(values[3]), np.isnan(expected[3]))
    for rows, error in ((slice(0, 3), bounds.origin_error), (slice(3, 6), bounds.direction_error)):
        apart = np.linalg.norm(values[rows] - expected[rows], axis=0)
        assert not (apart > 2 * error).any()  # two evaluations, each of which may have the error


def test_every_operation_can_be_written():
    assert set(JavaScriptWriter.FUNCTIONS) >= NUMERIC | COMPARISONS | LOGICAL


@pytest.mark.full
@pytest.mark.parametrize("name", sorted(NUMERIC | COMPARISONS))
def test_an_operation_is_that_of_numpy(name):
    two = name in TWO | COMPARISONS
    values = np.array([-3.5, -2.5, -1.0, -0.75, -1e-9, 0.0, 1e-9, 0.5, 1.0, 1.5, 2.5, 7.0, 123.25])
    a, b = (grid.ravel() for grid in np.meshgrid(values, values))
    function = getattr(np, name)
    arguments = (a, b) if two else (a,)
    with np.errstate(all="ignore"):
        expected = function(*arguments).astype(float)
    defined = DOMAIN.get(name, lambda *_: np.ones(a.shape, bool))(*arguments)
    (value,) = evaluated(record(lambda a, b: (1.0 * function(*(a, b)[: 1 + two]),), 2), a, b)
    assert np.allclose(value[defined], expected[defined], rtol=8 * EPS, atol=8 * EPS)


@pytest.mark.full
def test_loops_tables_and_what_is_undefined():
    table = np.array([0.0, 1.0, 4.0, 9.0])

    def formula(x, y):
        halved, count = loop(lambda a, n: ((a / 2, n + 1), a < 2.0), (x, 0.0), 50)
        below = np.searchsorted(table, y, side="right") - 1.0
        return halved, count, look_up(table, below), np.where(x > 5.0, np.nan, y)

    x, y = np.array([1.0, 3.0, 100.0]), np.array([0.0, 4.0, 8.5])
    values = evaluated(record(formula, 2), x, y)
    expected = np.array([[0.5, 0.75, 100 / 2**7], [1, 2, 7], [0.0, 4.0, 4.0], [0.0, 4.0, np.nan]])
    assert np.array_equal(values, expected, equal_nan=True)
    assert set(NUMPY) >= NUMERIC
