"""The example data set: made, loaded back, and found out where it is not what it was."""

import json
import shutil
import subprocess
import sys

import numpy as np
import pytest

from .running import ROOT, left, script


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A set of two views of our own pictures."""
    folder = tmp_path_factory.mktemp("clevr") / "set"
    words = "--views", 2, "--objects", 5, "--resolution", "64x48", "--engine", "CAMERA_RAY_CASTER"
    done = script("clevr_set", *words, "--output", folder)
    assert done.returncode == 0, done.stderr
    return folder


@pytest.fixture
def check_set(monkeypatch, capsys):
    """A function that checks a folder in this process, and returns how that ended."""
    monkeypatch.setattr(sys, "path", [str(ROOT / "scripts"), *sys.path])
    from measure import views

    def run(folder):
        monkeypatch.setattr(sys, "argv", ["check_set.py", str(folder)])
        try:
            status = views.main("")
        except SystemExit as ended:
            status = ended.code
        return subprocess.CompletedProcess(sys.argv, status, *capsys.readouterr())

    return run


def test_a_set_has_pictures_passes_cameras_and_annotations_and_fits_together(made):
    ends = ".npz", ".png", "_coco.json"
    names = [f"clevr_000{k}{end}" for k in (1, 2) for end in ends] + ["report_0001.json", "report_0002.json"]
    assert left(made) == sorted(["annotations.json", "camera.json", "clevr.blend", "preview.png", "reader.py", *names])
    with np.load(made / "clevr_0001.npz") as passes:
        assert passes["combined"].shape == (48, 64, 4)
        assert set(np.unique(passes["object_index"])) == set(range(6))
    objects = {entry["object"] for entry in json.loads((made / "annotations.json").read_text())["annotations"]}
    assert len(objects) == 6
    done = script("check_set", made)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "all as it has to be" in done.stdout


@pytest.mark.parametrize("name", ["distance", "flow_forward", "shape_index"])
def test_passes_of_another_view_are_found_out(made, check_set, tmp_path, name):
    folder = tmp_path / "set"
    shutil.copytree(made, folder)
    with np.load(folder / "clevr_0001.npz") as file:
        passes = dict(file)
    passes[name] = np.roll(passes[name], 2, axis=1)
    np.savez(folder / "clevr_0001.npz", **passes)
    done = check_set(folder)
    assert (done.returncode, done.stderr) == (1, "")
    assert "do not fit together" in done.stdout


@pytest.mark.cases(1)
@pytest.mark.parametrize("content", [b"no zip", None])
def test_a_broken_view_is_refused_in_one_line(made, check_set, tmp_path, content):
    """A damaged file; and one without the rays that are needed, beside a name that is no frame's."""
    folder = tmp_path / "set"
    shutil.copytree(made, folder)
    (folder / "clevr_2.5.npz").write_bytes(b"")
    if content is None:
        with np.load(folder / "clevr_0001.npz") as file:
            np.savez(folder / "clevr_0001.npz", distance=file["distance"])
    else:
        (folder / "clevr_0001.npz").write_bytes(content)
    message = "clevr_0001.npz has no pass shape_index" if content is None else "clevr_0001.npz' cannot be read"
    done = check_set(folder)
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert message in done.stderr


def test_any_set_is_checked_and_a_camera_that_moved_is_found_out(check_set, tmp_path):
    """A perspective and a fisheye of one frame, elsewhere; then with the place of the fisheye forged."""
    from ..core.sets.test_sets import view

    cameras = [view(tmp_path, 1)[0], view(tmp_path, 1, "FISHEYE_EQUIDISTANT", matrix_world=np.eye(4))[0]]
    assert len(cameras) == 2
    done = check_set(tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "PERSP_0001 to FISHEYE_EQUIDISTANT_0001" in " ".join(done.stdout.split())
    path = tmp_path / "FISHEYE_EQUIDISTANT_0001.json"
    moved = path.read_text().replace('"matrix_world": [[1.0, 0.0, 0.0, 0.0]', '"matrix_world": [[1.0, 0.0, 0.0, 0.4]')
    assert moved != path.read_text()
    path.write_text(moved)
    done = check_set(tmp_path)
    assert (done.returncode, done.stderr) == (1, "")
    assert "do not fit together" in done.stdout


def test_what_is_no_set_is_refused_in_one_line(check_set, tmp_path):
    done = check_set(tmp_path)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert left(tmp_path) == []


@pytest.mark.full
def test_what_no_set_can_be_made_of_is_refused_in_one_line(tmp_path):
    (tmp_path / "file").write_text("")
    done = script("clevr_set", "--views", 1, "--resolution", "8x8", "--engine", "CAMERA_RAY_CASTER",
                  "--output", tmp_path / "file")  # fmt: skip
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    done = script("clevr_set", "--resolution", "99999999x2", "--output", tmp_path / "set")
    assert (done.returncode, "outside Blender's range" in done.stderr) == (2, True)
    assert left(tmp_path) == ["file"]
