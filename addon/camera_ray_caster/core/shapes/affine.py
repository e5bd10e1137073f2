"""Kinds whose shapes are affine images of one surface, world = center + axes @ q: each shape is a row of constants.

Such a kind implements how rays cross its surface in the frame of q; this module handles windows, batches and frames.
"""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from ..maths.speed import Scratch, lazy, merged
from ..maths.vector import along, components, difference, dot, matrix_rows, matvec
from .affine_search import AffineSet, SearchGroup, divide
from .bodies import Bodies, places_of
from .cutouts import Cutouts, crossings
from .kind import HitPixels, Kind, ShapeErrors, Visible
from .local_rays import LocalRays
from .shape_frames import InCamera, WorldRays


class Lattice(Protocol):
    """Some shapes and the rays of a pinhole: the x of their directions is a row, y a column and z a number."""

    def meet(self, k: int, window: tuple[slice, slice], scratch: Scratch) -> tuple[Any, Any]:
        """Intersect the k-th shape with a window of the rays, and return t and the hits as ``Large.solve`` does."""


class AffineKind(Kind):
    """A kind of shape that is tested by means of a row of constants per shape."""

    faces_eye = False
    """Whether all normals face rays from the eye unturned; if False, those of shapes that the eye is outside of do."""

    @abstractmethod
    def constants(self, shapes: InCamera, at: np.ndarray, parallel: Any) -> Any:
        """Return a dataclass of arrays whose last axis counts the shapes at ``at``; ``parallel``: see ``Visible``."""

    @abstractmethod
    def intersect(
        self, constants: Any, origin: Any, direction: Any, start: Any, scratch: Scratch
    ) -> tuple[Any, Any]:
        """Return t of the first crossing at or beyond ``start``, and where t is a hit, as ``Large.solve`` does.

        ``start`` may be an array that broadcasts with the rays.
        ``constants`` hold one shape, or several shapes in arrays that broadcast with the rays. direction is three
        broadcastable components in the camera frame; so is origin, or it is None for rays from the eye. start is None
        if the eye is outside and no part of the shape lies before the clip start. A ray that is NaN hits nothing.
        """

    def lattice(self, constants: Any, direction: Any) -> Lattice | None:
        """Return the fast path for large shapes that the eye is outside of and for the rays of a pinhole; None, the
        default, if the kind has no such path. The constants have two more axes behind the axis that counts the shapes.
        """
        return None

    def in_front(self, constants: Any) -> np.ndarray | None:
        """Return linear functions, (n, 3, k), of the direction of a ray from the eye: on a hit the first is at least 0
        and at least the magnitude of each other one; None, the default, if the kind has none.
        """
        return None

    @abstractmethod
    def surface_coordinates(self, q: Any) -> tuple[np.ndarray, np.ndarray]:
        """Return the two coordinates of points of the surface, given as components in the frame of q."""

    @abstractmethod
    def root_error(self, hits: AffineErrors) -> np.ndarray:
        """Return how far ``hits.tau`` may be from the exact crossing; NaN or inf where no bound is known."""

    @abstractmethod
    def normal_error(self, hits: AffineErrors, point: np.ndarray) -> np.ndarray:
        """Return the error bound of the unit normal: see ``ShapeErrors``."""

    def shape_set(self, shapes: InCamera, visible: Visible) -> AffineSet:
        groups, cutouts = [], Cutouts.of(self, shapes, visible.at)
        for alike, is_simple, is_small, is_cut in divide(visible, None if cutouts is None else cutouts.may):
            constants = self.constants(shapes, alike.at, alike.parallel)
            cut_by = cutouts if is_cut else None
            tests = self.intersect, self.lattice, self.in_front
            groups.append(SearchGroup(*tests, alike, is_simple, is_small, constants, cut_by))
        faces_eye = self.faces_eye or all(group.is_simple for group in groups)
        return AffineSet(tuple(groups), faces_eye, cutouts is not None)

    def half_sides(self, axes: np.ndarray) -> Any:
        """Return half the sides, (k, 3), of boxes around shapes with these axes, (k, 3, 3), world; inf, the default,
        for boxes around the spheres that hold the shapes.
        """
        return np.inf

    def bodies(self, shapes: InCamera, at: np.ndarray, parts: np.ndarray | None = None) -> AffineBodies:
        """See ``Kind``: each shape is one body."""
        return AffineBodies(self, shapes, at)

    def uv(self, shapes: InCamera, pixels: HitPixels, point: Any) -> tuple[np.ndarray, np.ndarray]:
        """See ``Kind``: the coordinates, under the shape's map."""
        first, second = self.coordinates(shapes, pixels, point)
        if (maps := shapes.shapes.uv) is None:
            return first, second
        u, v = matrix_rows(maps[shapes.shapes.name_index[merged(pixels.at)]])
        return dot(u, (first, second, 1.0)), dot(v, (first, second, 1.0))

    def coordinates(self, shapes: InCamera, pixels: HitPixels, point: Any) -> tuple[np.ndarray, np.ndarray]:
        """See ``Kind``; the points in the frame of q have errors of EPS (distance / size)."""
        at = merged(pixels.at)
        offset = difference(point, components(shapes.shapes.center[at] - shapes.pose.eye))
        return self.surface_coordinates(matvec(matrix_rows(shapes.shape_from_world[at]), offset))

    def errors(self, shapes: InCamera, pixels: HitPixels, rays: WorldRays, from_eye: bool, unit: bool) -> AffineErrors:
        return AffineErrors(self, shapes, pixels, LocalRays(shapes, pixels.at, rays, from_eye), unit)


class AffineBodies(Bodies):
    """Shapes of one affine kind as bodies."""

    def __init__(self, kind: AffineKind, shapes: InCamera, at: np.ndarray):
        self.at, self.number = at, np.zeros(len(at), np.int32)
        half = np.minimum(kind.half_sides(shapes.shapes.axes[at]), shapes.radius[at, None])
        self.low, self.high = ((shapes.center[at] + sign * half).T for sign in (-1, 1))
        self._kind, self._constants = kind, kind.constants(shapes, at, None)
        self._cutouts = Cutouts.of(kind, shapes, at)

    def meet(self, body: Any, origin: Any, direction: Any, start: Any, scratch: Scratch) -> np.ndarray:
        constants = type(self._constants)(*(
            places_of(getattr(self._constants, name), body) for name in self._constants.__dataclass_fields__
        ))  # fmt: skip
        t, where = self._kind.intersect(constants, tuple(origin), tuple(direction), start, scratch)
        return np.array(t) if where is None else np.where(where, t, np.nan)

    def is_hit(self, body: np.ndarray, origin: Any, direction: Any, t: np.ndarray) -> Any:
        if self._cutouts is None:
            return True
        hit, at = np.ones(len(t), bool), self.at[body]
        cut = np.flatnonzero(self._cutouts.may[at])
        point = along(tuple(c[cut] for c in origin), tuple(c[cut] for c in direction), t[cut])
        hit[cut] = self._cutouts.hit(crossings(at[cut], t[cut], False), point)
        return hit


@dataclass(frozen=True, eq=False)
class AffineErrors(ShapeErrors):
    """The error bounds of hits on shapes of one affine kind, and the data that they follow from."""

    kind: AffineKind
    shapes: InCamera
    pixels: HitPixels
    local: LocalRays
    unit: bool
    """Whether normals from constants are left unnormalized."""

    @lazy
    def tau(self) -> np.ndarray:
        """t of the scaled rays."""
        return self.pixels.t / self.local.frame.scale

    @property
    def t(self) -> np.ndarray:
        return self.kind.root_error(self) * self.local.frame.scale

    def normal(self, point: np.ndarray) -> np.ndarray:
        return self.kind.normal_error(self, point)
