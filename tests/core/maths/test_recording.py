"""Formulas that are recorded: every camera model, every operation, loops, look-ups, and what cannot be recorded."""

from __future__ import annotations

import math

import numpy as np
import pytest

from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.maths.panels import is_raster
from camera_ray_caster.core.maths.recording import NUMPY, NotRecordable, look_up, loop, may_hold, record, roundoff
from camera_ray_caster.core.maths.recording.record import COMPARISONS, LOGICAL, NUMERIC
from camera_ray_caster.core.maths.vector import is_grid, is_lattice, is_one

from ..cameras.model_examples import EXAMPLES, camera

ITERATED = 32 * EPS
"""Between two iterations that start elsewhere, each right to some EPS over the slope at its end; measured is 23."""

ITERATE = {"OPENCV_PINHOLE", "OPENCV_FISHEYE", "UCM", "FISHEYE624", "THIN_PRISM_FISHEYE", "FTHETA", "RADIAL_POLYNOMIAL"}

NAN, INF = float("nan"), float("inf")
NUMBERS = np.array([-2.5, -1.0, -0.5, -0.0, 0.0, 0.3, 1.0, 1.5, 2.0, NAN])
TABLE = (0.0, 0.1, 0.1, 2.0, 5.0)

each_model = pytest.mark.parametrize("key", [model.key for model in MODELS])


def evaluate(function, *inputs):
    """The one output of a function's record, in float64."""
    with np.errstate(all="ignore"):
        (value,) = record(lambda *x: [function(*x)], len(inputs)).evaluate(NUMPY, inputs)
    return value


def operations(function, count=2):
    """The names of what a record of a function with one output does."""
    return [step.operation for step in record(lambda *x: [function(*x)], count).steps]


@each_model
def test_every_model_is_recorded_and_its_record_gives_its_rays(key):
    for settings in EXAMPLES[key]:
        cam = camera(key, settings)
        six = lambda x, y: sum(map(tuple, cam.model.rays(x, y)), ())  # noqa: E731, B023
        rays = record(six, 2)
        x, y = (grid.ravel() for grid in np.meshgrid(cam.raster.columns(), cam.raster.rows()))
        with np.errstate(all="ignore"):  # an iteration goes on where there is no ray
            values = rays.evaluate(NUMPY, (x, y))
        allowed = ITERATED if any(step.operation == "loop" for step in rays.steps) else 0.0
        assert allowed == 0.0 or key in ITERATE
        for recorded, other in zip(values, six(x, y), strict=True):
            np.testing.assert_allclose(
                *np.broadcast_arrays(x, recorded, other)[1:], rtol=0, atol=allowed, equal_nan=True
            )


@pytest.mark.parametrize("name", sorted(NUMERIC | COMPARISONS | LOGICAL))
def test_an_operation_gives_what_numpy_gives(name):
    ufunc = getattr(np, name)
    inputs = [grid.ravel() for grid in np.meshgrid(*[NUMBERS] * ufunc.nin)]
    operands = [grid > 0 for grid in inputs] if name in LOGICAL else inputs
    with np.errstate(all="ignore"):
        expected = ufunc(*operands)
    np.testing.assert_array_equal(evaluate(ufunc, *operands), expected)
    assert operations(ufunc, ufunc.nin)[-1] == name


@pytest.mark.parametrize("function", [
    lambda x: 3 - x, lambda x: 2 / x, lambda x: 3 % (x + 9), lambda x: x**2, lambda x: 2**x, lambda x: -abs(x),
    lambda x: np.float64(2) * x + np.float64(1) - x * np.int64(3), lambda x: np.square(x) + np.reciprocal(x),
    lambda x: np.isnan(x) | ~np.isfinite(x), lambda x: (x > 0) & (x >= 1) | (x > 0.5) & (x != 2),
    lambda x: np.logical_or(x > 1, np.logical_not(x)), lambda x: np.clip(x, -1, 0.5), lambda x: (x > 0) + 1.0,
    lambda x: np.where(x > 0, np.sqrt(x), -x), lambda x: np.where(x > 0, x > 1, x < -1), lambda x: np.where(x, 1, 2),
    lambda x: np.ones_like(x) + np.zeros_like(x) * x, lambda x: np.broadcast_arrays(x, 1.0)[0], lambda x: +x,
    lambda x: np.searchsorted(TABLE, x) + 0.0, lambda x: np.searchsorted(TABLE, x, side="right") + 0.0,
])  # fmt: skip
def test_operators_and_functions_give_what_numpy_gives(function):
    with np.errstate(all="ignore"):
        expected = function(NUMBERS)
    np.testing.assert_array_equal(evaluate(function, NUMBERS), expected)


def test_what_is_changed_in_place_is_another_number():
    def function(x):
        y = x
        y -= 1
        y *= x
        return x - y

    assert evaluate(function, 3.0) == 3 - (3 - 1) * 3


def test_a_value_is_computed_once_and_what_nothing_needs_not_at_all():
    def function(x, y):
        np.sin(x * y)
        return np.hypot(x + y, x + y) * (x + y)

    assert operations(function) == ["input", "input", "add", "hypot", "multiply"]


def test_constants_are_exact_and_no_two_are_mistaken_for_one_another():
    values = (0.1, 0.0, -0.0, 1.0, True, INF, NAN)
    steps = record(lambda x: [np.where(x > 5, x, value) for value in values], 1).steps
    constants = [step.fixed[0] for step in steps if step.operation == "constant"]
    assert sorted(map(repr, constants)) == sorted(map(repr, (5.0, 0.1, 0.0, -0.0, 1.0, True, INF, NAN)))


def test_an_input_that_is_not_used_and_an_output_that_is_a_constant():
    assert record(lambda x, y: [y, 2.5], 2).evaluate(NUMPY, (1.0, 7.0)) == (7.0, 2.5)


def test_what_is_not_taken_does_no_harm():
    root = lambda x: np.where(x >= 0, np.sqrt(np.where(x >= 0, x, NAN)), 1 / (x - x))  # noqa: E731
    np.testing.assert_array_equal(evaluate(lambda x: np.where(x >= 0, root(x), 7.0), NUMBERS[:-1]),
                                  np.where(NUMBERS[:-1] >= 0, np.sqrt(np.abs(NUMBERS[:-1])), 7.0))  # fmt: skip


def cube_root(y):
    """By Newton's method, from 1, down to rounding."""

    def step(x, y):
        after = x - (x * x * x - y) / (3 * x * x)
        return (after, y), ~(np.abs(after - x) > 4 * roundoff(x) * np.abs(after))

    return loop(step, (1.0 + 0 * y, y), 100)[0]


def test_a_loop_is_recorded_once_and_runs_as_it_does_on_arrays():
    y = np.array([0.1, 1.0, 8.0, 1e6])
    assert cube_root(y) == pytest.approx(np.cbrt(y), rel=4 * EPS)
    np.testing.assert_array_equal(evaluate(cube_root, y), cube_root(y))
    assert evaluate(cube_root, NAN) != evaluate(cube_root, NAN)
    (step,) = (step for step in record(lambda y: [cube_root(y)], 1).steps if step.operation == "loop")
    body, most = step.fixed
    assert most == 100
    assert len(body.outputs) == 3, "two numbers and whether it is settled"
    assert [s.operation for s in body.steps].count("divide") == 1


def test_a_loop_ends_where_it_has_to():
    assert evaluate(lambda x: loop(lambda a: ((a + 1,), a < 0), (x,), 7)[0], 1.0) == 8


def test_a_state_may_hold_what_is_true_and_what_stays():
    def until(x):
        def step(a, small, limit):
            return (2 * a, a < limit / 2, limit), ~(a < limit)

        doubled, small, limit = loop(step, (1.0, True, x), 20)
        return np.where(small, -1.0, doubled) + limit

    for x in (5.0, 8.0):
        assert evaluate(until, x) == 16 + x


def test_what_no_entry_needs_may_be_left_out_and_is_recorded():
    def root(x):
        return np.sqrt(np.maximum(x, 0.0)) if may_hold(x > 0) else 0.0

    assert root(np.array([-1.0, -4.0])) == 0.0
    np.testing.assert_array_equal(root(np.array([-1.0, 4.0])), [0.0, 2.0])
    assert [evaluate(root, x) for x in (-1.0, 4.0)] == [0.0, 2.0]


@pytest.mark.parametrize("index", [0, 3.0])
def test_a_table_is_looked_up_at_a_whole_number(index):
    table = np.array(TABLE)
    assert evaluate(lambda k: look_up(table, k + 1), index) == table[int(index) + 1]
    np.testing.assert_array_equal(look_up(table, np.array([1, 3])), table[[1, 3]])
    assert np.isnan(evaluate(lambda k: look_up(table, k / 0.0), 0.0))


def outside_of_the_state(x):
    return loop(lambda a: ((a + x,), a > 5), (0 * x,), 9)[0]


@pytest.mark.parametrize(("function", "word"), [
    (lambda x: math.sin(x), "float"),
    (lambda x: float(x), "float"),
    (lambda x: [1, 2][x], "int"),
    (lambda x: np.arange(3)[x], "look_up"),
    (lambda x: 1.0 if x > 0 else 2.0, "truth"),
    (lambda x: min(x, 1.0), "truth"),
    (lambda x: x > 0 and x < 1, "truth"),
    (lambda x: np.asarray(x), "asarray"),
    (lambda x: np.array([x, 1.0]), "asarray"),
    (lambda x: np.linalg.norm(x), "norm"),
    (lambda x: np.stack((x, x)), "stack"),
    (lambda x: np.cbrt(x), "cbrt"),
    (lambda x: x // 2, "floor_divide"),
    (lambda x: np.eye(3) @ x, "matmul"),
    (lambda x: x.astype(float), "astype"),
    (lambda x: x[0], "part"),
    (lambda x: [*x], "part"),
    (lambda x: np.add.reduce(x), r"add\.reduce"),
    (lambda x: np.add(x, 1.0, where=True), "add with where"),
    (lambda x: np.clip(x, 0, 1, out=x), "clip"),
    (lambda x: np.where(x), "where"),
    (lambda x: x * np.ones(3), "multiply.*ndarray"),
    (lambda x: x * 1j, "multiply.*complex"),
    (lambda x: x + None, "add.*NoneType"),
    (lambda x: np.searchsorted([x, 1.0], x), "asarray|searchsorted"),
    (outside_of_the_state, "add of a number that is not in the loop's state"),
    (lambda x: loop(lambda a: ((a > 0,), True), (x,), 3)[0], "a loop"),
])  # fmt: skip
def test_what_cannot_be_recorded_is_named(function, word):
    with pytest.raises(NotRecordable, match=word) as caught:
        record(lambda x: [function(x)], 1)
    assert isinstance(caught.value, TypeError)
    assert "\n" not in str(caught.value)


def test_a_recorded_number_is_a_scalar():
    def function(x, y):
        assert (np.ndim(x), np.shape(x), x.ndim, x.shape) == (0, (), 0, ())
        assert not any((is_raster(x, y), is_grid(x, y), is_lattice((x, y, -1.0))))
        assert is_one((x, y, -1.0))
        return [x]

    record(function, 2)
