"""What makes numpy's loops fast: rows taken whole, working arrays kept, threads that do not wait for each other.

A ufunc with an operand that is broadcast, or a window of a larger array, copies it to a buffer first, unless a row of
it fills the buffer: a row plus a column then costs as little as two whole arrays, three to five times less than
otherwise (measured with numpy 1.26 and 2.5). The buffer's size has to be a multiple of 16, so windows are as wide.
Source: numpy's manual, setbufsize.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from math import prod, sqrt
from threading import Event, Lock
from typing import Any, Generic, TypeVar, overload

import numpy as np

T = TypeVar("T")

MULTIPLE = 16
"""What widths of windows are multiples of."""

NARROW = 128
"""Rows with fewer pixels are better copied: the loop's start costs more."""

STRIP = 36
"""The fewest rows that are worked on together, where nothing else tells."""


def processors() -> int:
    """Return how many processors this process may use: whoever has started it may hold it to some of them."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def sharing(threads: int, work: float) -> int:
    """Return how many of some threads gain by sharing work. Beside it each share has a part, counted as 1, that threads
    do one at a time, holding the interpreter: n threads take work / n + 1 at least, and n at least.
    """
    return max(1, min(threads, round(sqrt(work))))


def taken(values: np.ndarray, which: np.ndarray) -> np.ndarray:
    """Return ``values[..., which]`` of indices that are there: numpy's check of them would be 0.4 of the time."""
    return values.take(which, axis=-1, mode="wrap")


def merged(values: np.ndarray) -> np.ndarray:
    """Return the first of values (n,), as (1,), where all are the same: what is taken by it broadcasts."""
    return values[:1] if (values == values[:1]).all() else values


def write_where(out: np.ndarray, values: Any, where: np.ndarray | None) -> None:
    """Write what broadcasts to ``out``, (rows, columns[, channels]), where a mask (rows, columns) is set, if any.
    Channel by channel: all at once takes four to seven times as long.
    """
    if where is None:
        return
    if out.ndim == where.ndim:
        np.copyto(out, values, where=where, casting="same_kind")
        return
    values = np.broadcast_to(values, out.shape)
    for channel in range(out.shape[-1]):
        np.copyto(out[..., channel], values[..., channel], where=where, casting="same_kind")


@contextmanager
def whole_rows(width: int) -> Iterator[None]:
    """Let this thread's ufuncs take rows of ``width`` at once, where that helps."""
    if width < NARROW or width % MULTIPLE:
        yield
        return
    usual = np.setbufsize(width)
    try:
        yield
    finally:
        np.setbufsize(usual)


def widened(bounds, width: int) -> tuple[slice, slice]:
    """Return the window of some bounds, as much wider as ``whole_rows`` likes it, within a tile of this width."""
    x0, x1, y0, y1 = bounds
    wide = min(-(-(x1 - x0) // MULTIPLE) * MULTIPLE, width)
    x0 = min(x0, width - wide)
    return slice(y0, y1), slice(x0, x0 + wide)


class Scratch:
    """Working arrays of one thread, lent again and again: asking the system for memory costs more than arithmetic."""

    def __init__(self, real=np.float64):
        self._real = real
        self._arrays: dict[tuple, np.ndarray] = {}
        self.noted: dict[str, Any] = {}
        """What the search of a tile notes for its passes, by name, until that of the next one does."""

    def __call__(self, name: str, shape, dtype=None) -> np.ndarray:
        """Return the array of this name and dtype in this shape; it holds what was last written to it, or anything."""
        size, dtype = prod(shape), dtype or self._real
        found = self._arrays.get((name, dtype))
        if found is None or found.size < size:
            found = self._arrays[name, dtype] = np.empty(size, dtype)
        return found[:size].reshape(shape)


class Shared(Generic[T]):
    """Parts of a piece of work that threads share: who needs the results works on parts until none is left, and waits
    for those that others have begun.
    """

    def __init__(self, parts: Sequence[Callable[[], T]]):
        self._parts, self._next, self._lock = parts, iter(range(len(parts))), Lock()
        self._results: list[T | None] = [None] * len(parts)
        self._left, self._ended = len(parts), Event()
        self._error: BaseException | None = None
        if not parts:
            self._ended.set()

    def work(self) -> Iterator[None]:
        """Work on parts until none is left, one between two steps of the iteration."""
        while True:
            with self._lock:
                k = next(self._next, None)
            if k is None:
                return
            self._run(k)
            yield

    def results(self) -> list[T]:
        """Return what the parts return, in their order; raises what the first that failed has raised."""
        for _ in self.work():
            pass
        self._ended.wait()
        if self._error is not None:
            raise self._error
        return self._results  # type: ignore[return-value]  # all are there

    def _run(self, k: int) -> None:
        try:
            if self._error is None:
                self._results[k] = self._parts[k]()
        except BaseException as error:
            self._error = error
            raise
        finally:
            with self._lock:
                self._left -= 1
                if not self._left:
                    self._ended.set()


class lazy(Generic[T]):
    """A property that is worked out when it is first asked for: functools.cached_property without its lock, which up to
    Python 3.11 lets one thread at a time work out a property, of whatever object (CPython's issue 87634). With the lock
    depth and normal of 1,000 spheres in an equirectangular panorama took 1.16 times the time, with two threads.
    """

    def __init__(self, func: Callable[[Any], T]):
        self.func, self.__doc__ = func, func.__doc__

    def __set_name__(self, owner, name: str) -> None:
        self._name = name

    @overload
    def __get__(self, instance: None, owner) -> lazy[T]: ...
    @overload
    def __get__(self, instance: object, owner) -> T: ...
    def __get__(self, instance, owner):
        if instance is None:
            return self
        value = instance.__dict__[self._name] = self.func(instance)
        return value
