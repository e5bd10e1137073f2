"""Two writers into one folder, ended at random moments by four signals: whole sets, and nothing left behind.

Most of the moments are of writers that do nothing but write, since they hit the steps that matter; the others are of
whole casts, from the start of Python on.
"""

import shutil
import signal
import sys
import time
from pathlib import Path
from random import Random

import pytest

from ..exr import read_exr
from ..scripts.running import ROOT, small, start
from .writer import FILES, content, write

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signals")

SIGNALS = "SIGINT", "SIGTERM", "SIGHUP", "SIGKILL"
WRITINGS, CASTS = 40, 10
"""Moments for each signal: 200 in all."""
FEW = 1
"""Moments for each signal that ``make test`` tries."""


def ended(run, name, was_killed):
    """How a run ended: it was killed, or stopped, or done, or ended before or after Python hears; never in words."""
    errors = run.communicate(timeout=300)[1]
    assert "Traceback" not in errors, errors
    allowed = {0, 130, -getattr(signal, name)} if was_killed else {0}
    assert run.returncode in allowed, (run.returncode, errors)
    return run.returncode


def check_set(folder, ends):
    """All files are whole and of one set; what else is there only a SIGKILL leaves, and the next run removes."""
    names = {path.name for path in folder.iterdir()}
    left = names - set(FILES)
    assert not left or -signal.SIGKILL in ends, left
    assert all(name.startswith(".writing_") for name in left)
    write_next(folder)
    texts = {file: (folder / file).read_text() for file in FILES}
    (name, number), *others = {tuple(text.split(maxsplit=2)[:2]) for text in texts.values()}
    assert not others
    assert texts == {file: content(name, number, size) for file, size in FILES.items()}
    assert {path.name for path in folder.iterdir()} == {*FILES, "next"}


def write_next(folder):
    """The next run into the folder, of another file."""
    from camera_ray_caster.core.file_set import atomic_folder

    with atomic_folder(folder) as new:
        (new / "next").write_text("next")


def kill_a_writing(folder, name, random):
    """End one of two writers while both write as fast as they can, or both: the other one ends by itself else."""
    write(folder, "before", 0)
    writer = Path(__file__).with_name("writer.py")
    both = random.random() < 0.7
    runs = [start(writer, "first", folder, -1), start(writer, "second", folder, -1 if both else 20)]
    for run in runs:
        assert run.stdout.readline() == "ready\n"
    time.sleep(random.uniform(0, 0.06))
    killed = runs if both else runs[:1]
    for run in killed:
        run.send_signal(getattr(signal, name))
    check_set(folder, [ended(run, name, run in killed) for run in runs])


def kill_a_cast(folder, name, random, scenes):
    """End one of two casts of the same name but of different sizes, at any moment of its life."""
    shutil.copytree(scenes / "before", folder)
    script = ROOT / "scripts" / "cast.py"
    runs = [start(script, scenes / size / "scene.blend", "--output", folder) for size in ("16", "24")]
    time.sleep(random.uniform(0.1, 2.5))
    runs[0].send_signal(getattr(signal, name))
    ends = [ended(run, name, run is runs[0]) for run in runs]
    left = {path.name for path in folder.iterdir()} - {"scene.png", "scene.exr", "report.json"}
    assert not left or -signal.SIGKILL in ends, left
    write_next(folder)
    assert {path.name for path in folder.iterdir()} == {"scene.png", "scene.exr", "report.json", "next"}
    width = int.from_bytes((folder / "scene.png").read_bytes()[16:20], "big")
    assert read_exr(folder / "scene.exr")["ViewLayer.Depth.Z"].shape == (width, width)
    assert f'"pixels": {width * width},' in (folder / "report.json").read_text()
    assert width in (16, 24)


@pytest.fixture(scope="session")
def scenes(registered, tmp_path_factory):
    """A folder of scenes that are called the same, and a folder that one of them has been cast into."""
    folder = tmp_path_factory.mktemp("scenes")
    for size in (16, 24):
        (folder / str(size)).mkdir()
        small(registered, folder / str(size) / "scene.blend", resolution_x=size, resolution_y=size)
    run = start(ROOT / "scripts" / "cast.py", folder / "16" / "scene.blend", "--output", folder / "before")
    assert ended(run, "SIGINT", False) == 0
    return folder


@pytest.mark.parametrize("name", ["SIGTERM", "SIGKILL"])
def test_a_few_moments(tmp_path, name, scenes):
    random = Random(f"few {name}")
    for number in range(FEW):
        kill_a_writing(tmp_path / str(number), name, random)
    kill_a_cast(tmp_path / "cast", name, random, scenes)


@pytest.mark.hostile
@pytest.mark.parametrize("part", range(4))
@pytest.mark.parametrize("name", SIGNALS)
def test_writers_ended_at_random_moments(tmp_path, name, part):
    random = Random(f"{name} {part}")
    for number in range(WRITINGS // 4):
        kill_a_writing(tmp_path / str(number), name, random)


@pytest.mark.hostile
@pytest.mark.parametrize("part", range(2))
@pytest.mark.parametrize("name", SIGNALS)
def test_casts_ended_at_random_moments(tmp_path, name, part, scenes):
    random = Random(f"{name} {part} cast")
    for number in range(CASTS // 2):
        kill_a_cast(tmp_path / str(number), name, random, scenes)
