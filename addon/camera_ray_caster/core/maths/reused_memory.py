"""Memory of large arrays that is used again: the system clears new memory page by page, which takes longer than to fill
it. The settings of the C library, which keeps small blocks itself, are those of the whole process and stay as they are.
"""

from math import prod

import numpy as np

LEAST_BYTES = 1 << 17
"""Minimum number of bytes of a block that is kept."""

MOST_BYTES = 1 << 26
"""Maximum number of bytes that are kept while no array uses them: four passes of 1920 x 1080. Nothing kept, neither
these nor working arrays: 1.25 times the processor time of 10 spheres and four passes, and of 1,000 and 10,000 spheres
and two.
"""

_unused: dict[int, list[np.ndarray]] = {}
"""Blocks by their number of bytes, the size used last at the end. A block is in one list, once, and is taken by
``pop``, which is one step of the interpreter: it is given once, even if the garbage collector or another thread gives
back blocks meanwhile. Of threads that give back, one may forget the blocks of the other.
"""


class _Block:
    """The memory of an array and its views, which hold it as their base."""

    def __init__(self, memory: np.ndarray):
        self._bytes, self.__array_interface__ = memory, memory.__array_interface__

    def __del__(self) -> None:
        size = self._bytes.nbytes
        blocks = _unused.pop(size, [])
        blocks.append(self._bytes)
        _unused[size] = blocks
        excess = sum(block_size * len(blocks) for block_size, blocks in list(_unused.items())) - MOST_BYTES
        for block_size in list(_unused):
            if excess > 0:
                excess -= block_size * len(_unused.pop(block_size, ()))


def _memory(size: int) -> np.ndarray:
    try:
        return _unused[size].pop()
    except (KeyError, IndexError):
        np.empty(size, np.uint8)  # freed at once: glibc keeps what is smaller than the largest block ever freed
        return np.empty(size, np.uint8)


def release() -> None:
    """Give all memory that is kept back to the system."""
    _unused.clear()


def empty(shape: tuple[int, ...], dtype) -> np.ndarray:
    """Return a C-contiguous array with arbitrary values, as ``np.empty`` does. Its memory is that of an array of as
    many bytes that nothing uses any longer, if there is one, and is kept when nothing uses this array and its views.
    """
    dtype = np.dtype(dtype)
    size = prod(shape) * dtype.itemsize
    if not LEAST_BYTES <= size <= MOST_BYTES:
        return np.empty(shape, dtype)
    return np.asarray(_Block(_memory(size))).view(dtype).reshape(shape)
