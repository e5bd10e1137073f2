"""How much memory work takes and how much there is: asked before anything is allocated, not after half of it."""

from __future__ import annotations

import ctypes
import os
import platform

from .records import InputError

ALWAYS_THERE = 1 << 28
"""Bytes for which nobody asks."""


class _Status(ctypes.Structure):
    """Windows' MEMORYSTATUSEX."""

    _fields_ = [("length", ctypes.c_ulong), ("load", ctypes.c_ulong)] + [
        (name, ctypes.c_ulonglong)
        for name in ("physical", "free", "commit", "free_commit", "virtual", "free_virtual", "extended")
    ]


def available() -> int | None:
    """Return the bytes that can still be had without harm to others; None where the system does not say.

    Linux: what it estimates, and free swap. Windows: what a process may still commit. Elsewhere, as on macOS, all that
    is built in: what others hold of it is not known.
    """
    try:
        system = platform.system()
        if system == "Windows":
            status = _Status(ctypes.sizeof(_Status))
            known = getattr(ctypes, "windll").kernel32.GlobalMemoryStatusEx(ctypes.byref(status))  # noqa: B009
            return int(status.free_commit) if known else None
        if system == "Linux":
            with open("/proc/meminfo", encoding="ascii") as lines:
                kilobytes = {name: int(rest.split()[0]) for name, rest in (line.split(":") for line in lines)}
            return 1024 * (kilobytes["MemAvailable"] + kilobytes.get("SwapFree", 0))
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (OSError, ValueError, KeyError):
        return None


LESS = "render a border of the frame (Ctrl B, and crop to it), fewer pixels or fewer passes"


def require(needed: int, what: str, cure: str = LESS) -> None:
    """Raise InputError where something, named in the plural, needs more bytes than there are."""
    there = available() if needed > ALWAYS_THERE else None
    if there is not None and needed > there:
        raise InputError(
            f"{what} take {needed / 2**30:.3g} GiB of memory and {there / 2**30:.3g} GiB are there: {cure}"
        )


def of_pixels(what: str, shape: tuple[int, ...]) -> str:
    """Return words for what there is of rows and columns of pixels."""
    return f"{what} of {' x '.join(str(side) for side in reversed(shape))} pixels"
