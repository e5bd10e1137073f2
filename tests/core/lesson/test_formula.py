"""Formulas as models write them, worked out: by hand, and against the rays that the models make."""

import re

import numpy as np
import pytest

from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.lesson.formula import (
    assignments,
    at_most,
    digits,
    shown,
    value_and_noise,
    with_numbers,
    worked_out,
)
from camera_ray_caster.core.lesson.lesson import lesson
from camera_ray_caster.core.records import no_shapes

from ..cameras.model_examples import EXAMPLES, camera

KNOWN = {"x": 2.5, "W": 40, "fov": 3.0, "k1": -0.5, "r": 2.0, "u": np.array([1.0, 0, 0])}


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        ("2 x/W - 1", -0.875),
        ("36 / (5 x)", 2.88),
        ("1 - k1² r³", -1.0),
        ("r⁴/2 (1 + x)", 28.0),
        ("-90° / pi", None),
        ("180°", np.pi),
        ("2 atan(r tan(fov / 4))", 2 * np.arctan(2 * np.tan(0.75))),
        ("min(x, W) r", 5.0),
        ("x u", (2.5, 0, 0)),
        ("(x, r) / 2", None),
        ("r theta", None),
        ("k1 + ...", None),
        ("1 / (r - 2)", None),
        ("().__class__", None),
        ("u × (0, 1, 0)", (0, 0, 1)),
        ("(0, r, 0) × u / r", (0, 0, -1)),
        ("u × r", None),
        ("r (u . (3, r, 0)) x", 15.0),
        ("u . r", None),
    ],
)
def test_an_expression_is_worked_out_or_has_names_that_are_not_known(expression, expected):
    result, _ = value_and_noise(expression, KNOWN)
    assert result is None if expected is None else result == pytest.approx(expected, rel=1e-15)


def test_assignments_stand_between_commas_outside_of_parentheses():
    assert list(assignments("a = f(x, y) W, b likewise, d = (a, -b); no more")) == [
        ("a", "f(x, y) W"), ("d", "(a, -b)"),
    ]  # fmt: skip


def test_a_name_is_known_wherever_it_is_assigned():
    formulas = [("X = (x - W/2) q", {}), ("q = 36 / (W r), n = theta", {}), ("Y = x", {"x": 7.0})]
    assert worked_out(formulas, KNOWN) == [
        ["X = (2.5 - 40/2) · 0.45 = -7.875"], ["q = 36 / (40 · 2) = 0.45"], ["Y = 7"],
    ]  # fmt: skip


def test_the_components_of_a_vector_are_known():
    formulas = [("m = u × (0, r, x)", {}), ("d = -m / m_z, n = m_x m_y", {})]
    assert worked_out(formulas, KNOWN) == [
        ["m = u × (0, 2, 2.5) = (0, -2.5, 2)"], ["d = -m / 2 = (0, 1.25, -1)", "n = 0 · (-2.5) = 0"],
    ]  # fmt: skip


def test_numbers_stand_for_names_and_not_for_parts_of_names():
    assert with_numbers("(x - W/2) fov, max(x) X k1 u", KNOWN) == "(2.5 - 40/2) · 3, max(2.5) · X · (-0.5) · u"
    assert with_numbers("2 x/W - 1 + 2 k1", KNOWN) == "2 · 2.5/40 - 1 + 2 · (-0.5)"
    assert with_numbers("sin(k1) cos(r)", KNOWN) == "sin(-0.5) · cos(2)"


def test_what_is_zero_to_the_digits_of_a_vector_is_shown_as_zero():
    assert shown(np.array([1.0, -4e-8, -0.0])) == "(1, 0, 0)"
    assert shown(np.array([1e-8, 2e-8, 0.0])) == "(1e-08, 2e-08, 0)"
    assert shown(np.array([1e6, 0.2, np.inf])) == "(1e+06, 0.2, inf)"
    assert shown(-4e-8) == "-4e-08", "a number of its own keeps its digits"
    assert (shown(np.cos(np.pi / 2)), shown(8.63851e-17)) == ("0", "0"), "what rounding leaves of numbers around 1"
    assert worked_out([("y = tan(a)", {})], {"a": np.pi / 2})[0][0].endswith("= 1.63312e+16"), "a pole is no zero"
    assert (digits(-1e-16, "+"), digits(2.5, "+"), digits(-1e-13)) == ("+0", "+2.5", "-1e-13")


@pytest.mark.parametrize("size", [(480, 300), (300, 480), (200, 200)])
def test_the_normalized_form_of_a_parallel_view_is_the_ray_s_origin_in_every_frame(size):
    cam = camera("ORTHO", dict(zip(("resolution_x", "resolution_y"), size, strict=True)) | {"shift_x": 0.1})
    lines = dict(lesson(cam, no_shapes(), 30, 170).steps)["Model"]
    origins = [line.rpartition(" = (")[2].rstrip(")") for line in lines if line.startswith("  o = ")]
    assert len(origins) == 2
    for origin in origins:
        wanted = [float(number) for number in cam.camera_rays(30.5, 170.5)[0]]
        assert [float(number) for number in origin.split(",")] == pytest.approx(wanted, abs=1e-5)


VECTOR = re.compile(r"  ([or]) = .*\(([^()]*, [^()]*, [^()]*)\)")


def pixels(cam):
    width, height = cam.raster.size
    return [(i * width // 4, j * height // 3) for i in range(4) for j in range(3)]


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.key)
def test_the_formula_of_a_model_gives_its_rays_with_numbers_in_every_step(model):
    """To the digits that are shown; each model with all its examples: shifts, pixel aspects, fields of view."""
    compared = 0
    for settings in EXAMPLES[model.key]:
        cam = camera(model.key, settings)
        for column, row in pixels(cam):
            with np.errstate(all="ignore"):
                rays = [np.array([float(number) for number in v]) for v in cam.camera_rays(column + 0.5, row + 0.5)]
            if not np.isfinite(rays[1]).all():
                continue
            lines = dict(lesson(cam, no_shapes(), column, row).steps)["Model"]
            for step in cam.model.steps:
                at = lines.index(f"{step.words}: {step.symbols}") + 1
                worked = [line for line, _ in assignments(step.symbols)]
                assert [line.split()[0] for line in lines[at : at + len(worked)]] == worked, step
            vectors = [match for match in map(VECTOR.fullmatch, lines) if match]
            vectors = vectors[-2:] if "port" in settings else vectors  # before: the ray in air
            assert "r" in {match[1] for match in vectors}
            for name, numbers in (match.groups() for match in vectors):
                shown = np.array([float(number) for number in numbers.split(",")])
                ray = rays[name == "r"]
                if name == "r":
                    shown, ray = (v / np.linalg.norm(v) for v in (shown, ray))
                assert shown == pytest.approx(ray, abs=1e-5, rel=1e-5)
                compared += 1
    assert compared > 0


def test_what_rounding_leaves_is_zero_by_the_numbers_that_it_comes_from():
    """Sums of large numbers leave more, small numbers of their own are no noise."""
    formulas = [("a = big cos(90°), b = 1 - cos(tiny), c = k4 tiny, d = 2 a", {})]
    lines = dict(line.split(" = ", 1) for line in worked_out(formulas, {"big": 1000.0, "tiny": 1e-9, "k4": 1e-18})[0])
    assert {name: text.rpartition(" = ")[2] for name, text in lines.items()} == {
        "a": "0", "b": "0", "c": "1e-27", "d": "0",
    }  # fmt: skip
    assert (lines["c"], lines["d"]) == ("1e-18 · 1e-09 = 1e-27", "2 · 0 = 0")


def test_a_lecture_has_four_digits_and_begins_with_the_formula():
    with at_most(4):
        assert [digits(number) for number in (-0.123456, 12345.678, 1.23456e6, 450)] == [
            "-0.1235", "12346", "1.235e+06", "450",
        ]  # fmt: skip
        explained = lesson(camera("PERSP"), no_shapes(), 3, 2)
    assert explained.screens[0] == ("Perspective", explained.formula)
    pages = explained.screens[1:]
    assert max(len(lines) for _, lines in pages) <= 6
    assert [line for _, lines in pages for line in lines] == [line for _, lines in explained.steps for line in lines]
    assert not any(lines[0].startswith(" ") for _, lines in pages), "a page does not begin with numbers of another one"
    numbers = re.findall(r"\d+\.\d+", str(explained))
    assert numbers
    assert max(len(number.replace(".", "").lstrip("0")) for number in numbers) == 4
