"""Bodies: the parts of shapes that single rays are tested against, whether a camera or an array gives the rays.

A sphere or a plane is one body, a mesh is one body for each triangle. Each body has a box in the world, so that a tree
of boxes (``core.any_rays.tree``) finds the bodies that a ray may meet.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any

import numpy as np

from ..maths.speed import Scratch

Vectors = Any
"""Three components, (m,) each, or numbers."""


class Bodies(ABC):
    """The bodies of the shapes of one kind, as seen from the world's origin."""

    at: np.ndarray
    """(n,) indices into ``Shapes``, ascending unless parts were asked for."""
    number: np.ndarray
    """(n,) int32: the triangle of the mesh, ascending within a shape; 0 for other shapes."""
    low: np.ndarray
    """(3, n): the lowest corners of boxes that hold the bodies, world; -inf for bodies without an end."""
    high: np.ndarray
    """(3, n): the highest corners."""
    twice: bool = True
    """Whether a ray may meet a body more than once."""

    @abstractmethod
    def meet(self, body: Any, origin: Vectors, direction: Vectors, start: Any, scratch: Scratch) -> np.ndarray:
        """Return the least t >= ``start`` at which rays meet bodies, (m,); NaN or inf where they do not.

        ``body`` has one index for each ray, or is one number for all of them.
        """

    def prepared(self, origin: np.ndarray) -> Bodies:
        """Return the bodies, ready for many rays with these origins, (3, n): they meet the same to the bit."""
        return self

    @abstractmethod
    def is_hit(self, body: np.ndarray, origin: Vectors, direction: Vectors, t: np.ndarray) -> Any:
        """Return which crossings, (m,), are hits, where their surfaces are not transparent; True for all."""


def places_of(values: np.ndarray, body: Any) -> np.ndarray:
    """Return the entries (..., m) of values (..., n) for bodies, or (...) for one number."""
    return values[..., body] if np.ndim(body) == 0 else values.take(body, axis=-1, mode="wrap")
