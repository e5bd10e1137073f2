"""Unit normals of many shapes at once: a table of constants, looked up by each pixel's shape, if the kind has them.

The last column is 0, for pixels that hit nothing (index -1).
"""

from dataclasses import dataclass

import numpy as np

from .. import tuning
from .kind import PixelNormals
from .kinds import by_kind
from .shape_frames import InCamera


@dataclass(frozen=True)
class NormalTable:
    """The normals of shapes, world frame; see ``Kind.normals``."""

    gain: np.ndarray | None
    """(n + 1,); None if all are 0, as for planes."""
    offset: np.ndarray
    """(3, n + 1); 0 for shapes without constants."""
    unit: bool
    """Whether gain times point plus offset has unit length without being normalized."""
    others: tuple[tuple[np.ndarray, PixelNormals], ...]
    """For each kind with shapes without constants: which they are, (n + 1,) bool, and the function for normals."""

    @property
    def is_sum(self) -> bool:
        """Whether every normal is just gain times point plus offset."""
        return self.unit and not self.others


def normal_table(shapes: InCamera, seen: np.ndarray) -> NormalTable:
    """Return the table of the shapes that can be seen, given as indices into ``Shapes``."""
    table = np.zeros((4, len(shapes.shapes) + 1))
    others = []
    for kind, of_kind in by_kind(shapes.shapes.kind[seen]):
        constants, normals = kind.normals(shapes, seen[of_kind])
        table[:, seen[of_kind]] = constants.T
        if normals is not None:
            is_other = np.zeros(table.shape[1], bool)
            is_other[seen[of_kind]] = np.isnan(constants[:, 0])
            others.append((is_other, normals))
    table[np.isnan(table)] = 0.0
    far = np.abs(table[1:]).max(initial=0.0)
    gain = table[0] if table[0].any() else None
    return NormalTable(gain, table[1:], bool(far < tuning.FAR_SPHERE), tuple(others))
