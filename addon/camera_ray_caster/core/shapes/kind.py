"""The contract of a kind of shape, and the records that its users hand over.

A kind is one object of a class under ``Kind`` and stands in ``KINDS``. These use it: ``in_camera`` (``extent``,
``is_close``), the plan and the search (``shape_set``), the passes (``normals``, ``uv``), the error bounds (``errors``,
``decision``). Nothing else in core knows what kinds there are.

Shapes that are affine images of one surface, each a row of constants, are kinds under ``AffineKind``, which does most
of it. What is no such row, as the triangles of a mesh, is a kind of its own: it implements ``ShapeSet.rest`` and not
``ShapeSet.large``, and keeps what else it has to know of a hit (which triangle) in an array of ``SearchRays.scratch``,
from which ``HitPixels.kept`` takes it again when normals, uv and errors are asked for, or in what the scratch notes.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Protocol

import numpy as np

from ..maths.speed import Scratch, lazy, taken
from ..records import Shapes
from .follow import Follow, follow_frames
from .frames import InCamera, WorldRays
from .search_rays import SearchRays


class PixelBounds(Protocol):
    """In which pixels of the plan something may be seen: (n, 4) int, x0, x1, y0, y1, x1 and y1 not included."""

    def of_balls(self, centers: np.ndarray, radii: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the bounds of balls in the camera's frame, (n, 3) and (n,), and which of them hold a pixel center.

        A radius may be infinite.
        """

    def within(self, bounds: np.ndarray) -> np.ndarray:
        """Return what bounds of the picture, (n, 4), are in the columns and rows that the plan has of it."""

    def least_t(self, centers: np.ndarray, radii: np.ndarray) -> np.ndarray:
        """Return no more than the least t of each ball, (n,); -inf where it is not known."""

    @property
    def has_straight_lines(self) -> bool:
        """Whether what lies between points is seen between their images, so that ``of_points`` may be asked."""

    @property
    def whole(self) -> np.ndarray:
        """(4,) int: all pixels of the plan."""

    def of_points(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the bounds of points (n, 3) in the camera's frame, most of which hold no pixel center, and which have
        an image that counts. What lies between some of them is seen from the least x0 and y0 to the largest x1 and y1.
        """


@dataclass(frozen=True, eq=False)
class Visible:
    """The shapes of one kind that some pixel may see, and how they are searched; one row a shape."""

    at: np.ndarray
    """(k,) indices into ``Shapes``, ascending."""
    bounds: np.ndarray
    """(k, 4) int: x0, x1, y0, y1 in the pixels of the plan, x1 and y1 not included."""
    near: np.ndarray
    """(k,): the least t that each may have, -inf where that is not known."""
    clip_start: float
    from_eye: bool
    """Whether all rays leave the eye."""
    parallel: Any
    """The direction that all rays have, three numbers in the camera frame; None where they differ."""
    real: type
    """What hits are searched with: float64 or float32."""
    pixels: PixelBounds
    """Where parts of the shapes may be seen."""
    whole: ShapeSet | None = None
    """What the kind has made for all pixels of the picture, where these are some columns and rows of them."""


class Large(NamedTuple):
    """A shape that is tested by itself."""

    at: int
    """Its index in ``Shapes``."""
    bounds: list[int]
    """x0, x1, y0, y1 in the tile."""
    solve: Callable[[tuple[slice, slice], Scratch], tuple[Any, Any]]
    """Given a window of the tile, returns t and where it is a hit: bool, True for everywhere, None where t is a number;
    None for t where no ray hits. t may lie in an array of the scratch, and may have one column that stands for all.
    """


class Candidates(NamedTuple):
    """Crossings of rays with shapes, in k windows of a tile that are of one size and may overlap."""

    at: np.ndarray
    """Indices into ``Shapes``: (k, 1, 1), or as ``t``."""
    corner: tuple[np.ndarray, np.ndarray]
    """(k,) each: the first row and the first column of each window in the tile."""
    t: np.ndarray
    """(k, rows, columns); NaN or inf where there is none."""
    where: np.ndarray | None
    """Which of ``t`` are crossings, bool; None for all that are numbers."""


@dataclass(frozen=True, eq=False)
class HitPixels:
    """The pixels of a block of a tile that hit something, or only those of one kind: m of them."""

    where: np.ndarray
    """(rows, columns) of the block, bool: the pixels that are meant."""
    hits: tuple[np.ndarray, np.ndarray]
    """Of the whole block, (rows, columns) each: indices into ``Shapes`` and t."""
    first_row: int
    """Of the block, in the tile."""
    from_eye: bool
    """Whether their rays leave the eye."""
    scratch: Scratch
    noted: dict[str, Any] = field(default_factory=dict)
    """What a kind has worked out of them, by name."""

    @lazy
    def places(self) -> np.ndarray:
        """(m,): where they are in the block, its rows one after the other."""
        return np.flatnonzero(self.where)

    @lazy
    def at(self) -> np.ndarray:
        """(m,) indices into ``Shapes``."""
        return taken(self.hits[0].reshape(-1), self.places)

    @lazy
    def t(self) -> np.ndarray:
        """(m,)."""
        return taken(self.hits[1].reshape(-1), self.places)

    def of(self, vector: Any) -> tuple[np.ndarray, ...]:
        """Return the components of the block, which broadcast, at these pixels, (m,) each."""
        return tuple(taken(np.broadcast_to(part, self.where.shape).reshape(-1), self.places) for part in vector)

    def kept(self, name: str, dtype: type) -> np.ndarray:
        """Return the (m,) entries of these pixels in an array of the scratch that the search filled for the tile."""
        rows, columns = self.where.shape
        (kept,) = self.of((self.scratch(name, (self.first_row + rows, columns), dtype)[self.first_row :],))
        return kept


class ShapeErrors(ABC):
    """The error bounds of hits of shapes of one kind; (m,) arrays."""

    @property
    @abstractmethod
    def t(self) -> np.ndarray:
        """Of t; inf or NaN where nothing is known."""

    @abstractmethod
    def normal(self, point: np.ndarray) -> np.ndarray:
        """Return the bound of the unit normal, as a vector's length, from those of the hit points relative to the eye;
        NaN where nothing is known.
        """


class ShapeSet(ABC):
    """The shapes of one kind that a camera may see, ready to be searched by several threads."""

    faces_eye: bool
    """Whether the normals face rays from the eye as they come."""

    def large(self, rays: SearchRays) -> Iterator[Large]:
        """Yield shapes that are tested one by one, the highest index first; by default there are none."""
        return iter(())

    @abstractmethod
    def rest(self, rays: SearchRays, nearest: np.ndarray) -> Iterator[Candidates | None]:
        """Yield the crossings with all other shapes, in any order; ``nearest`` is the t found so far, inf for none.

        None is yielded where there is still to do before the next: a request to stop is heard then.
        """


PixelNormals = Callable[[HitPixels, Any, Any], Any]
"""Given hit pixels, their points and directions, (m,) components in the world relative to the eye, returns the unit
normals turned towards the rays. The directions are None where normals are to be as they come: all face the rays.
"""


class Kind(ABC):
    """A kind of shape."""

    number: int
    """The value of ``Shapes.kind``; it never changes."""
    name: str
    """In the report's words."""
    may_be_flat: bool = False
    """Whether the axes of a shape may lie in one plane: ``InCamera.shape_from_world`` is undefined then."""

    @abstractmethod
    def extent(self, shapes: Shapes, at: np.ndarray, axes: np.ndarray) -> tuple[Any, Any]:
        """Return, of shapes whose axes in the camera frame are given, (k, 3, 3), an axis a row: the radius of a sphere
        about the center that holds each, and how far each reaches from there along Z; (k,) each, or one number.
        """

    @abstractmethod
    def is_close(self, offset: np.ndarray, shape_from_world: np.ndarray, away: np.ndarray) -> np.ndarray:
        """Return for which shapes, (k,) bool, ``offset`` is to have twice the digits, from a first value of it, (k, 3),
        the inverse axes (k, 3, 3) and the centers relative to the eye, (k, 3) world.
        """

    @abstractmethod
    def shape_set(self, shapes: InCamera, visible: Visible) -> ShapeSet:
        """Return the shapes that some pixel may see, ready to be searched."""

    @abstractmethod
    def normals(self, shapes: InCamera, at: np.ndarray) -> tuple[np.ndarray, PixelNormals | None]:
        """Return the constants of the unit normals of shapes in the world, (k, 4): gain and offset, where a normal is
        gain times the hit point, relative to the eye, plus the offset; and NaN for shapes of which it is not, whose
        normals a function gives. It is None where there are none.
        """

    def surface_normals(self, shapes: InCamera, pixels: HitPixels) -> Any:
        """Return the normals of the surface itself, (m,) components of any length and either side, where ``normals``
        gives others; None, as by default, where it gives these.
        """
        return None

    @abstractmethod
    def uv(self, shapes: InCamera, pixels: HitPixels, point: Any) -> tuple[np.ndarray, np.ndarray]:
        """Return u and v, (m,) each, of hit points given as components relative to the eye, world."""

    def follow(self, shapes: InCamera, pixels: HitPixels, point: Any) -> Follow:
        """Return what tells where hit points, components relative to the eye, world, are when their shapes have moved.

        By default they keep their place in the shapes' own frames.
        """
        return follow_frames(shapes, pixels.at, point)

    def from_edge(self, shapes: InCamera, pixels: HitPixels, point: Any) -> np.ndarray:
        """Return how far hit points are from the nearest edge of their faces, (m,), as a part of the height of the
        triangle beside it; inf, as by default, on surfaces that have a uv map.
        """
        return np.full(len(pixels.at), np.inf)

    def polygon(self, shapes: InCamera, pixels: HitPixels) -> np.ndarray:
        """Return the face of the mesh that is hit, (m,) int32; by default there is none, -1."""
        return np.full(len(pixels.at), -1, np.int32)

    def slot(self, shapes: InCamera, pixels: HitPixels) -> np.ndarray:
        """Return which material of a shape's ``Slots`` is hit, (m,); by default the first."""
        return np.zeros(len(pixels.at), np.int32)

    @abstractmethod
    def errors(self, shapes: InCamera, pixels: HitPixels, rays: WorldRays, from_eye: bool, unit: bool) -> ShapeErrors:
        """Return the error bounds of hits. ``unit``: whether normals from constants keep the length they come with."""

    @abstractmethod
    def decision(self, shapes: InCamera, at: np.ndarray, rays: WorldRays, from_eye: bool) -> tuple[Any, Any]:
        """Return what decides whether rays hit shapes, one shape a ray, and the bound below which that is open: it is
        positive on a hit, negative on a miss where it is beyond the bound.
        """
