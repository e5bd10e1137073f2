"""The hits of rays, and what follows from them: points, normals, surfaces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..errors.hits import Bounds
from ..maths.speed import Scratch, lazy
from ..maths.vector import components, difference, dot, inner, is_lattice, is_one, linear, matvec, norm, rows
from ..shapes import SHAPE_OF_KIND
from ..shapes.normals import ZERO
from .plan import Plan

BLOCK_PIXELS = 1 << 16
"""Pixels whose passes are made at once."""

ALL = slice(None)
"""Every row, or every column."""

NOTHING = -1
"""Shape index of a pixel that sees none."""


@dataclass(eq=False)
class Hits:
    """The hits of some rows, (rows, columns) arrays, and what follows from them, worked out when a pass asks."""

    plan: Plan
    from_eye: bool
    """Whether all rays leave the eye."""
    origin: Any
    """Components in the camera frame."""
    direction: Any
    """Components in the camera frame, scaled so that t is Blender's depth."""
    t: np.ndarray
    """inf where nothing is hit."""
    index: np.ndarray
    """Row of the nearest shape, NOTHING where there is none."""
    scratch: Scratch
    corner: tuple[int, int] = (0, 0)
    """Column and row of the render window at which the rays begin."""
    full: bool = False
    """Whether it is known that every ray hits something."""

    def blocks(self):
        """Yield (rows, hits) of some rows at a time, BLOCK_PIXELS of them: working arrays stay in a core's cache."""
        height, width = self.t.shape
        step = max(1, BLOCK_PIXELS // width)
        for first in range(0, height, step):
            rows = slice(first, first + step)
            yield rows, self._part(rows)

    def _part(self, rows: slice) -> Hits:
        """Return the hits of some rows of these."""
        origin, direction = (tuple(cut(c, (rows, ALL)) for c in vector) for vector in (self.origin, self.direction))
        hits = Hits(
            self.plan, self.from_eye, origin, direction, self.t[rows], self.index[rows], self.scratch,
            (self.corner[0], self.corner[1] + rows.start), self.full,
        )  # fmt: skip
        if self.lattice is not None:
            row, column = self.lattice
            hits.lattice = row, column[:, rows]
        return hits

    @lazy
    def rows(self) -> np.ndarray:
        """The index as numpy looks things up."""
        rows = self.scratch("rows", self.index.shape, np.intp)
        np.copyto(rows, self.index)
        return rows

    def look_up(self, table, out) -> np.ndarray:
        """Return what a table (..., n + 1) has for each pixel's shape, its last entry where nothing is hit: in ``out``,
        an array, or the name of one that the next call with this name overwrites.
        """
        if isinstance(out, str):
            out = self.scratch(out, table.shape[:-1] + self.t.shape, table.dtype.type)
        return np.take(table, self.rows, axis=-1, mode="wrap", out=out)

    @lazy
    def seen(self) -> np.ndarray:
        """Where a shape is hit, bool."""
        return self.index != NOTHING

    @lazy
    def missed(self) -> np.ndarray | None:
        """Where none is, bool; None where that is nowhere."""
        return None if self.full or self.index.min(initial=0) != NOTHING else ~self.seen

    @lazy
    def has_ray(self) -> np.ndarray:
        """Where the pixel has a ray, bool."""
        ray = np.ones(self.t.shape, bool)
        for component in self.direction:
            ray &= ~np.isnan(component)
        return ray

    @lazy
    def lost(self) -> np.ndarray | None:
        """Where the pixel has no ray, bool; None where that is nowhere."""
        return ~self.has_ray if any(np.isnan(component).any() for component in self.direction) else None

    @lazy
    def world_direction(self):
        """The directions as world components, not of unit length."""
        if self.lattice is None:
            return matvec(self.plan.camera.pose.basis, self.direction)
        return np.add(*self.lattice, out=self.scratch("direction", (3, *self.t.shape), np.float64))

    @lazy
    def length(self) -> np.ndarray:
        """Of ``world_direction``: distance over t; one for all parallel rays."""
        if is_one(self.world_direction):
            return np.full((1, 1), norm(self.world_direction))
        length, spare = (self.scratch(name, self.t.shape, np.float64) for name in ("length", "spare"))
        return np.sqrt(inner(self.world_direction, self.world_direction, length, spare), out=length)

    @lazy
    def lattice(self) -> tuple[np.ndarray, np.ndarray] | None:
        """The two terms of a pinhole's directions, (3, 1, columns) and (3, rows, 1) world components; None for others.

        They are made for a whole tile: short calls, too, are a moment in which threads wait for each other.
        """
        if not is_lattice(self.direction):
            return None
        x, y, z = self.direction
        to_x, to_y, to_z = self.plan.camera.pose.basis.T[..., None, None]
        return to_x * x, to_y * y + to_z * z

    @lazy
    def point(self) -> np.ndarray:
        """``points`` of all pixels."""
        return self.points((ALL, ALL))

    def points(self, window) -> np.ndarray:
        """Return the hit points of a window relative to the eye, (3, rows, columns) world components, in an array that
        the next call overwrites; no number of meaning where nothing is hit.
        """
        t = self.t[window]
        point = self.scratch("point", (3, *t.shape), np.float64)
        if self.lattice is not None:
            (row, column), (rows, columns) = self.lattice, window
            np.add(row[..., columns], column[:, rows], out=point)
        else:
            self._to_world(self.direction, window, point)
        np.multiply(point, t, out=point)
        if not self.from_eye:
            offset = self.scratch("offset", point.shape, np.float64)
            np.add(self._to_world(self.origin, window, offset), point, out=point)
        return point

    def _to_world(self, vector, window, out) -> np.ndarray:
        """Return camera-frame components in a window as world components, in ``out``."""
        axes = self.plan.camera.pose.basis.T[..., None, None]
        parts = tuple(cut(component, window) for component in vector)
        return linear(axes, parts, out, self.scratch("spare", out.shape, np.float64))

    @lazy
    def normal_terms(self) -> tuple[np.ndarray, np.ndarray]:
        """Two terms whose sum is ``normal`` where something is hit: storing it can add them."""
        terms = self.plan.normals.look_up(self)
        if self.from_eye and self.plan.eye_outside:
            return terms
        normal = np.add(*terms, out=terms[0])
        return np.multiply(-np.sign(dot(normal, self.world_direction)), normal, out=normal), ZERO

    @lazy
    def normal(self):
        """Unit world normals turned towards the rays' origins, (3, rows, columns); 0 where nothing is hit."""
        normal = np.add(*self.normal_terms, out=self.scratch("normal", (3, *self.t.shape), np.float64))
        if self.missed is not None:
            np.copyto(normal, 0.0, where=self.missed)
        return normal

    @lazy
    def pixels(self):
        """The pixel coordinates of the centers, (1, columns) and (rows, 1)."""
        raster, (column, row) = self.plan.camera.raster, self.corner
        height, width = self.t.shape
        return raster.columns()[:, column : column + width], raster.rows()[row : row + height]

    @lazy
    def bounds(self) -> Bounds:
        """How far from the exact picture the hits are at most."""
        return Bounds(self)

    @lazy
    def surfaces(self) -> list[Surface]:
        """The hit pixels kind by kind, only the kinds that are hit."""
        kinds = self.plan.shapes.kind[self.index[self.seen]]
        found = []
        for kind in np.unique(kinds):
            where = self.seen.copy()
            where[self.seen] = kinds == kind
            found.append(Surface(self, where, SHAPE_OF_KIND[int(kind)]))
        return found


@dataclass(frozen=True)
class Surface:
    """The pixels of a tile that hit shapes of one kind; components are (m,) arrays over them."""

    hits: Hits
    where: np.ndarray
    kind: Any

    @lazy
    def rows(self) -> np.ndarray:
        """The row of each pixel's shape."""
        return self.hits.index[self.where]

    @lazy
    def q(self):
        """The hit points in the shapes' frames, right to EPS (distance / size)."""
        shapes, pose = self.hits.plan.shapes, self.hits.plan.camera.pose
        offset = difference(self.select(self.hits.point), components(shapes.center[self.rows] - pose.eye))
        return matvec(rows(self.hits.plan.placed.shape_from_world[self.rows]), offset)

    def select(self, vector):
        """Return the components of a tile at these pixels."""
        shape = self.where.shape
        return tuple(np.broadcast_to(component, shape)[self.where] for component in vector)


def cut(component, window):
    """Return the part of a broadcastable component that covers a window of the tile."""
    if not (isinstance(component, np.ndarray) and component.ndim):
        return component
    (rows, columns), (height, width) = window, component.shape
    return component[rows if height > 1 else ALL, columns if width > 1 else ALL]
