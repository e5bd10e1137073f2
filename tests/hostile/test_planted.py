"""Folders in the output folder that only look as if a killed run had left them: in part real, in part links that lead
away, of somebody else's names, with somebody else's journal. Nothing outside of the folder is touched.
"""

import json
import os
from random import Random

import pytest

from ..core.test_leftovers import tree

COUNT, FEW = 300, 10
TOKEN = "0123456789abcdef"
NAMES = "a.exr", "report.json"
JOURNALS = (
    ["../victim.txt"], ["/tmp/x"], [".."], [""], [1], "a.exr", {"token": TOKEN, "files": ["../victim.txt"]},
    {"token": TOKEN, "files": [["a.exr"]]}, {"token": "0" * 16, "files": ["a.exr"]}, {"token": TOKEN}, None, 5,
)  # fmt: skip
"""Journals of no run."""


def real(work, name):
    """What a run leaves under this name."""
    if name in ("new", "old"):
        (work / name).mkdir()
        if name == "new":
            (work / name / "planted.exr").write_text("planted")
    else:
        journal = json.dumps({"token": TOKEN, "files": ["planted.exr"]})
        (work / name).write_text(TOKEN if name == "lock" else journal)


def linked(work, name):
    """A link to what is of the right kind, and lies elsewhere."""
    real(work.parent.parent / "docs", name)
    (work / name).symlink_to(work.parent.parent / "docs" / name)


def of_another_kind(work, name):
    if name in ("new", "old"):
        (work / name).write_text("a file")
    else:
        (work / name).mkdir()


def with_other_content(work, name):
    (work / "thesis.txt").write_text("mine")
    real(work, name)


def plant(random, out):
    """Plant a folder that differs from that of a killed run in one fault."""
    fault = random.choice(("name", "journal", "token", linked, of_another_kind, with_other_content, "workplace"))
    others = "", "mine", TOKEN[1:], TOKEN + "0", "X" * 16
    work = out / f".writing_{random.choice(others) if fault == 'name' else TOKEN}"
    work.mkdir()
    parts = ["new", "old", "lock", "journal.json"]
    faulty = random.choice(parts) if callable(fault) else None
    for name in parts:
        (fault if name == faulty else real)(work, name)
    if fault == "journal":
        (work / "journal.json").write_text(json.dumps(random.choice(JOURNALS)))
    elif fault == "token":
        (work / "lock").write_text(random.choice(("", "0" * 16, TOKEN + "\n", TOKEN[:-1])))
    elif fault == "workplace":
        work.rename(out.parent / "docs" / "work")
        work.symlink_to(out.parent / "docs" / "work")


def check(folder, number):
    """A run into a folder with such a folder makes its own files, and changes nothing else."""
    from camera_ray_caster.core.file_set import atomic_folder, clear_up

    random = Random(f"planted {number}")
    out = folder / "out"
    for path in (out, folder / "docs"):
        path.mkdir(parents=True)
    for path in (folder / "victim.txt", out / "thesis.txt"):
        path.write_text("mine")
    plant(random, out)
    before = tree(folder)
    clear_up(out)
    with atomic_folder(out) as new:
        for name in NAMES:
            (new / name).write_text("new")
    assert tree(folder) == before | {f"out/{name}": "new" for name in NAMES}, number


@pytest.mark.skipif(os.name == "nt", reason="links need rights on Windows")
@pytest.mark.parametrize("first", [0, *(pytest.param(k, marks=pytest.mark.hostile) for k in range(FEW, COUNT, 29))])
def test_planted_folders(tmp_path, first):
    for number in range(first, min(first + (29 if first else FEW), COUNT)):
        check(tmp_path / str(number), number)
