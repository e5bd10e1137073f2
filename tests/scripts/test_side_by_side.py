"""The extreme cases through other ray tracers: tables from measurements, and one-line refusals."""

import re
import sys
from importlib.util import find_spec

import numpy as np
import pytest

from .running import refused, script

FAR = "radius over distance 1e-9, turned"
OTHERS = {"Mitsuba 3": "mitsuba", "Embree 4": "embreex", "Cycles": "trimesh", "scene.ray_cast": "trimesh"}
"""A package that each other tracer needs."""


def table_of(lines):
    """The rows of a Markdown table by their first cells."""
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    assert len({len(row) for row in rows}) == 1
    return {row[0]: row[1:] for row in rows}


def test_side_by_side_prints_its_tables_and_nothing_of_blenders():
    done = script("side_by_side", FAR, "eye inside", "--details")
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert all(line.startswith("|") for line in lines), done.stdout
    start = next(i for i, line in enumerate(lines) if line.startswith("| case"))
    summary, details = table_of(lines[:start]), table_of(lines[start:])
    assert summary["this caster"][:2] == ["3", "3"]
    assert summary["this caster"][4] == "3", "right to 1e-12"
    cases = ["eye inside", "eye inside, on an ellipsoid's axis", FAR]
    assert sorted(name for name in details if name != "case" and "---" not in name) == sorted(cases)
    for name, package in OTHERS.items():
        (row,) = (cells for tracer, cells in summary.items() if tracer.startswith(name))
        column = next(i for i, tracer in enumerate(details["case"]) if tracer.startswith(name))
        if find_spec("trimesh") is None or find_spec(package) is None:
            assert row[0].startswith("not installed: ")
            assert details[FAR][column].startswith("not installed: ")
            continue
        assert int(row[0]) >= int(row[1]) >= int(row[2]) >= int(row[3]) >= int(row[4])
        assert details[FAR][column] == "inf" or not re.match(r"\de-1", details[FAR][column]), "float32 loses it"


def test_what_is_not_installed_is_said_and_the_others_are_compared(precision, monkeypatch):
    comparison = precision.comparison
    for package in ("mitsuba", "embreex", "trimesh"):
        monkeypatch.setitem(sys.modules, package, None)  # as if it were not there
    tracers = {name: tracer for name, tracer in comparison.TRACERS.items() if "this" in name or "4" in name}
    monkeypatch.setattr(comparison, "TRACERS", tracers)
    cases = [case for case in precision.arithmetic.CASES if case.name == FAR]
    names, outcomes = comparison.compared(cases)
    assert names == [FAR]
    ours, embree = outcomes.values()
    assert 0 <= ours[0] < 1e-12
    assert embree == "not installed: embreex"
    assert "| not installed: embreex | – |" in comparison.table(names, outcomes)
    assert comparison.details(names, outcomes).splitlines()[-1].endswith("| not installed: embreex |")


def test_a_wrong_tracer_is_counted_as_wrong(precision, monkeypatch):
    comparison = precision.comparison
    right = comparison.TRACERS["this caster"]
    tracers = {
        "right": right,
        "a thousandth off": lambda case, rays: right(case, rays) * 1.001,
        "misses all": lambda case, rays: np.full(len(rays.pixels), np.inf),
        "cannot": lambda case, rays: None,
    }
    monkeypatch.setattr(comparison, "TRACERS", tracers)
    cases = [case for case in precision.arithmetic.CASES if case.name == "eye inside"]
    rows = table_of(comparison.table(*comparison.compared(cases)).splitlines())
    assert rows["right"][:5] == ["1", "1", "1", "1", "1"]
    assert rows["a thousandth off"] == ["1", "1", "0", "0", "0", "1e-03"]
    assert rows["misses all"] == ["1", "0", "0", "0", "0", "–"]
    assert rows["cannot"][:2] == ["0", "0"]


@pytest.mark.parametrize(("words", "message"), [
    (["nothing like it"], "no extreme case has 'nothing like it' in its name"),
    (["--fast"], "unrecognized arguments: --fast"),
])  # fmt: skip
def test_bad_words_are_refused_in_one_line(tmp_path, words, message):
    line = refused(script("side_by_side", *words, folder=tmp_path))
    assert line.startswith("side_by_side.py: ")
    assert message in line
    assert list(tmp_path.iterdir()) == []
