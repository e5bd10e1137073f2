"""Error against run time and the comparison with others: tables and files from measurements, and one-line refusals."""

import json
import re
import sys
from importlib.util import find_spec

import numpy as np
import pytest

from .test_scripts import ROOT, refused, script, small

TURNED = "a planet, 2 above, turned"
FAR = "radius over distance 1e-9, turned"


@pytest.fixture
def precision(monkeypatch):
    """The scripts' modules, told to be quick: a run each, small pictures, few samples."""
    monkeypatch.setattr(sys, "path", [str(ROOT / "scripts"), str(ROOT), *sys.path])
    from precision import arithmetic, comparison, effort, points

    monkeypatch.setattr(points, "REPEATS", 1)
    monkeypatch.setattr(arithmetic, "SIDE", 24)
    monkeypatch.setattr(arithmetic, "COMPARED", 16)
    for name, value in {"SAMPLES": (1, 16), "REFERENCE": 256, "TOLERANCES": (1.0, 0.01)}.items():
        monkeypatch.setattr(effort, name, value)
    return type("Precision", (), {"arithmetic": arithmetic, "comparison": comparison, "effort": effort})


@pytest.fixture
def work_precision(precision, monkeypatch, capsys, tmp_path):
    """A function that runs the script here with some words and returns its tables' cells and its JSON."""
    import work_precision

    def run(*words):
        monkeypatch.setattr(sys, "argv", ["work_precision.py", *words, "--output", str(tmp_path)])
        assert work_precision.main() == 0
        rows = [line.strip("| ").split(" | ") for line in capsys.readouterr().out.splitlines() if line.startswith("|")]
        return rows, json.loads((tmp_path / "work_precision.json").read_text())

    return run


def named(points, **keys):
    """The points with these entries, by their methods."""
    return {p["method"]: p for p in points if all(p[key] == value for key, value in keys.items())}


def test_every_family_is_in_table_json_and_diagram(precision, work_precision, tmp_path):
    rows, points = work_precision(TURNED)
    families = {"arithmetic", *precision.effort.FAMILIES}
    assert {p["family"] for p in points} == families
    assert all(p["seconds"] > 0 and p["spread"] >= 1 and p["worst_error"] >= 0 for p in points)
    assert all(p["median_error"] <= p["worst_error"] for p in points if p["family"] != "samples")
    drawing = (tmp_path / "work_precision.svg").read_text()
    for text in (*precision.arithmetic.METHODS, TURNED, "thin lens", "slit scan", "Newton", "round trip"):
        assert text in drawing
    assert "NaN" not in drawing
    png = (tmp_path / "work_precision.png").read_bytes()
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    assert np.frombuffer(png[16:24], ">u4").tolist() == [1000, pytest.approx(1105, abs=120)]
    (of_scene,) = (row for row in rows if row[0] == TURNED)
    for method, cell in zip(precision.arithmetic.METHODS, of_scene[1:], strict=False):
        point = named(points, family="arithmetic")[method]
        assert cell == (f"{point['median_error']:.0e} / {point['worst_error']:.0e}, {point['seconds'] * 1e3:.0f} ms")
    others = [p for p in points if p["family"] != "arithmetic"]
    assert [row[:2] for row in rows[-len(others) :]] == [[p["method"], p["scene"]] for p in others]


def test_errors_are_those_of_the_arithmetic(precision, work_precision):
    """Measured a planet's ground is lost to textbooks in float32, kept by robust arithmetic to the last digits."""
    points = work_precision("--only", "arithmetic", TURNED, FAR)[1]
    planet, far = (named(points, scene=scene) for scene in (TURNED, FAR))
    assert planet["float64 robust"]["worst_error"] < 1e-13 < planet["float64 textbook"]["worst_error"] < 1e-6
    assert 1e-9 < planet["float32 robust"]["worst_error"] < 1e-4 < planet["float32 textbook"]["worst_error"]
    assert far["float32 textbook"]["wrong"] > 0
    assert far["float32 textbook"]["worst_error"] == 1
    assert far["float64 robust"]["wrong"] == 0
    assert far["float64 robust"]["worst_error"] < 1e-13
    assert all(p["compared"] > 0 for p in points)


def test_a_fault_of_the_caster_shows_in_the_figures(precision, work_precision, monkeypatch):
    right = precision.arithmetic.cast

    def faulty(*arguments, **keywords):
        images = right(*arguments, **keywords)
        if "distance" in images:
            images["distance"] = images["distance"] * (1 + 1e-3)
        return images

    monkeypatch.setattr(precision.arithmetic, "cast", faulty)
    rows, points = work_precision("--only", "arithmetic", TURNED)
    found = named(points)
    assert found["float64 robust"]["median_error"] == pytest.approx(1e-3, rel=1e-9)
    assert found["float64 textbook"]["worst_error"] < 1e-6, "the textbook's is not the caster's"
    assert rows[-1][-1] == "none", "no method is right to 1e-12"


@pytest.mark.parametrize("family", ["samples", "time", "inverse", "verification"])
def test_effort_buys_precision(work_precision, family):
    _, points = work_precision("--only", family)
    for method in {p["method"] for p in points} - {"table and one step"}:
        own = [p for p in points if p["method"] == method]
        errors = [p["median_error" if family == "samples" else "worst_error"] for p in own]
        assert errors == sorted(errors, reverse=True)
        assert errors[0] > 2 * errors[-1]


def test_a_blender_file_is_a_scene_too(blender, tmp_path):
    paths = [small(blender, tmp_path / f"{name}.blend") for name in ("one", "other")]
    done = script("work_precision", *paths, "--only", "arithmetic", "--output", tmp_path / "out")
    assert (done.returncode, done.stderr) == (0, "")
    points = json.loads((tmp_path / "out" / "work_precision.json").read_text())
    assert list(dict.fromkeys(p["scene"] for p in points)) == ["one", "other"]
    robust = named(points, scene="one")["float64 robust"]
    assert (robust["wrong"], robust["worst_error"] < 1e-13) == (0, True)
    lines = done.stdout.splitlines()
    assert [line.split(" | ")[0] for line in lines] == ["| scene", lines[1], "| one", "| other"], "nothing of Blender's"


@pytest.mark.parametrize(("name", "words", "said"), [
    ("work_precision", ["nothing like it"], "no extreme case has 'nothing like it' in its name"),
    ("work_precision", ["missing.blend"], "there is no file 'missing.blend'"),
    ("work_precision", ["text.blend"], "'text.blend' is no .blend that this Blender can open"),
    ("work_precision", ["planet", "--only", "speed"], "arithmetic"),
    ("work_precision", ["planet", "--output", "text.blend/out"], "cannot write into 'text.blend/out'"),
    ("side_by_side", ["nothing like it"], "no extreme case has 'nothing like it' in its name"),
    ("side_by_side", ["--fast"], "unrecognized arguments: --fast"),
])  # fmt: skip
def test_bad_words_are_refused_in_one_line(tmp_path, name, words, said):
    (tmp_path / "text.blend").write_text("no .blend")
    line = refused(script(name, *words, folder=tmp_path))
    assert line.startswith(f"{name}.py: ")
    assert said in line
    assert [path.name for path in tmp_path.iterdir()] == ["text.blend"]


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
    names, found = comparison.compared(cases)
    assert names == [FAR]
    ours, embree = found.values()
    assert 0 <= ours[0] < 1e-12
    assert embree == "not installed: embreex"
    assert "| not installed: embreex | – |" in comparison.table(names, found)
    assert comparison.details(names, found).splitlines()[-1].endswith("| not installed: embreex |")


def test_a_wrong_tracer_is_counted_as_wrong(precision, monkeypatch):
    comparison = precision.comparison
    right = comparison.TRACERS["this caster"]
    tracers = {
        "right": right,
        "a thousandth off": lambda case, given: right(case, given) * 1.001,
        "misses all": lambda case, given: np.full(len(given.pixels), np.inf),
        "cannot": lambda case, given: None,
    }
    monkeypatch.setattr(comparison, "TRACERS", tracers)
    cases = [case for case in precision.arithmetic.CASES if case.name == "eye inside"]
    rows = table_of(comparison.table(*comparison.compared(cases)).splitlines())
    assert rows["right"][:5] == ["1", "1", "1", "1", "1"]
    assert rows["a thousandth off"] == ["1", "1", "0", "0", "0", "1e-03"]
    assert rows["misses all"] == ["1", "0", "0", "0", "0", "–"]
    assert rows["cannot"][:2] == ["0", "0"]
