"""Pixel coordinates given by a caller: checked, divided into blocks for threads, and divided by time."""

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
"""Number of pixels whose rays take as long as the serial part of a thread's share: see ``sharing``."""


def checked_pixels(x, y) -> tuple[np.ndarray, np.ndarray, tuple[int, ...]]:
    """Return pixel coordinates as float64 arrays, and the shape to which they broadcast. Raises InputError for values
    that are not numbers and for shapes that do not broadcast.
    """
    x, y = numbers(x, "x"), numbers(y, "y")
    try:
        return x, y, np.broadcast_shapes(x.shape, y.shape)
    except ValueError as error:
        raise InputError(f"x and y have shapes {x.shape} and {y.shape}: give shapes that broadcast") from error


def in_blocks(put: Callable[[slice], None], shape: tuple[int, ...], pixels: int, rows: int = 1) -> None:
    """Call ``put`` in threads with the rows of a picture, in blocks of about ``pixels``, multiples of ``rows``."""
    height, width = shape
    threads = sharing(processors(), height * width / SHARED_PIXELS)
    step = rows * max(1, round(min(pixels / max(width, 1), height / threads) / rows))
    blocks = [slice(*ends) for ends in pairwise([*range(0, height, step), height])]
    if len(blocks) == 1:
        put(blocks[0])
        return
    with ThreadPoolExecutor(threads) as pool:  # numpy releases the interpreter
        list(pool.map(put, blocks))


def by_time(pixel_time: PixelTime, time: np.ndarray, x, y) -> Iterator[tuple]:
    """Yield (frame, x, y, place, where) for pixel coordinates and their times, frame by frame: ``x`` and ``y`` lie at
    ``place`` in an array of all coordinates, and the bool array ``where`` marks those that have this frame.
    """
    if is_grid(x, y):
        for frame, rows, columns, where in groups(pixel_time, x, y):
            yield frame, x[:, columns], y[rows], np.s_[rows, columns], where
        return
    x, y = np.broadcast_arrays(x, y)
    for frame in np.unique(time[~np.isnan(time)]):
        yield frame, x, y, np.s_[...], time == frame
