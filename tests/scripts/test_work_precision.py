"""Error against run time: tables and files from measurements, and one-line refusals."""

import io
import json
import sys
from contextlib import redirect_stdout

import numpy as np
import pytest

from .running import refused, script, small

TURNED = "a planet, 2 above, turned"
FAR = "radius over distance 1e-9, turned"


@pytest.fixture(scope="module")
def work_precision(precision, tmp_path_factory):
    """A function that runs the script here with some words; it returns its tables' cells, its JSON and its folder."""
    from measure.precision.run import main

    def run(*words):
        folder, printed = tmp_path_factory.mktemp("out"), io.StringIO()
        with pytest.MonkeyPatch.context() as patch, redirect_stdout(printed):
            patch.setattr(sys, "argv", ["work_precision.py", *words, "--output", str(folder)])
            assert main("") == 0
        rows = [line.strip("| ").split(" | ") for line in printed.getvalue().splitlines() if line.startswith("|")]
        return rows, json.loads((folder / "work_precision.json").read_text()), folder

    return run


@pytest.fixture(scope="module")
def everything(work_precision):
    """Every family of methods, and two scenes through every arithmetic."""
    return work_precision(TURNED, FAR)


def named(points, **keys):
    """The points with these entries, by their methods."""
    return {p["method"]: p for p in points if all(p[key] == value for key, value in keys.items())}


def test_every_family_is_in_table_json_and_diagram(precision, everything):
    rows, points, folder = everything
    families = {"arithmetic", *precision.effort.FAMILIES}
    assert {p["family"] for p in points} == families
    assert all(p["seconds"] > 0 and p["spread"] >= 1 and p["worst_error"] >= 0 for p in points)
    assert all(p["median_error"] <= p["worst_error"] for p in points if p["family"] != "samples")
    drawing = (folder / "work_precision.svg").read_text()
    for text in (*precision.arithmetic.METHODS, TURNED, "thin lens", "slit scan", "Newton", "round trip"):
        assert text in drawing
    assert "NaN" not in drawing
    png = (folder / "work_precision.png").read_bytes()
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    assert np.frombuffer(png[16:24], ">u4").tolist() == [1000, pytest.approx(1105, abs=120)]
    (of_scene,) = (row for row in rows if row[0] == TURNED)
    for method, cell in zip(precision.arithmetic.METHODS, of_scene[1:], strict=False):
        point = named(points, family="arithmetic", scene=TURNED)[method]
        assert cell == (f"{point['median_error']:.0e} / {point['worst_error']:.0e}, {point['seconds'] * 1e3:.0f} ms")
    others = [p for p in points if p["family"] != "arithmetic"]
    assert [row[:2] for row in rows[-len(others) :]] == [[p["method"], p["scene"]] for p in others]


def test_errors_are_those_of_the_arithmetic(everything):
    """Measured a planet's ground is lost to textbooks, kept by robust arithmetic to the last digits."""
    points = [p for p in everything[1] if p["family"] == "arithmetic"]
    planet, far = (named(points, scene=scene) for scene in (TURNED, FAR))
    assert planet["float64 robust"]["worst_error"] < 1e-13 < planet["float64 textbook"]["worst_error"] < 1e-6
    assert planet["float32 textbook"]["worst_error"] > 1e-4
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
    rows, points, _ = work_precision("--only", "arithmetic", TURNED)
    assert {p["family"] for p in points} == {"arithmetic"}
    figures = named(points)
    assert figures["float64 robust"]["median_error"] == pytest.approx(1e-3, rel=1e-9)
    assert figures["float64 textbook"]["worst_error"] < 1e-6, "the textbook's is not the caster's"
    assert rows[-1][-1] == "none", "no method is right to 1e-12"


@pytest.mark.parametrize("family", ["samples", "time", "inverse", "verification"])
def test_effort_buys_precision(everything, family):
    points = [p for p in everything[1] if p["family"] == family]
    for method in {p["method"] for p in points} - {"table and one step"}:
        of_method = [p for p in points if p["method"] == method]
        errors = [p["median_error" if family == "samples" else "worst_error"] for p in of_method]
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


@pytest.mark.parametrize(("words", "message"), [
    (["nothing like it"], "no extreme case has 'nothing like it' in its name"),
    (["missing.blend"], "there is no file 'missing.blend'"),
    (["text.blend"], "'text.blend' is not a .blend file that this Blender can open"),
    (["planet", "--only", "speed"], "arithmetic"),
    (["planet", "--output", "text.blend/out"], "cannot write into 'text.blend/out'"),
])  # fmt: skip
def test_bad_words_are_refused_in_one_line(tmp_path, words, message):
    (tmp_path / "text.blend").write_text("no .blend")
    line = refused(script("work_precision", *words, folder=tmp_path))
    assert line.startswith("work_precision.py: ")
    assert message in line
    assert [path.name for path in tmp_path.iterdir()] == ["text.blend"]
