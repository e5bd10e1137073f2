"""Shares of a set, and what completes them, killed while they write: the next run goes on, and the set is the same."""

import sys
import time
from contextlib import suppress
from random import Random

import numpy as np
import pytest

from ..scripts.running import ROOT, in_this_process, left, small, start

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signals")

LAST = {"shares": 16, "complete": 3, "two runs": 16}
"""Changes of the folder's names after which a run is killed at the latest. Its start, which takes most of its time, is
left alone: it changes nothing.
"""
KILLS = 16
"""Moments of each."""
WORDS = "--cameras", "ALL", "--frames", "1:6", "--passes", "depth,ray_direction", "--annotations"
DATASET = ROOT / "scripts" / "dataset.py"


@pytest.fixture(scope="module")
def reference(registered, tmp_path_factory):
    """The file, and the folder of the set that one run has made."""
    folder = tmp_path_factory.mktemp("shares")
    scene = small(registered, folder / "small.blend", resolution_x=160, resolution_y=120)
    in_this_process("dataset", scene, *WORDS, "--output", folder / "out")
    return scene, folder / "out"


def names_in(folder):
    """The names in a folder that may not be there yet, of files that are being written, too."""
    with suppress(FileNotFoundError):
        return left(folder)
    return []


def killed(random, changes, out, *words):
    """Kill a run after so many changes in its folder, or a moment later, if it is still there."""
    before, run = names_in(out), start(DATASET, *words)
    while run.poll() is None and changes:
        now = names_in(out)
        changes -= now != before
        before = now
        time.sleep(0.001)
    time.sleep(random.uniform(0, 0.02))
    run.kill()
    assert "Traceback" not in run.communicate(timeout=300)[1]


def check(whole, out):
    """The set is that of one run."""
    assert left(out) == left(whole)
    for path in whole.iterdir():
        if path.suffix == ".npz":
            with np.load(path) as expected, np.load(out / path.name) as file:
                assert all((file[key] == expected[key]).all() for key in expected)
        elif path.name in ("dataset.json", "annotations.json", "reader.py"):
            assert (out / path.name).read_bytes() == path.read_bytes()


def kill(reference, out, what, moment):
    """Kill both shares, or what completes them, or one of two runs in a folder; then end all, and compare."""
    (scene, whole), random, changes = reference, Random(f"{what} {moment}"), 1 + moment % LAST[what]
    shares = [(scene, *WORDS, "--shard", f"{k}/2", "--output", out) for k in (1, 2)]
    if what == "shares":
        for words in shares:
            killed(random, changes, out, *words)
    elif what == "two runs":
        other = start(DATASET, scene, *WORDS, "--output", out)
        killed(random, changes, out, scene, *WORDS, "--output", out)
        assert "Traceback" not in other.communicate(timeout=300)[1]
    for words in shares:
        in_this_process("dataset", *words)
    if what == "complete":
        killed(random, changes, out, out, "--complete")
    in_this_process("dataset", out, "--complete")
    check(whole, out)


@pytest.mark.full
@pytest.mark.parametrize("what", LAST)
def test_some_moments(reference, tmp_path, what):
    kill(reference, tmp_path / "out", what, 2)


@pytest.mark.hostile
@pytest.mark.parametrize("moment", range(KILLS))
@pytest.mark.parametrize("what", LAST)
def test_many_moments(reference, tmp_path, what, moment):
    kill(reference, tmp_path / "out", what, moment)
