"""Shares of a set, and what completes them, killed at random moments: the next run goes on, and the set is the same."""

import sys
import time
from random import Random

import numpy as np
import pytest

from ..scripts.running import ROOT, complaints, left, script, small, start

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signals")

KILLS = 50
"""Moments for shares, and as many for what completes them."""
FEW = 1
"""Moments of each that ``make test-full`` tries."""
WORDS = "--cameras", "ALL", "--frames", "1:6", "--passes", "depth,ray_direction", "--annotations"
DATASET = ROOT / "scripts" / "dataset.py"


@pytest.fixture(scope="module")
def reference(registered, tmp_path_factory):
    """The file, and the folder of the set that one run has made."""
    folder = tmp_path_factory.mktemp("shares")
    scene = small(registered, folder / "small.blend", resolution_x=160, resolution_y=120)
    assert script("dataset", scene, *WORDS, "--output", folder / "out").returncode == 0
    return scene, folder / "out"


def killed(random, longest, *words):
    """Kill a run at a random moment, if it is still there."""
    run = start(DATASET, *words)
    time.sleep(random.uniform(0.3, longest))
    run.kill()
    assert "Traceback" not in run.communicate(timeout=300)[1]


def done(*words):
    """Run to the end."""
    ended = script("dataset", *words)
    assert (ended.returncode, complaints(ended.stderr)) == (0, [])


def check(whole, out):
    """The set is that of one run."""
    assert left(out) == left(whole)
    for path in whole.iterdir():
        if path.suffix == ".npz":
            with np.load(path) as expected, np.load(out / path.name) as file:
                assert all((file[key] == expected[key]).all() for key in expected)
        elif path.name in ("dataset.json", "annotations.json", "reader.py"):
            assert (out / path.name).read_bytes() == path.read_bytes()


def kill(reference, out, what, random):
    """Kill both shares, or what completes them, or two runs in one folder; then end all, and compare."""
    scene, whole = reference
    shares = [(scene, *WORDS, "--shard", f"{k}/2", "--output", out) for k in (1, 2)]
    if what == "shares":
        for words in shares:
            killed(random, 4, *words)
    elif what == "two runs":
        other = start(DATASET, scene, *WORDS, "--output", out)
        killed(random, 4, scene, *WORDS, "--output", out)
        assert "Traceback" not in other.communicate(timeout=300)[1]
    for words in shares:
        done(*words)
    if what == "complete":
        killed(random, 2.5, out, "--complete")
    done(out, "--complete")
    check(whole, out)


@pytest.mark.full
@pytest.mark.parametrize("what", ["shares", "complete", "two runs"])
@pytest.mark.parametrize("moment", range(FEW))
def test_some_moments(reference, tmp_path, what, moment):
    kill(reference, tmp_path / "out", what, Random(f"{what} {moment}"))


@pytest.mark.hostile
@pytest.mark.parametrize("what", ["shares", "complete", "two runs"])
@pytest.mark.parametrize("moment", range(FEW, FEW + KILLS))
def test_many_moments(reference, tmp_path, what, moment):
    kill(reference, tmp_path / "out", what, Random(f"{what} {moment}"))
