"""Kinds whose shapes are affine images of one surface, world = center + axes @ q: each shape is a row of constants.

Such a kind says how rays cross its surface in the frame of q; windows, batches and frames are taken care of here.
"""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from ..maths.speed import Scratch, lazy, merged
from ..maths.vector import components, difference, matrix_rows, matvec
from .affine_search import AffineSet, Group, divide
from .frames import InCamera, WorldRays
from .kind import HitPixels, Kind, ShapeErrors, Visible
from .local_rays import LocalRays


class Lattice(Protocol):
    """Some shapes and the rays of a pinhole, whose directions' x is a row, y a column and z a number."""

    def meet(self, k: int, window: tuple[slice, slice], scratch: Scratch) -> tuple[Any, Any]:
        """Return what ``AffineKind.intersect`` does, of the k-th shape in a window of the rays; see ``Large.solve``."""


class AffineKind(Kind):
    """A kind of shape that is tested by constants of its own."""

    faces_eye = False
    """Whether all normals face rays from the eye as they come; else those of shapes do that the eye is outside of."""

    @abstractmethod
    def constants(self, shapes: InCamera, at: np.ndarray, parallel: Any) -> Any:
        """Return a dataclass of arrays, whose last axis counts the shapes at these indices; for
        ``parallel`` see ``Visible``.
        """

    @abstractmethod
    def intersect(
        self, constants: Any, origin: Any, direction: Any, start: float | None, scratch: Scratch
    ) -> tuple[Any, Any]:
        """Return t of the first crossing at or beyond ``start``, and where it is one, as ``Large.solve`` does.

        ``constants`` hold one shape, or shapes shaped to broadcast with the rays. origin is None for rays from the eye,
        else three broadcastable components in the camera frame, as direction is. start is None where the eye is
        outside and nothing of the shape lies before the clip start. A ray that is NaN hits nothing.
        """

    def lattice(self, constants: Any, direction: Any) -> Lattice | None:
        """Return the fast path of large shapes, whose constants have two axes behind the one that counts them, for the
        eye outside and the rays of a pinhole; None, the default, where there is none.
        """
        return None

    @abstractmethod
    def surface_uv(self, q: Any) -> tuple[np.ndarray, np.ndarray]:
        """Return u and v at points of the surface, components in its own frame."""

    @abstractmethod
    def root_error(self, hits: AffineErrors) -> np.ndarray:
        """Return how far ``hits.tau`` may be from the exact crossing; NaN or inf where nothing is known."""

    @abstractmethod
    def normal_error(self, hits: AffineErrors, point: np.ndarray) -> np.ndarray:
        """Return the bound of the unit normal: see ``ShapeErrors``."""

    @abstractmethod
    def decide(self, shapes: InCamera, local: LocalRays) -> tuple[Any, Any]:
        """Return what ``decision`` does."""

    def shape_set(self, shapes: InCamera, visible: Visible) -> AffineSet:
        """See ``Kind``."""
        groups = []
        for part, is_simple, is_small in divide(visible):
            constants = _rounded(self.constants(shapes, part.at, part.parallel), part.real)
            groups.append(Group(self.intersect, self.lattice, part, is_simple, is_small, constants))
        return AffineSet(tuple(groups), self.faces_eye or all(group.is_simple for group in groups))

    def uv(self, shapes: InCamera, pixels: HitPixels, point: Any) -> tuple[np.ndarray, np.ndarray]:
        """See ``Kind``; the points in the frame of q are right to EPS (distance / size)."""
        at = merged(pixels.at)
        offset = difference(point, components(shapes.shapes.center[at] - shapes.pose.eye))
        return self.surface_uv(matvec(matrix_rows(shapes.shape_from_world[at]), offset))

    def errors(self, shapes: InCamera, pixels: HitPixels, rays: WorldRays, from_eye: bool, unit: bool) -> AffineErrors:
        """See ``Kind``."""
        return AffineErrors(self, shapes, pixels, LocalRays(shapes, pixels.at, rays, from_eye), unit)

    def decision(self, shapes: InCamera, at: np.ndarray, rays: WorldRays, from_eye: bool) -> tuple[Any, Any]:
        """See ``Kind``."""
        return self.decide(shapes, LocalRays(shapes, at, rays, from_eye))


@dataclass(frozen=True, eq=False)
class AffineErrors(ShapeErrors):
    """The error bounds of hits of one affine kind, and what they follow from."""

    kind: AffineKind
    shapes: InCamera
    pixels: HitPixels
    local: LocalRays
    unit: bool
    """Whether normals from constants keep the length they come with."""

    @lazy
    def tau(self) -> np.ndarray:
        """The t of the scaled rays."""
        return self.pixels.t / self.local.frame.scale

    @property
    def t(self) -> np.ndarray:
        """See ``ShapeErrors``."""
        return self.kind.root_error(self) * self.local.frame.scale

    def normal(self, point: np.ndarray) -> np.ndarray:
        """See ``ShapeErrors``."""
        return self.kind.normal_error(self, point)


def _rounded(constants, real: type):
    """Return constants as what is calculated with; NaN, which hits nothing, where float32 does not reach."""
    if real is np.float64:
        return constants
    largest = float(np.finfo(real).max)
    values = (getattr(constants, name) for name in constants.__dataclass_fields__)
    return type(constants)(*(np.where(np.abs(value) <= largest, value, np.nan).astype(real) for value in values))
