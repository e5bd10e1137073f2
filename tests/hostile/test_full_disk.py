"""Disks that are full at another moment each: the new set of files is there, whole, or the old one, and one line."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from ..scripts.running import ROOT, script, small

ALONE = ["unshare", "--mount", *([] if hasattr(os, "getuid") and os.getuid() == 0 else ["--map-root-user"])]
"""The words that give a process mounts of its own, also to who is not root, where the system allows that."""

OLD, NEW = 8, 160
"""Pixels of a side."""


def can_mount():
    """Whether a file system of a chosen size can be had here."""
    if shutil.which("unshare") is None:
        return False
    return not subprocess.run([*ALONE, "mount", "-t", "tmpfs", "none", "/mnt"], capture_output=True).returncode


pytestmark = pytest.mark.skipif(
    not can_mount(), reason="needs mounts of its own (unshare, as root or in a user namespace)"
)


def inside(*words):
    """What full_disk.py prints."""
    done = subprocess.run(
        [*ALONE, sys.executable, Path(__file__).with_name("full_disk.py"), *map(str, words)],
        env=os.environ | {"PYTHONPATH": str(ROOT / "addon")},
        capture_output=True,
        text=True,
        timeout=200,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.fixture(scope="module")
def try_sizes(registered, tmp_path_factory):
    """A function that casts into file systems of so many sizes, from next to nothing free to more than enough."""
    folder = tmp_path_factory.mktemp("disk")
    files = {}
    for size in (OLD, NEW):
        (folder / str(size)).mkdir()
        path = small(registered, folder / str(size) / "scene.blend", resolution_x=size, resolution_y=size)
        files[size] = path
        assert script("cast", path, "--output", folder / f"out{size}").returncode == 0

    def kilobytes(name):
        return sum(-(-path.stat().st_size // 4096) * 4 for path in (folder / name).iterdir())

    def try_sizes(count):
        (folder / "disk").mkdir(exist_ok=True)
        least, most = kilobytes(f"out{OLD}"), kilobytes(f"out{OLD}") + kilobytes(f"out{NEW}") + 64
        sizes = [str(4 * round((least + (most - least) * k / (count - 1)) / 4)) for k in range(count)]
        return inside(folder / "disk", folder / f"out{OLD}", files[NEW], *sizes)

    return try_sizes


def check(outcomes):
    """Each is one of the two outcomes, and both are there."""
    for outcome in outcomes:
        assert outcome["names"] == ["report.json", "scene.exr", "scene.png"], outcome
        if outcome["status"] == 0:
            assert (outcome["same"], outcome["whole"], outcome["report"], outcome["said"]) == (
                [],
                True,
                NEW * NEW,
                "",
            ), outcome
            assert outcome["exr"] == pytest.approx(
                max(outcome["exr"] for outcome in outcomes), rel=0.01
            )  # it notes the time, too
        else:
            assert outcome["status"] == 2, outcome
            assert outcome["same"] == outcome["names"], outcome
            (line,) = outcome["said"].splitlines()
            assert "cannot write into" in line, outcome
            assert "No space left on device" in line, outcome
    assert {outcome["status"] for outcome in outcomes} == {0, 2}


def test_a_few_sizes(try_sizes):
    check(try_sizes(6))


@pytest.mark.hostile
def test_forty_sizes(try_sizes):
    check(try_sizes(40))


def test_every_command_says_in_one_line_that_the_disk_is_full(registered, tmp_path):
    plain, compressed = small(registered, tmp_path / "small.blend"), tmp_path / "compressed.blend"
    registered.ops.wm.save_as_mainfile(filepath=str(compressed), copy=True, compress=True)
    (tmp_path / "disk").mkdir()
    for outcome in inside(tmp_path / "disk", plain, compressed, "COMMANDS"):
        assert outcome["status"] == 2, outcome
        (line,) = outcome["said"].splitlines()
        assert line.startswith(f"{outcome['command']}.py: cannot write"), outcome
        assert ": No space left on device; choose another " in line, outcome
        assert outcome["left"] in ([], ["dataset.json"]), outcome
