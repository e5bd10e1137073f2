"""Large tables in records, shared instead of written out."""

from collections.abc import Sequence

import numpy as np


class Entries(Sequence):
    """A large table for ``look_up``, (n,) float64: records share it, instead of the numbers of each look-up.

    It is a column of ``table``, (n, k), whose other columns are looked up at the same places.
    """

    def __init__(self, table: np.ndarray, column: int = 0):
        self.table, self.column = table, column
        self.values = np.ascontiguousarray(table[:, column], np.float64)

    def __len__(self) -> int:
        return len(self.values)

    def __getitem__(self, index):
        return self.values[index]

    def __iter__(self):
        return iter(self.values.tolist())

    def __array__(self, dtype=None, copy=None) -> np.ndarray:
        return np.array(self.values, dtype) if copy or dtype not in (None, np.float64) else self.values

    def __repr__(self) -> str:
        return f"<{len(self)} entries at {id(self):#x}>"
