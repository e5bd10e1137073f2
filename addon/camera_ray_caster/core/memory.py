"""Checks, before anything is allocated, of whether the system has enough memory for it; and what it has run out of."""

import ctypes
import errno
import os
import platform
from collections.abc import Iterator
from contextlib import contextmanager

from .records import InputError

ALWAYS_THERE = 1 << 28
"""Number of bytes up to which ``require`` does not ask the system."""


class _Status(ctypes.Structure):
    """The structure MEMORYSTATUSEX of Windows."""

    _fields_ = [("length", ctypes.c_ulong), ("load", ctypes.c_ulong)] + [
        (name, ctypes.c_ulonglong)
        for name in ("physical", "free", "commit", "free_commit", "virtual", "free_virtual", "extended")
    ]


def available() -> int | None:
    """Return the number of bytes available without harm to other processes; None if the system does not report it.

    Linux: its own estimate plus the free swap. Windows: the bytes that a process may still commit. Elsewhere, as on
    macOS, all physical memory, since the part that other processes use is not known.
    """
    try:
        system = platform.system()
        if system == "Windows":
            status = _Status(ctypes.sizeof(_Status))
            known = getattr(ctypes, "windll").kernel32.GlobalMemoryStatusEx(ctypes.byref(status))  # noqa: B009
            return int(status.free_commit) if known else None
        if system == "Linux":
            with open("/proc/meminfo", encoding="ascii") as lines:
                kilobytes = {name: int(amount.split()[0]) for name, amount in (line.split(":") for line in lines)}
            return 1024 * (kilobytes["MemAvailable"] + kilobytes.get("SwapFree", 0))
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (OSError, ValueError, KeyError):
        return None


LESS = "render a border of the frame (Ctrl B, and crop to it), fewer pixels or fewer passes"


def require(needed: int, arrays: str, cure: str = LESS) -> None:
    """Raise InputError if ``arrays``, named in the plural, needs more bytes than are available."""
    there = available() if needed > ALWAYS_THERE else None
    if there is not None and needed > there:
        raise InputError(
            f"{arrays} take {needed / 2**30:.3g} GiB of memory and {there / 2**30:.3g} GiB are available: {cure}"
        )


def of_pixels(arrays: str, shape: tuple[int, ...]) -> str:
    """Return ``arrays`` followed by its size in pixels, as text; ``shape`` is (rows, columns)."""
    return f"{arrays} of {' x '.join(str(side) for side in reversed(shape))} pixels"


EXHAUSTED = {errno.EMFILE: "open files", errno.ENFILE: "open files", errno.ENOMEM: "memory", errno.EAGAIN: "processes"}


@contextmanager
def limits_as_input() -> Iterator[None]:
    """Raise InputError if the process runs out of memory, threads or open files inside the context."""
    try:
        yield
    except (MemoryError, RuntimeError, OSError) as error:
        resource = EXHAUSTED.get(error.errno or 0) if isinstance(error, OSError) else None
        if isinstance(error, MemoryError):
            resource = "memory"
        if isinstance(error, RuntimeError) and "start new thread" in str(error):
            resource = "threads"
        if resource is None:
            raise
        remedy = "raise the limits of this process (ulimit), or end other programs"
        raise InputError(f"not enough {resource}: {remedy}") from error
