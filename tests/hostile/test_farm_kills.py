"""A data set whose workers, or whose whole run, are killed while they work: the next run finishes it, every file is
whole, and what was finished is not made again.
"""

import json
import socket
import subprocess
import sys
import time
from contextlib import suppress
from random import Random

import numpy as np
import psutil
import pytest

from ..scripts.running import ROOT, complaints, in_this_process, left, small, start

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signals")

LAST = 16
"""Reports, of 24, after which a run is disturbed at the latest: both workers have something to do then. A worker, and
the whole run, are killed once after each number of reports up to this, since each run starts three processes.
"""
WORDS = "--cameras", "ALL", "--frames", "1:12", "--passes", "combined,depth,ray_direction"


@pytest.fixture(scope="module")
def reference(registered, tmp_path_factory):
    """The file, and the folder of the set that nothing has disturbed."""
    folder = tmp_path_factory.mktemp("farm")
    scene = small(registered, folder / "small.blend", resolution_x=160, resolution_y=120)
    in_this_process("dataset", scene, *WORDS, "--output", folder / "out")
    return scene, folder / "out"


def finished(out):
    """Of each file of a frame whose files are all there what changes where it is written."""
    files = {}
    for report in out.glob("*_0*.json"):
        names = report.name, *json.loads(report.read_text())["made"]["files"]
        with suppress(FileNotFoundError):  # a worker that is alive moves them, one by one
            states = [(out / name).stat() for name in names]
            files |= {name: (state.st_ino, state.st_mtime_ns) for name, state in zip(names, states, strict=True)}
    return files


def workers(run):
    """The processes that a run has started and that are alive."""
    children = []
    for child in psutil.Process(run.pid).children(recursive=True):
        with suppress(psutil.NoSuchProcess):  # it has just ended, or is not waited for yet
            if any("spawn_main" in word for word in child.cmdline()):
                children.append(child)
    return children


def kill(reference, out, name, reports):
    """Kill one worker or the whole run after so many reports, finish the set, and compare it."""
    (scene, whole), random = reference, Random(f"{name} {reports}")
    run = start(ROOT / "scripts" / "dataset.py", scene, *WORDS, "--workers", "2", "--output", out)
    while run.poll() is None and len(list(out.glob("*_0*.json"))) < reports:
        time.sleep(0.01)
    time.sleep(random.uniform(0, 0.05))
    before = {}
    if run.poll() is None:
        started = workers(run)
        victim = random.choice(started) if name == "worker" else run
        victim.kill()
        if victim is run:
            psutil.wait_procs(started, 30)  # they notice
        before = finished(out)
    errors = run.communicate(timeout=300)[1]
    assert "Traceback" not in errors, errors
    if name == "worker":
        assert (run.returncode, complaints(errors)) == (0, [])
    in_this_process("dataset", scene, *WORDS, "--output", out)
    after = finished(out)
    assert before == {file: after[file] for file in before}
    assert left(out) == left(whole)
    for path in whole.glob("*.npz"):
        with np.load(path) as expected, np.load(out / path.name) as file:
            assert file.keys() == expected.keys()
            assert all((file[key] == expected[key]).all() for key in expected)


@pytest.mark.parametrize("name", ["worker", "run"])
def test_some_moments(reference, tmp_path, name):
    kill(reference, tmp_path / "out", name, LAST // 2)


@pytest.mark.hostile
@pytest.mark.parametrize("reports", range(1, LAST + 1))
@pytest.mark.parametrize("name", ["worker", "run"])
def test_many_moments(reference, tmp_path, name, reports):
    kill(reference, tmp_path / "out", name, reports)


def port():
    """A port that nobody uses."""
    with socket.socket() as server:
        server.bind(("127.0.0.1", 0))
        return server.getsockname()[1]


@pytest.fixture
def dask():
    """A function that starts a part of Dask; what it started ends with the test."""
    started = []

    def begin(name, *words):
        command = [sys.executable, "-m", f"distributed.cli.{name}", "--no-dashboard", *map(str, words)]
        started.append(subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
        return started[-1]

    yield begin
    for process in reversed(started):
        with suppress(psutil.NoSuchProcess):
            for child in psutil.Process(process.pid).children(recursive=True):
                child.kill()
        process.kill()
        process.wait(30)


@pytest.mark.hostile
def test_a_scheduler_that_begins_anew_goes_on(reference, tmp_path, dask):
    """Killed with half of the pictures made; the next one, with workers of its own, has the address of the first."""
    scene, whole = reference
    number, out = port(), tmp_path / "out"
    address = f"tcp://127.0.0.1:{number}"

    def begin():
        scheduler = dask("dask_scheduler", "--host", "127.0.0.1", "--port", number)
        return scheduler, [dask("dask_worker", address, "--nthreads", "1", "--no-nanny") for _ in range(2)]

    scheduler, workers_begun = begin()
    time.sleep(4)
    run = start(ROOT / "scripts" / "dataset.py", scene, *WORDS, "--scheduler", address, "--output", out)
    while run.poll() is None and len(list(out.glob("*_0*.json"))) < 8:
        time.sleep(0.01)
    assert run.poll() is None
    for process in (scheduler, *workers_begun):
        process.kill()
        process.wait(30)
    begin()
    outputs = run.communicate(timeout=150)
    assert (run.returncode, complaints(outputs[1])) == (0, [])
    assert left(out) == left(whole)
    assert len(finished(out)) == len(finished(whole))
