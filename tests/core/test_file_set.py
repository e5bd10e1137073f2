"""Sets of files that appear together or not at all: failures, kills at every step, several writers. Without Blender."""

import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from camera_ray_caster.core import file_set
from camera_ray_caster.core.file_set import Taken, atomic_folder
from camera_ray_caster.core.records import InputError

ADDON = Path(file_set.__file__).parents[2]
NAMES = ("a.exr", "a.png", "report.json")


def write(folder, text, names=NAMES):
    with atomic_folder(folder) as new:
        for name in names:
            (new / name).write_text(text)


def content(folder):
    """What is in a folder, all of it, hidden files too."""
    return {path.name: path.read_text() if path.is_file() else "folder" for path in folder.iterdir()}


def test_files_appear_and_replace_those_that_were_there(tmp_path):
    out = tmp_path / "deep" / "out"
    for text in ("old", "new"):
        write(out, text)
        assert content(out) == dict.fromkeys(NAMES, text)


def test_a_failure_leaves_what_was_there_and_no_new_folder(tmp_path):
    def fail(folder):
        with atomic_folder(folder) as new:
            (new / "a.exr").write_text("half")
            raise KeyError("it went wrong")

    with pytest.raises(KeyError):
        fail(tmp_path / "deep" / "out")
    assert content(tmp_path) == {}
    write(tmp_path, "old")
    with pytest.raises(KeyError):
        fail(tmp_path)
    assert content(tmp_path) == dict.fromkeys(NAMES, "old")


def test_only_one_of_two_runs_makes_a_file_that_is_not_to_be_replaced(tmp_path):
    def second_comes_first():
        with atomic_folder(tmp_path, replacing=False) as first:
            (first / "set.json").write_text("first")
            with atomic_folder(tmp_path, replacing=False) as second:
                (second / "set.json").write_text("second")

    with pytest.raises(Taken):
        second_comes_first()
    assert content(tmp_path) == {"set.json": "second"}


def test_a_folder_that_another_run_has_begun_to_use_stays(tmp_path):
    out = tmp_path / "out"

    def fail():
        with atomic_folder(out):
            (out / "theirs.png").write_text("theirs")
            raise KeyError

    with pytest.raises(KeyError):
        fail()
    assert content(out) == {"theirs.png": "theirs"}


@pytest.mark.parametrize("folder", ["a.exr", "report.json"])
def test_one_file_that_cannot_be_replaced_keeps_all(tmp_path, folder):
    write(tmp_path, "old", [name for name in NAMES if name != folder])
    (tmp_path / folder).mkdir()
    before = content(tmp_path)
    with pytest.raises(InputError, match="cannot write into"):
        write(tmp_path, "new")
    assert content(tmp_path) == before


@pytest.mark.parametrize("old_names", [NAMES, NAMES[:1], ()])
@pytest.mark.parametrize("step", range(4))
def test_a_move_that_fails_is_taken_back(tmp_path, monkeypatch, old_names, step):
    write(tmp_path, "old", old_names)
    before = content(tmp_path)
    replace, count = os.replace, iter(range(100))

    def failing(source, target):
        if next(count) == step:
            raise OSError(28, "No space left on device")
        replace(source, target)

    monkeypatch.setattr(os, "replace", failing)
    with pytest.raises(InputError, match=r"cannot write into .*: No space left on device; choose another folder"):
        write(tmp_path, "new")
    assert content(tmp_path) == before


KILLED = """
import os, signal, sys
sys.path[:0] = [{addon!r}]
from pathlib import Path
from camera_ray_caster.core.file_set import atomic_folder
count = iter(range(100))
def dying(function):
    def one(*arguments, **options):
        if next(count) == {step}:
            os.kill(os.getpid(), signal.SIGKILL)
        return function(*arguments, **options)
    return one
os.replace, os.link, os.mkdir, os.unlink, os.rmdir = map(dying, (os.replace, os.link, os.mkdir, os.unlink, os.rmdir))
with atomic_folder(Path({out!r})) as new:
    for name in {names!r}:
        (new / name).write_text("new")
print("done")
"""


@pytest.mark.full
@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGKILL")
@pytest.mark.parametrize("old_names", [NAMES, NAMES[:1]])
def test_what_a_killed_run_left_is_completed_or_undone_by_the_next(tmp_path, old_names):
    """Killed before each of its steps on the file system, one after the other."""
    ends = set()
    for step in range(40):
        out = tmp_path / str(step)
        write(out, "old", old_names)
        code = KILLED.format(addon=str(ADDON), step=step, out=str(out), names=NAMES)
        status = subprocess.run([sys.executable, "-c", code], stdout=subprocess.DEVNULL, timeout=300).returncode
        write(out, "other", ["b.png"])
        after = content(out)
        assert after.pop("b.png") == "other"
        assert after in (dict.fromkeys(old_names, "old"), dict.fromkeys(NAMES, "new")), step
        ends.add((status, len(set(after.values())) and after["a.exr"]))
        if status == 0:
            break
    assert ends == {(-signal.SIGKILL, "old"), (-signal.SIGKILL, "new"), (0, "new")}


def test_a_run_that_ends_while_another_begins_is_no_error(tmp_path, monkeypatch):
    other, listed = tmp_path / f".writing_{'0' * 16}", os.listdir
    other.mkdir()

    def ended(path):
        if Path(path) == other:
            shutil.rmtree(other)
        return listed(path)

    monkeypatch.setattr(os, "listdir", ended)
    with atomic_folder(tmp_path) as new:
        (new / NAMES[0]).write_text("new")
    assert content(tmp_path) == {NAMES[0]: "new"}


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no locks of this kind")
def test_writers_into_one_folder_leave_the_set_of_one_of_them(tmp_path):
    code = (
        "import sys\n"
        f"sys.path[:0] = [{str(ADDON)!r}]\n"
        "from pathlib import Path\n"
        "from camera_ray_caster.core.file_set import atomic_folder\n"
        "for k in range(10):\n"
        f"    with atomic_folder(Path({str(tmp_path)!r})) as new:\n"
        f"        for name in {NAMES!r}:\n"
        "            (new / name).write_text(f'{sys.argv[1]} {k}')\n"
    )
    runs = [subprocess.Popen([sys.executable, "-c", code, str(writer)]) for writer in range(3)]
    assert [run.wait(300) for run in runs] == [0, 0, 0]
    after = content(tmp_path)
    assert sorted(after) == sorted(NAMES)
    assert len(set(after.values())) == 1
