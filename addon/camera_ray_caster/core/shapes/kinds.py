"""The kinds of shapes. A new kind is its file and one word in KINDS; ``kind`` says what it has to do."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from .kind import Kind
from .mesh import MESHES
from .plane import INFINITE_PLANES, PLANES
from .sphere import SPHERES

KINDS: tuple[Kind, ...] = (SPHERES, PLANES, INFINITE_PLANES, MESHES)
"""Every kind, in the order of the report."""


def by_kind(numbers: np.ndarray) -> Iterator[tuple[Kind, np.ndarray]]:
    """Yield each kind whose number is among some, and where it is, bool of their shape; others are no kind's."""
    for kind in KINDS:
        some = numbers == kind.number
        if some.any():
            yield kind, some
