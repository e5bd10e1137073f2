"""Rays in the frames of the shapes that they hit, with their rounding errors.

Values that depend on the shape alone, which are most of the work, are computed once and looked up for each ray.
"""

from typing import Any

import numpy as np

from ..conventions import gamma
from ..maths.speed import lazy, taken
from ..maths.vector import difference, dot, norm
from .shape_frames import InCamera, Offsets, WorldRays


class Lookup:
    """The arrays (..., n) of an object, with one entry per shape, looked up for each ray at first use."""

    def __init__(self, tables: Any, at: np.ndarray):
        self._tables, self._at = tables, at

    def of(self, table: np.ndarray) -> np.ndarray:
        """Return the entries of a table of all shapes for the rays."""
        return taken(table, self._at)

    def row(self, name: str, i: int) -> np.ndarray:
        """Return row i of a named table for the rays."""
        return self.of(getattr(self._tables, name)[i])

    def __getattr__(self, name: str) -> np.ndarray:
        value = self.__dict__[name] = self.of(getattr(self._tables, name))
        return value


class LocalRays:
    """Rays in the frames of shapes, one shape per ray: q(t) = t D - N, with D scaled by a power of two to about 1."""

    def __init__(self, shapes: InCamera, at: np.ndarray, rays: WorldRays, from_eye: bool):
        """Take the shapes' indices, which broadcast with the rays, and whether all rays leave the eye."""
        self.rays, self.from_eye = rays, from_eye
        self.frame: Any = Lookup(shapes.frames, at)
        """The ``Frames`` of the rays."""
        self.offset: Any
        """The ``Offsets`` of the rays."""
        if from_eye:
            self.offset = Lookup(shapes.eye_offsets, at)
        else:
            center = self.frame.center
            moved = gamma(4) * (norm(center) + norm(rays.origin)) + rays.origin_error
            self.offset = Offsets(self.frame, difference(center, rays.origin), moved)

    @property
    def n(self) -> np.ndarray:
        """(3, ...): N."""
        return self.offset.vector

    @property
    def n_error(self) -> np.ndarray:
        """Upper bound of the error of N, as a vector's length."""
        return self.offset.error

    @lazy
    def d(self) -> np.ndarray:
        """(3, ...): D."""
        return dot(self.frame.matrix.swapaxes(0, 1), self.rays.direction)

    @lazy
    def d_error(self) -> np.ndarray:
        """Upper bound of the error of D, as a vector's length."""
        return self.frame.stretch * self.rays.direction_error + self.frame.error * self.rays.length

    def z(self) -> tuple[Any, Any, Any, Any]:
        """Return the z components of D and N, and their error bounds."""
        d = dot(self.frame.row("matrix", 2), self.rays.direction)
        turned = self.frame.row("row_error", 2) * self.rays.length
        d_error = self.frame.row("rows", 2) * self.rays.direction_error + turned
        return d, self.offset.row("vector", 2), d_error, self.offset.row("row_error", 2)

    @property
    def inner(self) -> Any:
        """N . D."""
        return dot(self.n, self.d)

    def product_error(self) -> np.ndarray:
        """Return an error bound of ``inner``, and of the cross product of N and D as a vector's length."""
        n, d = self.offset.length, norm(self.d)
        return n * self.d_error + d * self.n_error + self.n_error * self.d_error + gamma(4) * n * d

    def q(self, tau) -> np.ndarray:
        """Return the points tau D - N, (3, ...)."""
        return tau * self.d - self.n
