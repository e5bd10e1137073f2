"""The screens of a lecture: the formula first, numbers with four digits."""

import pytest

from camera_ray_caster.core.lesson.lecture import rounded, screens
from camera_ray_caster.core.lesson.lesson import lesson
from camera_ray_caster.core.records import no_shapes

from ..cameras.model_examples import EXAMPLES, camera


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("r = (-0.123456, 8.63851e-17, 12)", "r = (-0.1235, 0, 12)"),
        ("f = 12345.678 at 1.23456e+06 of 1241 × 376", "f = 12346 at 1.235e+06 of 1241 × 376"),
        ("theta = 2 asin(r / (2 f))", "theta = 2 asin(r / (2 f))"),
    ],
)
def test_numbers_have_four_digits(line, expected):
    assert rounded(line) == expected


@pytest.mark.parametrize("name", EXAMPLES)
def test_a_model_begins_with_its_formula_and_ends_with_the_color(name):
    seen = camera(name)
    every = screens(lesson(seen, no_shapes(), 3, 2))
    assert [every[0][0], every[-1][0]] == [seen.model.label, "Color"]
    assert list(every[0][1]) == [step.symbols for step in seen.model.steps]
