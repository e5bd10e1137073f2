"""Blocks of rows and columns of a table of rays, within which rays are interpolated and across which they are not.

In block form an array of entries (rows, columns, ...) is (rows, columns of a block, blocks, ...), row of blocks by row.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...conventions import EPS32
from ...records import InputError

FOLDED = 8 * EPS32
"""Size, over the sides of a cell of unit vectors, of a volume that float32's rounding may have turned around."""


class EntryBlocks(NamedTuple):
    """Blocks of equal size that fill a table; a table without blocks is a single one."""

    size: tuple[int, int]
    """Rows and columns of a block."""
    per_axis: tuple[int, int]
    """Rows and columns of blocks."""

    @classmethod
    def of(cls, shape: tuple[int, int], size: tuple[int, int]) -> EntryBlocks:
        """Return the blocks of a table; a size of 0 is the table's. Raises InputError if they do not divide it."""
        rows, columns = (side or whole for side, whole in zip(size, shape, strict=True))
        if shape[0] % rows or shape[1] % columns:
            raise InputError(f"blocks of {columns} x {rows} entries do not divide a table of {shape[1]} x {shape[0]}: "
                             "fill it up with NaN")  # fmt: skip
        return cls((rows, columns), (shape[0] // rows, shape[1] // columns))

    @property
    def many(self) -> int:
        """Number of blocks."""
        return self.per_axis[0] * self.per_axis[1]

    def split(self, entries: np.ndarray) -> np.ndarray:
        """Return entries (rows, columns, ...) in block form."""
        (rows, columns), (down, across), last = self.size, self.per_axis, entries.shape[2:]
        blocks = entries.reshape(down, rows, across, columns, *last).swapaxes(1, 2)
        return np.moveaxis(blocks.reshape(self.many, rows, columns, *last), 0, 2)

    def joined(self, parts: np.ndarray) -> np.ndarray:
        """Return an array in block form, with any number of rows and columns in each block, as one of the table's."""
        (rows, columns), (down, across), last = parts.shape[:2], self.per_axis, parts.shape[3:]
        blocks = np.moveaxis(parts, 2, 0).reshape(down, across, rows, columns, *last).swapaxes(1, 2)
        return blocks.reshape(down * rows, across * columns, *last)

    def starts(self, axis: int) -> np.ndarray:
        """Return the first row (axis 0) or column of each row or column of blocks."""
        return np.arange(self.per_axis[axis]) * self.size[axis]


def check_neighbors(blocks: EntryBlocks, directions: np.ndarray, origins: np.ndarray | None) -> None:
    """Raise InputError for neighbors of a block more than 90 degrees apart, and if it folds: if the rays of some of its
    cells turn the other way round than those of most.
    """
    ahead = blocks.split(directions)
    for axis in (0, 1):
        lines = ahead.swapaxes(0, axis)
        apart = ((lines[:-1] * lines[1:]).sum(axis=3) < 0).swapaxes(0, axis)
        _refuse_in_block(blocks, apart, "is more than 90 degrees away from its neighbor's ray: give a finer table, or "
                         "NaN between parts of the picture that do not belong together")  # fmt: skip
    ways = _turns(ahead, ahead)
    if not any(way.any() for way in ways) and origins is not None:  # the rays are parallel
        ways = _turns(ahead, blocks.split(origins))
    left, right = (np.count_nonzero(way, axis=(0, 1)) for way in ways)
    _refuse_in_block(blocks, np.where(right < left, ways[1], ways[0]), "and its neighbors fold over: the table turns "
                     "back there, so that several pixels see one point")  # fmt: skip


def _turns(directions: np.ndarray, corners: np.ndarray) -> list[np.ndarray]:
    """Return which cells (rows - 1, columns - 1, blocks) turn one way, seen along their directions, and which the other
    way.
    """
    right, up = corners[:, 1:] - corners[:, :-1], corners[1:] - corners[:-1]
    right, up = right[1:] + right[:-1], up[:, 1:] + up[:, :-1]
    middle = directions[1:, 1:] + directions[:-1, :-1]
    volume = (middle * np.cross(right, up)).sum(axis=3)
    lengths = [np.sqrt((side * side).sum(axis=3)) for side in (right, up)]
    with np.errstate(invalid="ignore"):
        scale = np.nanmax(np.abs(corners)) * (lengths[0] + lengths[1])
        return [volume > FOLDED * scale, volume < -FOLDED * scale]


def refuse(where: np.ndarray, reason: str) -> None:
    """Raise InputError that names the first entry at which ``where`` (rows, columns) holds."""
    if where.any():
        row, column = np.argwhere(where)[0].tolist()
        raise InputError(f"the ray in column {column}, row {row} (from the bottom left) {reason}")


def _refuse_in_block(blocks: EntryBlocks, where: np.ndarray, reason: str) -> None:
    """Do the same for cells (rows - 1 or rows, columns - 1 or columns, blocks)."""
    short = [(0, side - n) for side, n in zip(blocks.size, where.shape[:2], strict=True)]
    refuse(blocks.joined(np.pad(where, (*short, (0, 0)))), reason)
