"""The job template for render farms, by the reference implementation of Open Job Description."""

import subprocess
import sys

import pytest

from .running import ROOT, left

TEMPLATE, DATA_SET = (ROOT / "scripts" / f"{name}.openjd.yaml" for name in ("cast", "dataset"))


def openjd(*words):
    """Run Open Job Description's command to its end."""
    words = [sys.executable, "-m", "openjd", *map(str, words)]
    return subprocess.run(words, capture_output=True, text=True, timeout=300)


@pytest.mark.parametrize("template", [TEMPLATE, DATA_SET])
def test_the_template_is_valid(template):
    done = openjd("check", template)
    assert done.returncode == 0, done.stdout


def test_its_tasks_are_shares_of_the_frames(scene, tmp_path):
    parameters = {"File": scene, "Output": tmp_path / "out", "Frames": "1:3", "Shards": 2, "Passes": "depth",
             "Format": "NPZ", "Python": sys.executable}  # fmt: skip
    words = [word for name, value in parameters.items() for word in ("-p", f"{name}={value}")]
    done = openjd("run", TEMPLATE, *words)
    assert done.returncode == 0, done.stdout
    assert done.stdout.count("Wrote 4 pictures into") == done.stdout.count("Wrote 2 pictures into") == 1
    stems = [f"{camera}_{frame}" for camera in ("Side", "Top") for frame in ("0001", "0002", "0003")]
    assert left(tmp_path / "out") == [f"{stem}.{kind}" for stem in stems for kind in ("json", "npz", "png")]


def test_shares_of_a_data_set_are_completed(scene, tmp_path):
    parameters = {"File": scene, "Output": tmp_path / "out", "Frames": "1:3", "Shards": 2, "Passes": "depth",
             "Python": sys.executable}  # fmt: skip
    done = openjd("run", DATA_SET, *(word for name, value in parameters.items() for word in ("-p", f"{name}={value}")))
    assert done.returncode == 0, done.stdout
    assert f"The 6 pictures in {tmp_path / 'out'} are a data set" in done.stdout
    assert {"dataset.json", "preview.png", "reader.py"} <= set(left(tmp_path / "out"))
