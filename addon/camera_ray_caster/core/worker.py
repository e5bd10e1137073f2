"""A long piece of work on a thread of its own, so that a window stays alive: how far it is, and how to stop it."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, wait
from threading import Event
from typing import Any


class Worker:
    """Runs ``work(progress)``, which calls ``progress(fraction)`` now and then and raises where that returns False.

    ``finished``, if given, is called in the thread when the work is over, however it ended.
    """

    def __init__(self, work: Callable[[Callable[[float], bool]], Any], finished: Callable[[], None] | None = None):
        self.fraction = 0.0
        self._stopped = Event()
        pool = ThreadPoolExecutor(1)
        self._future = pool.submit(work, self._advance)
        pool.shutdown(wait=False)
        if finished is not None:
            self._future.add_done_callback(lambda _: finished())

    @property
    def done(self) -> bool:
        """Whether it is over: with a result, an error, or stopped."""
        return self._future.done()

    def result(self):
        """Wait for the end and return the result, or raise what the work raised."""
        return self._future.result()

    def stop(self) -> None:
        """Ask it to stop, and wait until it has: as long as one step of its progress."""
        self._stopped.set()
        wait([self._future])

    def _advance(self, fraction: float) -> bool:
        self.fraction = fraction
        return not self._stopped.is_set()
