"""The interface of a kind of shape, and the records that its methods take and return.

A kind is one instance of a subclass of ``Kind``, listed in ``SHAPE_KINDS``. Its users are ``in_camera`` (``extent``,
``is_close``), the plan and the search (``shape_set``), the passes (``normals``, ``uv``) and the error bounds
(``errors``). Elsewhere, only what makes shapes and the equations of ``lesson.meetings`` know the kinds;
boxes of objects and landmarks of motion take the cube -1 to 1 of a shape's own frame for all but planes and meshes.

A kind whose shapes are affine images of one surface, each described by a row of constants, derives from ``AffineKind``,
which implements most of the interface. Any other kind, such as meshes, derives from ``Kind`` and implements
``ShapeSet.rest`` instead of ``ShapeSet.large``. What it knows of the hits of a tile (which triangle) it puts into
``SearchRays.known`` under its number, and finds for normals, uv and errors in ``HitPixels.known``.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Protocol

import numpy as np

from ..maths.speed import Scratch, lazy, taken
from ..records import InputError, Shapes
from .bodies import Bodies
from .search_rays import SearchRays
from .shape_frames import InCamera, WorldRays
from .surface_points import Follow, follow_frames


class PixelBounds(Protocol):
    """The pixels of the plan in which something may be seen: (n, 4) int, x0, x1, y0, y1, with x1 and y1 excluded."""

    def of_balls(self, centers: np.ndarray, radii: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the bounds of balls in the camera's frame, (n, 3) and (n,), and which of them hold a pixel center.

        A radius may be infinite.
        """

    def within(self, bounds: np.ndarray) -> np.ndarray:
        """Return bounds of the picture, (n, 4), as bounds in the columns and rows of the picture that the plan has."""

    def least_t(self, centers: np.ndarray, radii: np.ndarray) -> np.ndarray:
        """Return a lower bound, (n,), of t in each ball if t is depth, else of its distance; -inf for none."""

    @property
    def is_planar(self) -> bool:
        """Whether t is depth, wherever rays begin and however long their directions are."""

    @property
    def has_straight_lines(self) -> bool:
        """Whether everything between points is seen between their images, so that ``of_points`` may be called."""

    @property
    def whole(self) -> np.ndarray:
        """(4,) int: all pixels of the plan."""

    def of_points(self, points: np.ndarray, out: np.ndarray) -> np.ndarray:
        """Write the bounds of points (n, 3) in the camera's frame, most of which hold no pixel center, to ``out``, and
        return which points have an image that counts. Points between these are seen from the least x0, y0 to the
        largest x1, y1.
        """


@dataclass(frozen=True, eq=False)
class Visible:
    """The shapes of one kind that some pixel may see, and how they are searched; one row per shape."""

    at: np.ndarray
    """(k,) indices into ``Shapes``, ascending."""
    bounds: np.ndarray
    """(k, 4) int: x0, x1, y0, y1 in the pixels of the plan, x1 and y1 excluded."""
    near: np.ndarray
    """(k,): a lower bound of the t of each shape, -inf where none is known."""
    clip_start: float
    from_eye: bool
    """Whether all rays leave the eye."""
    parallel: Any
    """The direction that all rays have, three numbers in the camera frame; None where they differ."""
    pixels: PixelBounds
    """Finds the pixels in which parts of the shapes may be seen."""
    whole: ShapeSet | None = None
    """The kind's set for all pixels of the picture, if the plan has only some columns and rows of the picture."""


class Large(NamedTuple):
    """A shape that is tested by itself."""

    at: int
    """Its index in ``Shapes``."""
    bounds: list[int]
    """x0, x1, y0, y1 in the tile."""
    solve: Callable[[tuple[slice, slice], Scratch], tuple[Any, Any]]
    """Given a window of the tile, returns t and where t is a hit: a bool array, True for everywhere, or None for
    wherever t is not NaN. t is None if no ray hits. It may be an array of the scratch, or have a single column.
    """


class Candidates(NamedTuple):
    """Crossings of rays with shapes, in k windows of a tile that have one size and may overlap."""

    at: np.ndarray
    """Indices into ``Shapes``: (k, 1, 1), or with the shape of ``t``."""
    corner: tuple[np.ndarray, np.ndarray]
    """(k,) each: the first row and the first column of each window in the tile."""
    t: np.ndarray
    """(k, rows, columns); NaN or inf where there is no crossing."""
    where: np.ndarray | None
    """Which entries of ``t`` are crossings, bool; None for all that are numbers."""


@dataclass(frozen=True, eq=False)
class HitPixels:
    """The m pixels of a block of a tile that hit something, or that hit shapes of one kind."""

    where: np.ndarray
    """(rows, columns) of the block, bool: True at these pixels."""
    hits: tuple[np.ndarray, np.ndarray]
    """Indices into ``Shapes`` and t of the whole block, (rows, columns) each."""
    window: tuple[slice, slice]
    """Rows and columns of the block in the tile."""
    from_eye: bool
    """Whether their rays leave the eye."""
    known: Mapping[int, Any] = field(default_factory=dict)
    """``SearchRays.known`` of the tile."""
    noted: dict[str, Any] = field(default_factory=dict)
    """Results that a kind has computed for these pixels, by name."""

    @lazy
    def places(self) -> np.ndarray:
        """(m,): flat indices of the pixels in the block, row by row."""
        return np.flatnonzero(self.where)

    @lazy
    def is_whole(self) -> bool:
        """Whether these are all pixels of the block."""
        return bool(self.where.all())

    @lazy
    def at(self) -> np.ndarray:
        """(m,) indices into ``Shapes``."""
        return self._own(self.hits[0])

    @lazy
    def t(self) -> np.ndarray:
        """(m,) t of the hits."""
        return self._own(self.hits[1])

    def of(self, vector: Any) -> tuple[np.ndarray, ...]:
        """Return the components of a vector of the block, which broadcast, at these pixels, (m,) each; they may be the
        block's own, which are not to be written.
        """
        return tuple(self._own(np.broadcast_to(component, self.where.shape)) for component in vector)

    def _own(self, values: np.ndarray) -> np.ndarray:
        return values.reshape(-1) if self.is_whole else taken(values.reshape(-1), self.places)

    def in_tile(self, values: np.ndarray) -> np.ndarray:
        """Return the (m,) entries of these pixels in an array of the tile, (rows, columns)."""
        (entries,) = self.of((values[self.window],))
        return entries


class ShapeErrors(ABC):
    """The error bounds of hits on shapes of one kind; (m,) arrays."""

    @property
    @abstractmethod
    def t(self) -> np.ndarray:
        """The bound of t; inf or NaN where no bound is known."""

    @abstractmethod
    def normal(self, point: np.ndarray) -> np.ndarray:
        """Return the bound of the unit normal, as a vector's length, from the bounds ``point`` of the hit points
        relative to the eye; NaN where no bound is known.
        """


class ShapeSet(ABC):
    """The shapes of one kind that a camera may see, ready to be searched by several threads."""

    faces_eye: bool
    """Whether the normals face rays from the eye without being turned."""
    has_cutouts: bool = False
    """Whether the set needs the nearest hits so far, for shapes with transparent points: see ``SearchRays``."""

    def large(self, rays: SearchRays) -> Iterator[Large]:
        """Yield shapes that are tested one by one, the highest index first; by default there are none."""
        return iter(())

    @abstractmethod
    def rest(self, rays: SearchRays, nearest: np.ndarray) -> Iterator[Candidates | None]:
        """Yield the crossings with all other shapes, in any order; ``nearest`` is the t found so far, inf for no hit.

        None is yielded between steps of long work: the caller can stop the search then.
        """


PixelNormals = Callable[[HitPixels, Any, Any], Any]
"""Given hit pixels, their points and directions, (m,) components in the world relative to the eye, returns the unit
normals turned towards the rays. The directions are None if all normals face the rays already and are not to be turned.
"""


class Kind(ABC):
    """A kind of shape."""

    number: int
    """The value of ``Shapes.kind``; it never changes."""
    name: str
    """Name of the kind in the report."""
    meets_once: bool = False
    """Whether a ray crosses a shape once at most."""
    may_be_flat: bool = False
    """Whether the axes of a shape may lie in one plane; ``InCamera.shape_from_world`` is undefined then."""

    @abstractmethod
    def extent(self, shapes: Shapes, at: np.ndarray, axes: np.ndarray) -> tuple[Any, Any]:
        """Return the radius of a sphere about the center of each shape that holds it, and how far the shape reaches
        from its center along Z; (k,) each, or one number. ``axes``: (k, 3, 3) in the camera frame, one axis per row.
        """

    @abstractmethod
    def is_close(self, offset: np.ndarray, shape_from_world: np.ndarray, away: np.ndarray) -> np.ndarray:
        """Return for which shapes, (k,) bool, ``offset`` has to be computed with twice the digits. Given are its first
        value, (k, 3), the inverse axes, (k, 3, 3), and the centers relative to the eye, (k, 3) world.
        """

    @abstractmethod
    def shape_set(self, shapes: InCamera, visible: Visible) -> ShapeSet:
        """Return the shapes that some pixel may see, ready to be searched."""

    def bodies(self, shapes: InCamera, at: np.ndarray, parts: np.ndarray | None = None) -> Bodies:
        """Return the bodies of some shapes, by index, (k,): what rays that no camera makes are tested against. With
        ``parts``, (k,), they are one body of each of the shapes only, by its number there.

        The default raises InputError: ``cast_rays`` needs this method.
        """
        raise InputError(f"rays given as arrays do not meet shapes of the kind {self.name}: leave these out")

    @abstractmethod
    def normals(self, shapes: InCamera, at: np.ndarray) -> tuple[np.ndarray, PixelNormals | None]:
        """Return the constants of the shapes' unit normals in the world, (k, 4), and a function or None. The constants
        are gain and offset: a normal is gain times the hit point, relative to the eye, plus the offset. They are NaN
        for shapes whose normals have no such form; the function gives those, and is None if there are no such shapes.
        """

    def surface_normals(self, shapes: InCamera, pixels: HitPixels) -> Any:
        """Return the normals of the surface itself, as (m,) components of any length and on either side, if ``normals``
        gives other ones, such as interpolated normals; None, the default, if it gives the same.
        """
        return None

    @abstractmethod
    def uv(self, shapes: InCamera, pixels: HitPixels, point: Any) -> tuple[np.ndarray, np.ndarray]:
        """Return u and v, (m,) each, of hit points given as components relative to the eye, world."""

    def coordinates(self, shapes: InCamera, pixels: HitPixels, point: Any) -> tuple[np.ndarray, np.ndarray]:
        """Return the coordinates of the surface itself, (m,) each, whatever its UV map is; by default u and v."""
        return self.uv(shapes, pixels, point)

    def follow(self, shapes: InCamera, pixels: HitPixels, point: Any) -> Follow:
        """Return a function that tells how hit points, components relative to the eye, world, move with their shapes.

        By default the points keep their place in the shapes' own frames.
        """
        return follow_frames(shapes, pixels.at, point)

    def from_edge(self, shapes: InCamera, pixels: HitPixels, point: Any) -> np.ndarray:
        """Return how far hit points are from the nearest edge of their faces, (m,), as a fraction of the height of the
        triangle next to that edge; inf, the default, on surfaces that have a uv map.
        """
        return np.full(len(pixels.at), np.inf)

    def polygon(self, shapes: InCamera, pixels: HitPixels) -> np.ndarray:
        """Return the face of the mesh that is hit, (m,) int32; by default -1, for no face."""
        return np.full(len(pixels.at), -1, np.int32)

    def in_object(self, shapes: InCamera, pixels: HitPixels, point: Any) -> np.ndarray:
        """Return hit points, components relative to the eye, world, in the spaces of their objects, (3, m); by default
        0: the reader casts a shape as a mesh where a material needs them.
        """
        return np.zeros((3, len(pixels.at)))

    def layer(self, shapes: InCamera, pixels: HitPixels, point: Any, name: str, channels: int) -> np.ndarray:
        """Return a layer of the mesh, see ``Mesh.layers``, at hit points, (channels, m); by default 0."""
        return np.zeros((channels, len(pixels.at)))

    def slot(self, shapes: InCamera, pixels: HitPixels) -> np.ndarray:
        """Return which material of a shape's ``Slots`` is hit, (m,); by default the first."""
        return np.zeros(len(pixels.at), np.int32)

    @abstractmethod
    def errors(self, shapes: InCamera, pixels: HitPixels, rays: WorldRays, from_eye: bool, unit: bool) -> ShapeErrors:
        """Return the error bounds of hits. ``unit``: whether normals from constants are left unnormalized."""
