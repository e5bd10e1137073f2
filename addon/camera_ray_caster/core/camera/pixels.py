"""Pixel coordinates that are asked for: as they are given, in blocks for threads, and time by time."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise

import numpy as np

from ..arguments import numbers
from ..maths.speed import processors, sharing
from ..maths.vector import is_grid
from ..records import InputError
from .pixel_time import PixelTime, groups

SHARED_PIXELS = 1 << 17
"""Pixels whose rays take as long as what threads do one at a time for a share: see ``sharing``."""


def given(x, y) -> tuple[np.ndarray, np.ndarray, tuple[int, ...]]:
    """Return pixel coordinates as float64 arrays, and the shape to which they broadcast. Raises InputError for what are
    no numbers and for shapes that do not go together.
    """
    x, y = numbers(x, "x"), numbers(y, "y")
    try:
        return x, y, np.broadcast_shapes(x.shape, y.shape)
    except ValueError as error:
        raise InputError(f"x and y have shapes {x.shape} and {y.shape}: give shapes that broadcast") from error


def in_blocks(put: Callable[[slice], None], shape: tuple[int, ...], pixels: int, rows: int = 1) -> None:
    """Call ``put`` with all rows of a picture, about so many pixels at a time, a multiple of ``rows``, in threads."""
    height, width = shape
    threads = sharing(processors(), height * width / SHARED_PIXELS)
    step = rows * max(1, round(min(pixels / max(width, 1), height / threads) / rows))
    blocks = [slice(*ends) for ends in pairwise([*range(0, height, step), height])]
    with ThreadPoolExecutor(threads) as pool:  # numpy releases the interpreter
        list(pool.map(put, blocks))


def by_time(pixel_time: PixelTime, time: np.ndarray, x, y) -> Iterator[tuple]:
    """Yield (frame, x, y, place, where) of pixel coordinates and their times, frame by frame: those that are meant lie
    at ``place`` in an array of all, and ``where`` in it, bool.
    """
    if is_grid(x, y):
        for frame, rows, columns, where in groups(pixel_time, x, y):
            yield frame, x[:, columns], y[rows], np.s_[rows, columns], where
        return
    x, y = np.broadcast_arrays(x, y)
    for frame in np.unique(time):
        yield frame, x, y, np.s_[...], time == frame
