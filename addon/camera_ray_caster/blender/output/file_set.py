"""A set of files that appears in a folder together or not at all, whatever ends the run that writes them.

New files are written into a folder of their own, ``.writing_*``, which its run holds a lock on. When all are there, a
journal names them, and they are moved to their places one by one, with the files that they replace kept beside. A run
that fails on the way puts those back. A run that was killed is undone or completed by the next one into the folder:
without a journal nothing had appeared, with one all new files exist. Needs no Blender.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from errno import EISDIR
from pathlib import Path
from shutil import copy2, rmtree
from tempfile import mkdtemp

from ...core.records import InputError

try:
    from fcntl import LOCK_EX, LOCK_NB, flock
except ImportError:  # Windows: two runs into one folder at the same time are not told apart there
    LOCK_EX = LOCK_NB = 0

    def flock(file: int, how: int) -> None:
        """Do nothing."""


PREFIX = ".writing_"
NEW, OLD, JOURNAL, LOCK = "new", "old", "journal.json", "lock"


@contextmanager
def appearing(folder: Path) -> Iterator[Path]:
    """Yield an empty folder whose files move into ``folder`` in the end; if anything fails nothing is left of them.

    Raises InputError, in one line, where the folder cannot be written.
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
            with suppress(OSError):  # another run has begun to use it
                path.rmdir()
        if isinstance(error, OSError):
            raise InputError(_refusal(folder, error)) from error
        raise


def clear_up(folder: Path) -> None:
    """Complete or undo what runs that were killed have left in a folder. Raises InputError where that cannot be."""
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
    """Yield a new folder in which a set is written, after what killed runs have left was dealt with."""
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
    """Keep other runs from beginning or ending in a folder."""
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
    """Complete or undo what runs that were killed have left; what a run that is alive writes stays."""
    for work in folder.glob(PREFIX + "*"):
        with suppress(OSError):  # it is locked, or not ours
            lock = os.open(work / LOCK, os.O_CREAT | os.O_RDWR)  # a run that was killed while it cleared up has none
            try:
                flock(lock, LOCK_EX | LOCK_NB)
                if (work / JOURNAL).exists():
                    _move(folder, work)
            finally:
                os.close(lock)
            rmtree(work, ignore_errors=True)


def _commit(folder: Path, work: Path) -> None:
    """Move the new files to their places, all or none."""
    names = sorted(os.listdir(work / NEW))
    for name in names:
        if (folder / name).is_dir():
            raise IsADirectoryError(EISDIR, f"{name!r} is a folder there")
    draft = work / (JOURNAL + ".draft")
    draft.write_text(json.dumps(names), encoding="utf-8")
    os.replace(draft, work / JOURNAL)
    _move(folder, work)


def _move(folder: Path, work: Path) -> None:
    """Move what is still to be moved; where that fails put everything back."""
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
    """Let a file stand in another place, too."""
    try:
        os.link(file, kept)
    except OSError:  # file systems without links
        draft = kept.with_name(kept.name + ".draft")
        copy2(file, draft)
        os.replace(draft, kept)
