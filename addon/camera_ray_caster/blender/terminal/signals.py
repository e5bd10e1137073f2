"""Whether what is running has been asked to stop: by a signal, or by Blender's window.

A signal's handler raises nothing at first: Python may run it in a callback of Blender's, which prints an exception and
drops it. It remembers that it was called, and work that takes long asks. A second signal ends the process at once.
"""

import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from threading import Thread, current_thread, local, main_thread

from ...core.records import Cancelled

STOPPED = "stopped; what was under way has left nothing"

_stopping = False
_others = local()
"""``asks``: who is asked beside the signals in a thread; a render has one of its own."""


def stop(*_) -> None:
    """Ask what is running to end; the second time, raise KeyboardInterrupt. For ``signal.signal``."""
    global _stopping
    if _stopping:
        raise KeyboardInterrupt
    _stopping = True


def is_stopping() -> bool:
    """Return whether what is running has been asked to end."""
    return _stopping or any(ask() for ask in getattr(_others, "asks", ()))


@contextmanager
def heard(ask: Callable[[], bool]) -> Iterator[None]:
    """Ask another one, too, for the work of this thread that is going on: a window in which Esc is pressed."""
    before = getattr(_others, "asks", ())
    _others.asks = (*before, ask)
    try:
        yield
    finally:
        _others.asks = before


@contextmanager
def leaving(words: str) -> Iterator[None]:
    """End the process at once, with these words and status 130, where a signal arrives that it handles.

    For long work in C that asks nobody, and lets no handler run in the meantime. In other threads than the main one,
    which hear no signals, it does nothing.
    """
    if current_thread() is not main_thread():
        yield
        return
    reading, writing = os.pipe()
    os.set_blocking(writing, False)

    def leave() -> None:
        if os.read(reading, 1):
            with suppress(OSError):  # nobody reads it any more
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
    """Raise Cancelled where what is running has been asked to end."""
    if is_stopping():
        raise Cancelled


def reset() -> None:
    """Forget what was asked: what runs next is not concerned."""
    global _stopping
    _stopping = False
