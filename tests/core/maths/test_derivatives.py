"""Records that are differentiated: every operation, branches, loops and look-ups, against 60 digits and by hand."""

from __future__ import annotations

import numpy as np
import pytest
from mpmath import mp, mpf

from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.maths.inversion import Inverse
from camera_ray_caster.core.maths.recording import NUMPY, differentiate, look_up, loop, record, roundoff, stop_gradient
from camera_ray_caster.core.maths.recording.record import COMPARISONS, NUMERIC
from camera_ray_caster.core.maths.recording.varied import Varied

from ..truth.recorded import MPMATH

STEP = mpf(10) ** -20
ROUNDED = 8 * EPS
"""Of a derivative: a few operations, and those of numpy's functions."""

INPUTS = {
    "power": ((0.3, 2.5), (3.0, -1.25)), "arcsin": ((-0.9,), (0.2,)), "arccos": ((-0.9,), (0.2,)),
    "sqrt": ((1e-8,), (7.0,)), "log": ((1e-8,), (7.0,)), "log1p": ((-0.9,), (7.0,)), "expm1": ((-40.0,), (3.0,)),
    "tanh": ((-12.0,), (0.2,)), "cosh": ((-3.0,), (1e-9,)),
}  # fmt: skip
"""Where operations are asked that are not defined, or hard, elsewhere; others at these:"""
ANY = {1: ((-2.3,), (0.7,), (1e-9,)), 2: ((-2.3, 0.7), (0.7, -2.5), (3.25, 4.5))}


def partials(function, *inputs):
    """The partial derivatives of a function's one output, 0 where they are none."""
    its_record = record(lambda *x: [function(*x)], len(inputs))
    (dual,) = differentiate(its_record, inputs)
    np.testing.assert_array_equal(dual.value, its_record.evaluate(NUMPY, inputs)[0])
    return [0.0 if partial is None else partial for partial in dual.partials]


@pytest.mark.parametrize("name", sorted(NUMERIC | COMPARISONS))
def test_an_operation_has_the_slopes_that_differences_of_sixty_digits_have(name):
    ufunc = getattr(np, name)
    exact = MPMATH[name]
    for inputs in INPUTS.get(name, ANY[ufunc.nin]):
        for k, partial in enumerate(partials(ufunc, *inputs)):
            with mp.workdps(60):
                ahead, behind = (
                    exact(*(mpf(value) + (side * STEP if k == i else 0) for i, value in enumerate(inputs)))
                    for side in (1, -1)
                )
                slope = (mpf(ahead) - mpf(behind)) / (2 * STEP)
                assert abs(mpf(float(partial)) - slope) <= ROUNDED * abs(slope) + STEP


def test_derivatives_by_several_numbers_follow_the_chain_rule_and_broadcast():
    x, y = np.array([[0.2, 1.5]]), np.array([[0.7], [-0.3], [2.0]])
    by_x, by_y = partials(lambda x, y: np.sin(x * y) + x * x - 3, x, y)
    np.testing.assert_allclose(by_x, y * np.cos(x * y) + 2 * x, rtol=ROUNDED)
    np.testing.assert_allclose(by_y, x * np.cos(x * y), rtol=ROUNDED)


def test_what_is_known_to_be_0_costs_nothing():
    constant, of_y, both = differentiate(record(lambda x, y: [2.5, np.exp(y), x + y], 2), (np.ones(3), np.ones(3)))
    assert constant.partials == (None, None)
    assert of_y.partials[0] is None
    assert both.partials == (1.0, 1.0)


def test_what_is_taken_has_its_derivatives_whatever_the_rest_is():
    x = np.array([-1.0, 0.0, 4.0])
    with np.errstate(all="ignore"):
        (root,) = partials(lambda x: np.where(x > 0, np.sqrt(x), 5 * x), x)
        (held,) = partials(lambda x: np.clip(x, -0.5, 2.0), x)
    np.testing.assert_array_equal(root, [5, 5, 0.25])
    np.testing.assert_array_equal(held, [0, 1, 0])
    least, most = (partials(function, 1.0, 1.0) for function in (np.minimum, np.maximum))
    assert least == most == [1, 0], "of two that are equal, the first"


def test_tables_and_roundings_are_constant_between_jumps():
    table = np.array([0.0, 1.0, 5.0])

    def between(x):
        k = np.searchsorted(table, x, side="right") - 1
        low = look_up(table, k)
        return (x - low) / (look_up(table, k + 1) - low) + np.floor(x) + np.sign(x) + np.rint(x)

    np.testing.assert_array_equal(partials(between, np.array([0.25, 2.0])), [[1, 0.25]])


def test_a_loop_carries_derivatives_from_step_to_step():
    def cube(x):
        return loop(lambda product, count, x: ((product * x, count + 1, x), count >= 2), (1.0 + 0 * x, 0.0, x), 9)[0]

    np.testing.assert_allclose(partials(cube, np.array([0.1, 2.0])), [[0.03, 12]], rtol=ROUNDED)


def test_a_step_of_newton_after_a_loop_has_the_derivative_of_the_root():
    def root(y, further):
        def step(x, y):
            after = x - (x * x * x - y) / (3 * x * x)
            return (after, y), ~(np.abs(after - x) > 4 * roundoff(x) * np.abs(after))

        x, y = loop(step, (1.0 + 0 * y, y), 100)
        return x - (x * x * x - y) / (3 * x * x) if further else x

    y = np.array([0.1, 1.0, 8.0, 1e6])
    np.testing.assert_allclose(partials(lambda y: root(y, True), y), [1 / (3 * np.cbrt(y) ** 2)], rtol=ROUNDED)


def test_what_begins_an_iteration_may_carry_no_derivatives():
    (dual,) = differentiate(record(lambda x: [2 * stop_gradient(3 * x)], 1), [1.5])
    assert dual == (9.0, (None,))
    assert stop_gradient(1.5) == 1.5


def test_an_inverse_has_the_derivative_of_the_root_wherever_it_began():
    inverse = Inverse(lambda x: x + 0.3 * x**3, lambda x: 1 + 0.9 * x**2, 0.0, 2.0)
    x = np.concatenate(([0.0, 1e-300], np.linspace(0.01, 2.0, 200)))
    (slope,) = partials(inverse, inverse.function(x))
    np.testing.assert_allclose(slope, 1 / inverse.derivative(x), rtol=ROUNDED)


def test_an_inverse_settles_soon_also_where_rounding_moves_it_to_and_fro():
    inverse = Inverse(lambda x: x + 0.3 * x**3 - 0.05 * x**5, lambda x: 1 + 0.9 * x**2 - 0.25 * x**4, 0.0, 2.1)
    x, rounds = np.linspace(0.01, 2.09, 2000), []
    counted = NUMPY | {"all": lambda settled: rounds.append(settled) or NUMPY["all"](settled)}
    target = np.append(inverse.function(x), inverse.function(2.1) + 1)  # the last is outside
    (root,) = record(lambda y: [inverse(y)], 1).evaluate(counted, (target,))
    np.testing.assert_allclose(root[:-1], x, rtol=1e-13)
    assert np.isnan(root[-1])
    assert len(rounds) <= 16


def test_a_function_without_a_derivative_is_refused_by_name():
    with pytest.raises(TypeError, match="spacing of a setting has no derivative: use other functions"):
        np.spacing(Varied(2.0, (1.0,)))
