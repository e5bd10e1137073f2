"""Shares of a data set, K of N, that several processes make in one folder, and which of them still run.

A share has a file, ``.share_K_of_N``, and holds a lock on it while it runs; the file stays until the set is complete.
"""

import os
import re
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from ..file_set import LOCK_EX, LOCK_NB, flock
from ..records import InputError

NAME = re.compile(r"\.share_(\d+)_of_(\d+)")


@contextmanager
def running(folder: Path, shard: tuple[int, int] | None) -> Iterator[None]:
    """Mark a share as running inside the context. Raises InputError if it runs already, or if the folder has shares of
    another division.
    """
    if shard is None:
        yield
        return
    others = {number for _, number in existing(folder)}
    if others - {shard[1]}:
        raise InputError(
            f"{str(folder)!r} has shares of {min(others)}, and this is one of {shard[1]}: complete these first "
            "(--complete), or choose another folder"
        )
    path = folder / f".share_{shard[0]}_of_{shard[1]}"
    file = os.open(path, os.O_RDWR | os.O_CREAT)
    try:
        try:
            flock(file, LOCK_EX | LOCK_NB)
        except OSError as error:
            raise InputError(f"share {shard[0]}/{shard[1]} of {str(folder)!r} runs already: let it end") from error
        yield
    finally:
        os.close(file)


def existing(folder: Path) -> list[tuple[int, int]]:
    """Return the shares that have begun in a folder, each as K and N, in order."""
    names = os.listdir(folder) if folder.is_dir() else []
    return sorted((int(match[1]), int(match[2])) for match in map(NAME.fullmatch, names) if match)


def still_running(folder: Path) -> list[str]:
    """Return the shares that run now, as "K/N"."""
    busy = []
    for number, of in existing(folder):
        with suppress(FileNotFoundError):
            file = os.open(folder / f".share_{number}_of_{of}", os.O_RDWR)
            try:
                flock(file, LOCK_EX | LOCK_NB)
            except OSError:
                busy.append(f"{number}/{of}")
            finally:
                os.close(file)
    return busy


def forget(folder: Path) -> None:
    """Remove the files of shares: the set is complete. Those that still run keep theirs."""
    busy = still_running(folder)
    for number, of in existing(folder):
        if f"{number}/{of}" not in busy:
            (folder / f".share_{number}_of_{of}").unlink(missing_ok=True)
