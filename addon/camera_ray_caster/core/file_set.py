"""Sets of files that appear in a folder all together or not at all, even if the writing process is killed.

A run writes new files into its own subfolder ``.writing_TOKEN`` and holds a lock on it. When all files are written, the
run lists them in a journal and moves them to their places one by one, keeping the files that they replace. If a move
fails, the run restores the old files. If a run was killed, the next run in the folder undoes or completes it: without
a journal no file was moved yet; with a journal all new files exist, and are on disk before it is. The lock and the
journal hold the token: a folder without it was not made here, and is left alone.
"""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from errno import EISDIR
from pathlib import Path
from secrets import token_hex
from shutil import copy2, rmtree
from stat import S_IFDIR, S_IFMT, S_IFREG

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
FILE_TYPES = {NEW: S_IFDIR, OLD: S_IFDIR, JOURNAL: S_IFREG, DRAFT: S_IFREG, LOCK: S_IFREG}
"""What may stand in a workplace, none of it a link."""
WORKPLACE = re.compile(re.escape(PREFIX) + "[0-9a-f]{16}")
NO_LINK = getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
"""Flags to open a file that may be a link or a pipe of somebody else; Windows has neither."""


class CannotWrite(InputError):
    """A folder that cannot be written, for example on a full disk: what comes next would fail, too."""


class Taken(Exception):
    """A file of a set exists already."""


@contextmanager
def atomic_folder(folder: Path, replacing: bool = True) -> Iterator[Path]:
    """Yield an empty folder whose files move into ``folder`` at the end; if anything fails, none of them are left.

    Raises CannotWrite, in one line, if the folder cannot be written; and Taken, unless ``replacing``, if one of the
    files exists at the end.
    """
    made: list[Path] = []
    try:
        made += [path for path in (folder, *folder.parents) if not path.exists()]
        folder.mkdir(parents=True, exist_ok=True)
        with _workplace(folder) as work:
            yield work / NEW
            with _locked(folder):
                _commit(folder, work, replacing)
    except BaseException as error:
        for path in made:
            with suppress(OSError):  # another run uses it already
                path.rmdir()
        if isinstance(error, OSError):
            raise CannotWrite(_refusal(folder, error)) from error
        raise


def clear_up(folder: Path) -> None:
    """Complete or undo killed runs in a folder. Raises CannotWrite if the folder cannot be written."""
    try:
        if folder.is_dir():
            with _locked(folder):
                _recover(folder)
    except OSError as error:
        raise CannotWrite(_refusal(folder, error)) from error


def _refusal(folder: Path, error: OSError) -> str:
    reason = error.strerror or type(error).__name__
    return f"cannot write into {str(folder)!r}: {reason}; choose another folder"


@contextmanager
def _workplace(folder: Path) -> Iterator[Path]:
    """Recover from killed runs, then yield a new folder in which a set is written."""
    token = token_hex(8)
    work = folder / (PREFIX + token)
    with ExitStack() as stack:
        stack.callback(_remove, work)
        with _locked(folder):
            _recover(folder)
            work.mkdir()
            lock = os.open(work / LOCK, os.O_CREAT | os.O_EXCL | os.O_RDWR)
            stack.callback(os.close, lock)
            flock(lock, LOCK_EX | LOCK_NB)
        os.write(lock, token.encode())
        for name in (NEW, OLD):
            (work / name).mkdir()
        yield work


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
    """Complete or undo killed runs; leave the files of running ones, and all that no run has made."""
    for name in filter(WORKPLACE.fullmatch, os.listdir(folder)):
        with suppress(OSError):  # it is locked, or its run has just removed it
            _recover_one(folder, folder / name)


def _recover_one(folder: Path, work: Path) -> None:
    """Complete or undo a run whose workplace is not locked. Raises OSError if that fails, or if it is no workplace."""
    if work.is_symlink():
        return
    if not os.listdir(work):
        work.rmdir()
        return
    lock = os.open(work / LOCK, os.O_RDWR | NO_LINK)
    try:
        flock(lock, LOCK_EX | LOCK_NB)
        if not _made_here(work, os.read(lock, 100).decode(errors="replace")):
            return
        if (work / JOURNAL).exists():
            _move(folder, work)
    finally:
        os.close(lock)
    _remove(work)


def _made_here(work: Path, locked: str) -> bool:
    """Whether a run made a workplace, from what its lock holds and what is in it."""
    kinds = {entry.name: S_IFMT(entry.stat(follow_symlinks=False).st_mode) for entry in os.scandir(work)}
    if not locked:
        return kinds == {LOCK: S_IFREG}  # killed as it began
    known = locked == _token(work) and kinds.items() <= FILE_TYPES.items()
    return known and (JOURNAL not in kinds or _journal(work) is not None)


def _token(work: Path) -> str:
    return work.name.removeprefix(PREFIX)


def _journal(work: Path) -> list[str] | None:
    """Return the names in the journal of a workplace, [] if it is empty or cut off, None if another program made it."""
    try:
        journal = json.loads((work / JOURNAL).read_text(encoding="utf-8"))
    except (ValueError, RecursionError):
        return []
    if not isinstance(journal, dict) or journal.keys() != {"token", "files"} or journal["token"] != _token(work):
        return None
    names = journal["files"]
    return names if isinstance(names, list) and all(map(_is_plain, names)) else None


def _is_plain(name: object) -> bool:
    return isinstance(name, str) and name == os.path.basename(name) and name not in ("", os.curdir, os.pardir)


def _commit(folder: Path, work: Path, replacing: bool) -> None:
    """Move all new files to their places, or none of them."""
    names = sorted(os.listdir(work / NEW))
    for name in names:
        if (folder / name).is_dir():
            raise IsADirectoryError(EISDIR, f"{name!r} is a folder there")
        if not replacing and (folder / name).exists():
            raise Taken(name)
        _flush(work / NEW / name)
    _flush(work / NEW)
    draft = work / DRAFT
    draft.write_text(json.dumps({"token": _token(work), "files": names}), encoding="utf-8")
    _flush(draft)
    os.replace(draft, work / JOURNAL)
    _flush(work)
    _move(folder, work)
    _flush(folder)


def _flush(path: Path) -> None:
    """Wait until a file, or what a folder lists, is on disk: a journal must not outlive the files that it lists."""
    if sys.platform == "win32" and path.is_dir():  # Windows does not open folders
        return
    file = os.open(path, os.O_RDONLY if path.is_dir() else os.O_RDWR)
    try:
        os.fsync(file)
    finally:
        os.close(file)


def _move(folder: Path, work: Path) -> None:
    """Move the remaining new files; if that fails, put everything back."""
    try:
        for name in sorted(os.listdir(work / NEW)):
            target, kept = folder / name, work / OLD / name
            if target.exists() and not kept.exists():
                _keep(target, kept)
            os.replace(work / NEW / name, target)
    except OSError:
        left = os.listdir(work / NEW)
        for name in _journal(work) or os.listdir(work / OLD):
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
        copy2(file, draft, follow_symlinks=False)
        os.replace(draft, kept)


def _remove(work: Path) -> None:
    """Remove a workplace: its journal first, or else its new files would be missed, and last the lock, which tells that
    the rest was made here.
    """
    with suppress(OSError):
        (work / JOURNAL).unlink(missing_ok=True)
        for name in (NEW, OLD):
            rmtree(work / name, ignore_errors=True)
        for name in (DRAFT, LOCK):
            (work / name).unlink(missing_ok=True)
        work.rmdir()
