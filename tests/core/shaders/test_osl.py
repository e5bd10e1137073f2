"""Records as OSL: every operation can be written, and what a text says of itself is what it was made of."""

import numpy as np
import pytest

from camera_ray_caster.core.maths.recording import DOMAIN, Parameter, record, stop_gradient
from camera_ray_caster.core.maths.recording.record import COMPARISONS, LOGICAL, NUMERIC
from camera_ray_caster.core.shaders.osl import Inputs, OslWriter
from camera_ray_caster.core.shaders.writer import LARGEST_CONSTANT, LEAST_CONSTANT, Term


def written(function, places=frozenset()):
    """The inputs, the lines and the outputs of a formula of x and y."""
    writer = OslWriter(Inputs(places))
    program = writer.write(record(function, 2), [Term("x"), Term("y")])
    return writer.constants, [line.strip() for line in writer.lines], program


def test_every_operation_can_be_written():
    assert set(OslWriter.FUNCTIONS) >= NUMERIC | COMPARISONS | LOGICAL
    assert set(OslWriter.ABSENT) == set(DOMAIN)


def test_constants_of_the_formula_stand_in_the_text_and_settings_are_inputs():
    inputs, lines, _ = written(lambda x, y: (2.0 * x + 0.37 * y - Parameter(2.0, "lens"),))
    assert inputs.values == {"c2": 0.37, "lens": 2.0}
    assert lines == ["float v1 = 2.0 * x;", "float v2 = c2 * y;", "float v3 = v1 + v2;", "float v4 = v3 - lens;"]


def test_a_constant_can_be_made_an_input():
    inputs, *_ = written(lambda x, y: (2.0 * x,), frozenset((1,)))
    assert inputs.values == {"c1": 2.0}
    assert inputs.used == {1}


def test_where_derivatives_stop_nothing_is_written():
    _, lines, (term,) = written(lambda x, y: (stop_gradient(x + y),))
    assert (lines, term.text) == (["float v1 = x + y;"], "v1")


def test_what_is_no_number_is_carried_beside_the_value():
    _, lines, (term,) = written(lambda x, y: (np.where(x < 1.0, np.sqrt(y), np.nan),))
    assert lines == [
        "int is1 = x < 1.0;", "int is2 = y < 0.0;", "float v3 = sqrt(y);",
        "float v4 = is1 ? v3 : 0.0;", "int is5 = is1 ? is2 : 1;",
    ]  # fmt: skip
    assert term == Term("v4", "is5")


def test_a_division_by_a_number_that_is_written_is_always_one():
    _, lines, (term,) = written(lambda x, y: (x / 2.0,))
    assert (lines, term.none) == (["float v1 = x / 2.0;"], "")


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.1, "0.1"), (1.0, "1.0"), (-2.5, "(-2.5)"), (1e-300, "1e-30"), (np.inf, "3e+38"), (1 / 3, "0.333333333")],
)
def test_numbers_are_written_to_the_last_digit_of_float32(value, text):
    assert OslWriter.literal(value) == text
    clipped = np.clip(abs(value), LEAST_CONSTANT, LARGEST_CONSTANT) * np.sign(value)
    assert np.float32(text.strip("()")) == np.float32(clipped)


def test_a_helper_comes_with_the_one_that_it_calls():
    writer = OslWriter(Inputs())
    writer.write(record(lambda x: (np.cos(x) + np.rint(x),), 1), [Term("x")])
    assert writer.helpers == {"sin", "cos", "rint"}
