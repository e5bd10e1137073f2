"""The kinds of shapes. A new kind needs a file of its own and an entry in SHAPE_KINDS; ``kind`` has its interface."""

from collections.abc import Iterator

import numpy as np

from .kind import Kind
from .mesh.meshes import MESHES
from .plane import INFINITE_PLANES, PLANES
from .sphere import SPHERES

SHAPE_KINDS: tuple[Kind, ...] = (SPHERES, PLANES, INFINITE_PLANES, MESHES)
"""Every kind, in the order of the report."""


def by_kind(numbers: np.ndarray) -> Iterator[tuple[Kind, np.ndarray]]:
    """Yield each kind whose number occurs in ``numbers``, and where it occurs, bool of the same shape."""
    for kind in SHAPE_KINDS:
        of_kind = numbers == kind.number
        if of_kind.any():
            yield kind, of_kind
