"""Sets of files that appear in a folder all together or not at all, even if the writing process is killed.

A run writes new files into its own subfolder ``.writing_*`` and holds a lock on it. When all files are written, the run
lists them in a journal and moves them to their places one by one, keeping the files that they replace. If a move
fails, the run restores the old files. If a run was killed, the next run in the folder undoes or completes it: without
a journal no file was moved yet; with a journal all new files exist.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from errno import EISDIR
from pathlib import Path
from shutil import copy2, rmtree
from tempfile import mkdtemp

from .records import InputError

if sys.platform == "win32":  # no protection against two simultaneous runs in one folder
    LOCK_EX = LOCK_NB = 0

    def flock(file: int, how: int) -> None:
        """Do nothing."""

else:
    from fcntl import LOCK_EX, LOCK_NB, flock


PREFIX = ".writing_"
NEW, OLD, JOURNAL, LOCK = "new", "old", "journal.json", "lock"
DRAFT = JOURNAL + ".draft"
OURS = {NEW, OLD, JOURNAL, DRAFT, LOCK}
"""What may stand in a folder of a run; a folder with anything else is somebody's own."""


@contextmanager
def atomic_folder(folder: Path) -> Iterator[Path]:
    """Yield an empty folder whose files move into ``folder`` at the end; if anything fails, none of them are left.

    Raises InputError, in one line, if the folder cannot be written.
    """
    made: list[Path] = []
    try:
        made += [path for path in (folder, *folder.parents) if not path.exists()]
        folder.mkdir(parents=True, exist_ok=True)
        with _workplace(folder) as work:
            yield work / NEW
            with _locked(folder):
                _commit(folder, work)
    except BaseException as error:
        for path in made:
            with suppress(OSError):  # another run uses it already
                path.rmdir()
        if isinstance(error, OSError):
            raise InputError(_refusal(folder, error)) from error
        raise


def clear_up(folder: Path) -> None:
    """Complete or undo killed runs in a folder. Raises InputError if the folder cannot be written."""
    try:
        if folder.is_dir():
            with _locked(folder):
                _recover(folder)
    except OSError as error:
        raise InputError(_refusal(folder, error)) from error


def _refusal(folder: Path, error: OSError) -> str:
    reason = error.strerror or type(error).__name__
    return f"cannot write into {str(folder)!r}: {reason}; choose another folder"


@contextmanager
def _workplace(folder: Path) -> Iterator[Path]:
    """Recover from killed runs, then yield a new folder in which a set is written."""
    with _locked(folder):
        _recover(folder)
        work = Path(mkdtemp(prefix=PREFIX, dir=folder))
        lock = os.open(work / LOCK, os.O_CREAT | os.O_RDWR)
        flock(lock, LOCK_EX | LOCK_NB)
    try:
        for name in (NEW, OLD):
            (work / name).mkdir()
        yield work
    finally:
        os.close(lock)
        rmtree(work, ignore_errors=True)


@contextmanager
def _locked(folder: Path) -> Iterator[None]:
    """Prevent other runs from starting or finishing in a folder."""
    if not LOCK_EX:
        yield
        return
    file = os.open(folder, os.O_RDONLY)
    try:
        flock(file, LOCK_EX)
        yield
    finally:
        os.close(file)


def _recover(folder: Path) -> None:
    """Complete or undo killed runs; leave the files of running ones."""
    for work in folder.glob(PREFIX + "*"):
        with suppress(OSError):  # it is locked, or its run has just removed it
            if work.is_symlink() or not work.is_dir() or not set(os.listdir(work)) <= OURS:
                continue
            lock = os.open(work / LOCK, os.O_CREAT | os.O_RDWR)  # a run that was killed while it cleared up has none
            try:
                flock(lock, LOCK_EX | LOCK_NB)
                if (work / JOURNAL).exists():
                    _move(folder, work)
            finally:
                os.close(lock)
            rmtree(work, ignore_errors=True)


def _commit(folder: Path, work: Path) -> None:
    """Move all new files to their places, or none of them."""
    names = sorted(os.listdir(work / NEW))
    for name in names:
        if (folder / name).is_dir():
            raise IsADirectoryError(EISDIR, f"{name!r} is a folder there")
    draft = work / DRAFT
    draft.write_text(json.dumps(names), encoding="utf-8")
    os.replace(draft, work / JOURNAL)
    _move(folder, work)


def _move(folder: Path, work: Path) -> None:
    """Move the remaining new files; if that fails, put everything back."""
    names = json.loads((work / JOURNAL).read_text(encoding="utf-8"))
    try:
        for name in sorted(os.listdir(work / NEW)):
            target, kept = folder / name, work / OLD / name
            if target.exists() and not kept.exists():
                _keep(target, kept)
            os.replace(work / NEW / name, target)
    except OSError:
        left = os.listdir(work / NEW)
        for name in names:
            if (work / OLD / name).exists():
                os.replace(work / OLD / name, folder / name)
            elif name not in left:
                (folder / name).unlink()
        (work / JOURNAL).unlink()
        raise


def _keep(file: Path, kept: Path) -> None:
    """Link or copy a file to a second path."""
    try:
        os.link(file, kept)
    except OSError:  # file systems without links
        draft = kept.with_name(kept.name + ".draft")
        copy2(file, draft)
        os.replace(draft, kept)
