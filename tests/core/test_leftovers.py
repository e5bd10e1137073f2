"""What killed runs leave in a folder, and what only looks like it."""

import json
import os
import re
import shutil
from pathlib import Path

import pytest

from camera_ray_caster.core.file_set import clear_up

from .test_file_set import NAMES, content, write


def left_by_a_run(folder, text="new", names=NAMES, token="0123456789abcdef"):
    """The workplace of a run that was killed when its journal was written, with nothing moved yet."""
    work = folder / f".writing_{token}"
    for name in ("new", "old"):
        (work / name).mkdir(parents=True)
    for name in names:
        (work / "new" / name).write_text(text)
    (work / "lock").write_text(token)
    (work / "journal.json").write_text(json.dumps({"token": token, "files": sorted(names)}))
    return work


def tree(folder):
    """All that is in a folder and below it, with what it holds or leads to; links are not followed."""
    files = {}
    for path in folder.rglob("*"):
        kept = os.readlink(path) if path.is_symlink() else path.read_text() if path.is_file() else "folder"
        files[str(path.relative_to(folder))] = kept
    return files


@pytest.mark.parametrize("journal", [None, "", '{"token": "01', "[" * 100_000, "\0"])
def test_a_run_with_an_empty_or_cut_off_journal_is_completed(tmp_path, journal):
    """The journal appears when all new files are there, so that they are a whole set."""
    write(tmp_path, "old")
    work = left_by_a_run(tmp_path)
    if journal is not None:
        (work / "journal.json").write_text(journal)
    os.replace(tmp_path / "a.exr", work / "old" / "a.exr")
    os.replace(work / "new" / "a.exr", tmp_path / "a.exr")
    write(tmp_path, "other", ["b.png"])
    assert content(tmp_path) == {**dict.fromkeys(NAMES, "new"), "b.png": "other"}


def own_name(work):
    return work.rename(work.with_name(".writing_mine"))


def own_folder(work):
    shutil.rmtree(work)
    work.mkdir()
    (work / "thesis.txt").write_text("mine")


def no_token(work):
    (work / "lock").write_text("")


def other_token(work):
    (work / "lock").write_text("fedcba9876543210")


def journal_of_another(work):
    (work / "journal.json").write_text('["../victim.txt"]')


def journal_that_leads_away(work):
    (work / "journal.json").write_text(json.dumps({"token": work.name[9:], "files": ["../victim.txt"]}))


def linked(name):
    def link(work):
        kept = work.parent.parent / "docs" / name
        kept.parent.mkdir(exist_ok=True)
        (work / name).rename(kept)
        (work / name).symlink_to(kept)

    return link


def linked_workplace(work):
    os.symlink(work.rename(work.parent.parent / "docs"), work)


PLANTED = (
    own_name, own_folder, no_token, other_token, journal_of_another, journal_that_leads_away,
    *map(linked, ("new", "old", "lock", "journal.json")), linked_workplace,
)  # fmt: skip


@pytest.mark.parametrize("plant", PLANTED)
def test_a_folder_that_no_run_has_made_stays_as_it_is(tmp_path, plant):
    out = tmp_path / "out"
    (tmp_path / "victim.txt").write_text("mine")
    plant(left_by_a_run(out, "planted"))
    before = tree(tmp_path)
    write(out, "mine")
    clear_up(out)
    assert tree(tmp_path) == {**before, **{f"out/{name}": "mine" for name in NAMES}}


def test_what_a_planted_folder_links_to_stays(tmp_path):
    """A link as a new or kept file is only a name in the folder: what it leads to is neither read nor changed."""
    victim = tmp_path / "victim.txt"
    victim.write_text("mine")
    work = left_by_a_run(tmp_path / "out")
    (work / "new" / "a.exr").unlink()
    (work / "new" / "a.exr").symlink_to(victim)
    (tmp_path / "out" / "a.png").symlink_to(victim)
    write(tmp_path / "out", "other", ["b.png"])
    write(tmp_path / "out", "new")
    assert content(tmp_path / "out") == {**dict.fromkeys(NAMES, "new"), "b.png": "other"}
    assert victim.read_text() == "mine"


def test_what_a_run_left_that_was_killed_as_it_began_is_removed(tmp_path):
    for token in ("0" * 16, "1" * 16):
        (tmp_path / f".writing_{token}").mkdir()
    (tmp_path / f".writing_{token}" / "lock").touch()
    write(tmp_path, "new")
    assert content(tmp_path) == dict.fromkeys(NAMES, "new")


def test_new_files_are_on_disk_before_the_journal_and_that_before_a_move(tmp_path, monkeypatch):
    steps, sync, replace = [], os.fsync, os.replace

    def syncing(file):
        steps.append(Path(os.readlink(f"/proc/self/fd/{file}")).name)
        sync(file)

    def replacing(source, target):
        steps.append(f"to {Path(target).name}")
        replace(source, target)

    monkeypatch.setattr(os, "fsync", syncing)
    monkeypatch.setattr(os, "replace", replacing)
    write(tmp_path, "new")
    names = [re.sub(r"\.writing_\w+", "work", step) for step in steps]
    before, after = ["new", "journal.json.draft", "to journal.json", "work"], [tmp_path.name]
    assert names == [*NAMES, *before, *(f"to {name}" for name in NAMES), *after]
