"""Requests to stop the running work, by a signal or by Blender's window.

The signal handler raises no exception at first, because Python may run it in a callback of Blender's, which prints and
drops exceptions. It sets a flag, which long work polls. A second signal ends the process at once.
"""

import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from threading import Thread, current_thread, local, main_thread

from ...core.records import Cancelled

STOPPED = "stopped; no unfinished files were left behind"

_stopping = False
_others = local()
"""``asks``: further functions that a thread polls in addition to the signals; a render has its own thread."""


def stop(*_) -> None:
    """Request a stop; on the second call, raise KeyboardInterrupt. A handler for ``signal.signal``."""
    global _stopping
    if _stopping:
        raise KeyboardInterrupt
    _stopping = True


def is_stopping() -> bool:
    """Return whether a stop has been requested."""
    return _stopping or any(ask() for ask in getattr(_others, "asks", ()))


@contextmanager
def heard(ask: Callable[[], bool]) -> Iterator[None]:
    """Also poll ``ask`` during this thread's work inside the context, for example for Esc in a window."""
    before = getattr(_others, "asks", ())
    _others.asks = (*before, ask)
    try:
        yield
    finally:
        _others.asks = before


@contextmanager
def leaving(words: str) -> Iterator[None]:
    """End the process at once, with a message and status 130, if a handled signal arrives inside the context.

    This is for long work in C code that does not poll and lets no Python handler run. It does nothing outside the main
    thread, because other threads receive no signals.
    """
    if current_thread() is not main_thread():
        yield
        return
    reading, writing = os.pipe()
    os.set_blocking(writing, False)

    def leave() -> None:
        if os.read(reading, 1):
            with suppress(OSError):  # standard error is closed
                os.write(2, f"{words}\n".encode())
            os._exit(130)

    watching = Thread(target=leave, daemon=True)
    before = signal.set_wakeup_fd(writing, warn_on_full_buffer=False)
    watching.start()
    try:
        yield
    finally:
        signal.set_wakeup_fd(before)
        os.close(writing)
        watching.join()
        os.close(reading)


def raise_if_stopping() -> None:
    """Raise Cancelled if a stop has been requested."""
    if is_stopping():
        raise Cancelled


def reset() -> None:
    """Forget a requested stop, so that it does not affect later work."""
    global _stopping
    _stopping = False
