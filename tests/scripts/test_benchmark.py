"""The benchmark as a user runs it: tables and figures from measurements, ratios that follow, one-line refusals."""

import json
import sys
from importlib.util import find_spec

import pytest

from camera_ray_caster.core.cameras import MODELS

from .running import ROOT, refused, script


def figures(tmp_path, *words):
    """Run it and return what it printed and its JSON."""
    done = script("benchmark", *words, "--json", tmp_path / "figures.json")
    assert done.returncode == 0, done.stderr
    return done.stdout, json.loads((tmp_path / "figures.json").read_text())


@pytest.mark.full
def test_the_contest_times_all_that_is_installed(tmp_path):
    text, rows = figures(tmp_path, "--quick", "--rounds", "1", "--size", "64x36")
    ours = {"ours, 4 passes", "ours, depth + index"}
    others = {"Cycles, 1 sample, 4 passes", "scene.ray_cast loop", "the same, its 4 passes kept"}
    for modules, names in {
        ("mitsuba",): {"Mitsuba 3, aov, 4 passes", "Mitsuba 3, 4 passes in numpy", "Mitsuba 3, intersection"},
        ("embreex", "trimesh"): {"Embree, distance"},
    }.items():
        others |= names if all(map(find_spec, modules)) else set()
    assert {row["name"] for row in rows} == ours | others
    assert {row["spheres"] for row in rows} == {10, 1000}
    assert all(0 < row["least_ms"] <= row["median_ms"] for row in rows)
    for row in rows:
        assert row["name"] in text
    loop = next(row for row in rows if row["name"] == "scene.ray_cast loop")
    base = [row for row in rows if row["spheres"] == 10 and row["name"] == "ours, depth + index"][-1]
    assert loop["over_ours_depth"] == pytest.approx(loop["median_ms"] / base["median_ms"])


@pytest.mark.full
def test_every_model_is_timed_and_eyes_of_spherical_stereo(tmp_path):
    text, rows = figures(tmp_path, "--models", "--size", "48x32", "--rounds", "1")
    names = [row["model"] for row in rows]
    assert names[: len(MODELS)] == [model.key for model in MODELS]
    assert {"eye, PERSP", "eye, MIRRORBALL, merged at 60°"} <= {*names[len(MODELS) :]}
    assert all(row[name] > 0 for row in rows for name in ("fill", "rays", "pinhole", "cast"))
    assert all(row["model"] in text for row in rows)


@pytest.mark.full
def test_whole_casts_are_timed_beside_writing_their_arrays(tmp_path):
    text, rows = figures(tmp_path, "--casts", "--size", "64x36", "--rounds", "1")
    assert len(rows) == 9
    assert all(row["name"] in text for row in rows)
    for row in rows:
        least = min(row["one_thread_ms"][0], row["two_threads_ms"][0])
        assert row["over_writing"] == pytest.approx(least / row["writing_ms"][0])
        assert row["over_filling"] == pytest.approx(row["into_ms"][0] / row["filling_ms"][0])
        assert row["passes_ms"] < row["one_thread_ms"][0]


@pytest.mark.full
def test_renders_are_timed_beside_their_casts(tmp_path):
    text, rows = figures(tmp_path, "--renders", "--size", "64x36", "--rounds", "2")
    assert [row["name"] for row in rows] == ["spheres_and_planes", "living_room"]
    for row in rows:
        assert min(row[name] for name in ("zeros_ms", "F12_ms", "into_ms")) > 0
        assert f"{row['F12_ms'] / row['cast_ms']:.2f} x" in text


@pytest.mark.full
def test_scaling_is_measured_and_drawn(tmp_path):
    _, rows = figures(tmp_path, "--scaling", "--quick", "--picture", tmp_path / "scaling.png")
    assert [row["spheres"] for row in rows if row["against"] == "spheres"] == [10, 100, 1000]
    assert [row["triangles"] for row in rows if row["against"] == "triangles"] == [1000, 4000, 16000]
    assert all(row["median_ms"] > 0 and 0 < row["beside_mb"] < 200 for row in rows)
    assert (tmp_path / "scaling.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.hostile
def test_data_sets_are_timed(registered, monkeypatch, capsys):
    monkeypatch.setattr(sys, "path", [str(ROOT / "scripts"), *sys.path])
    from measure import dataset_speed

    monkeypatch.setattr(dataset_speed, "SIZE", (320, 240))  # smaller pictures take less than starts of Blender vary by
    *rows, writing = dataset_speed.run(8)
    assert [row["name"] for row in rows] == [
        "one process, one core",
        "one process, two cores",
        "two workers, a core each",
    ]
    assert all(row["cpu"] > writing["cpu"] > 0 for row in rows)
    assert f"{rows[0]['cpu'] / writing['cpu']:.2f} x" in capsys.readouterr().out


@pytest.mark.cases(1)
@pytest.mark.parametrize(
    ("words", "message"),
    [(("--size", "1920"), "size"), (("--rounds", "0"), "from 1 up"), (("--threads", "-2"), "from 1 up"),
     (("--json", "no/such/folder/x.json"), "no folder"), (("--fast",), "--fast")],
)  # fmt: skip
def test_bad_input_is_refused_in_one_line(tmp_path, words, message):
    assert message in refused(script("benchmark", *words, folder=tmp_path))


@pytest.mark.full
def test_a_checkout_is_timed_against_a_commit_and_a_wrong_one_is_refused(monkeypatch, capsys):
    """A case of each kind, and the rays of the first model of each group: each case starts two processes."""
    monkeypatch.setattr(sys, "path", [str(ROOT / "scripts"), *sys.path])
    from measure import against

    cases = against.cases()
    assert {f"rays, {model.key}" for model in MODELS} <= {*cases}
    models = {model.group: f"rays, {model.key}" for model in MODELS[::-1]}.values()
    names = ["10 spheres, 4 passes", "1,000 spheres, 2 passes", "1k triangles, 4 passes"]
    names += [name for name in cases if name.startswith(("F12", "data set"))] + [*models]
    monkeypatch.setattr(against, "cases", lambda: dict.fromkeys(names))
    rows = against.run("HEAD", 1, (32, 18))
    assert [row["name"] for row in rows] == names
    printed = capsys.readouterr().out
    assert all(name in printed for name in names)
    assert all(row["ratio"] == pytest.approx(row["here_ms"] / row["there_ms"]) for row in rows)
    assert all(row["there_ms"] > 0 for row in rows)
    refused = script("benchmark", "--against", "nothing")
    assert refused.returncode == 2
    assert "there is no commit 'nothing'" in refused.stderr


@pytest.mark.full
def test_sets_are_measured(monkeypatch, capsys):
    from measure import sets

    few, many = sets.run((1, 3))[:2]
    assert min(few["cpu"], many["cpu"]) > 0  # which is less says nothing for so few pictures on a busy machine
    assert 50 < few["peak"] < 5000
    assert 5e3 < many["json"] < 20e3  # report and annotations; 63 kB before what is common was in dataset.json
    assert "each further picture" in capsys.readouterr().out


@pytest.mark.full
def test_rays_are_timed_beside_their_arrays(tmp_path):
    text, rows = figures(tmp_path, "--rays", "--quick", "--rounds", "1")
    kinds = {"one point", "15 mm apart", "15 mm apart, mixed", "OS1-128", "random"}
    assert {(row["scene"], row["rays"]) for row in rows} == {
        (scene, kind) for scene in ("room", "street", "living_room") for kind in kinds
    }
    assert all(row["count"] > 1000 and row["cast_ms"] > 0 and ("open3d_ms" in row) == bool(find_spec("open3d"))
               for row in rows)  # fmt: skip
    assert all(kind in text for kind in kinds)
