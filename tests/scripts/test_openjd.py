"""The job template for render farms, by the reference implementation of Open Job Description."""

import subprocess
import sys

from .running import ROOT, left

TEMPLATE = ROOT / "scripts" / "cast.openjd.yaml"


def openjd(*words):
    """Run Open Job Description's command to its end."""
    words = [sys.executable, "-m", "openjd", *map(str, words)]
    return subprocess.run(words, capture_output=True, text=True, timeout=120)


def test_the_template_is_valid():
    done = openjd("check", TEMPLATE)
    assert done.returncode == 0, done.stdout


def test_its_tasks_are_shares_of_the_frames(scene, tmp_path):
    given = {"File": scene, "Output": tmp_path / "out", "Frames": "1:3", "Shards": 2, "Passes": "depth",
             "Format": "NPZ", "Python": sys.executable}  # fmt: skip
    words = [word for name, value in given.items() for word in ("-p", f"{name}={value}")]
    done = openjd("run", TEMPLATE, *words)
    assert done.returncode == 0, done.stdout
    assert done.stdout.count("Wrote 4 pictures into") == done.stdout.count("Wrote 2 pictures into") == 1
    stems = [f"{camera}_{frame}" for camera in ("Side", "Top") for frame in ("0001", "0002", "0003")]
    assert left(tmp_path / "out") == [f"{stem}.{kind}" for stem in stems for kind in ("json", "npz", "png")]
