"""The nearest hit of every pixel of a tile."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from .camera import Camera
from .plan import Plan
from .records import Shapes
from .shapes import SHAPE_OF_KIND
from .vector import along, components, difference, matvec, rows

NOTHING = -1
"""Shape index of a pixel that sees none."""


@dataclass(frozen=True)
class Hits:
    """The hits of one tile, (rows, columns) arrays, and what follows from them, worked out when a pass asks."""

    camera: Camera
    shapes: Shapes
    plan: Plan
    origin: Any
    """Components in the camera frame."""
    direction: Any
    """Components in the camera frame, scaled so that t is Blender's depth."""
    t: np.ndarray
    """inf where nothing is hit."""
    index: np.ndarray
    """Row of the nearest shape, NOTHING where there is none."""

    @cached_property
    def seen(self) -> np.ndarray:
        """Where a shape is hit, bool."""
        return self.index != NOTHING

    @cached_property
    def finite_t(self) -> np.ndarray:
        """Return t with 0 where nothing is hit."""
        return np.where(self.seen, self.t, 0.0)

    @cached_property
    def point(self):
        """Return the hit points as camera-frame components: the origin where nothing is hit."""
        return along(self.origin, self.direction, self.finite_t)

    @cached_property
    def world_direction(self):
        """Return the directions as world components, not of unit length."""
        return matvec(self.camera.pose.basis, self.direction)

    @cached_property
    def surfaces(self) -> list[Surface]:
        """Return the hit pixels kind by kind, only the kinds that are hit."""
        kinds = self.shapes.kind[self.index[self.seen]]
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

    @cached_property
    def rows(self) -> np.ndarray:
        """Return the row of each pixel's shape."""
        return self.hits.index[self.where]

    @cached_property
    def shape_from_camera(self):
        """Return the matrix of each pixel's shape, as rows of entries."""
        return rows(self.hits.plan.placed.shape_from_camera[self.rows])

    @cached_property
    def q(self):
        """Return the hit point in the shape's frame, right to EPS (distance / size)."""
        centre = components(self.hits.plan.placed.centre[self.rows])
        return matvec(self.shape_from_camera, difference(self.select(self.hits.point), centre))

    def select(self, vector):
        """Return the components of a tile at these pixels."""
        shape = self.where.shape
        return tuple(np.broadcast_to(component, shape)[self.where] for component in vector)


def nearest(camera: Camera, shapes: Shapes, plan: Plan, first_row: int, last_row: int) -> Hits:
    """Return the nearest hit within the clip range for the window's rows first_row .. last_row - 1.

    Of shapes hit at exactly the same t the one with the lowest index counts, whatever order they are tested in.
    """
    raster = camera.raster
    origin, direction = camera.camera_rays(raster.columns(), raster.rows()[first_row:last_row])
    shape = (last_row - first_row, raster.shape[1])
    t = np.full(shape, np.inf)
    index = np.full(shape, NOTHING, np.int32)
    eye = None if camera.model.central else origin
    touched = np.flatnonzero((plan.bounds[:, 2] < last_row) & (plan.bounds[:, 3] > first_row))
    for k, (x0, x1, y0, y1) in zip(plan.visible[touched], plan.bounds[touched].tolist(), strict=True):
        window = slice(max(y0, first_row) - first_row, min(y1, last_row) - first_row), slice(x0, x1)
        kind = int(shapes.kind[k])
        found = SHAPE_OF_KIND[kind].intersect(
            plan.placed.take(k), kind, cut(eye, window), cut(direction, window), camera.clip_start, camera.clip_end
        )
        nearest_t, nearest_k = t[window], index[window]
        closer = (found < nearest_t) | ((found == nearest_t) & (k < nearest_k))
        np.copyto(nearest_t, found, where=closer)
        nearest_k[closer] = k
    return Hits(camera, shapes, plan, origin, direction, t, index)


def cut(vector, window):
    """Return the part of broadcastable components that covers a window of the tile."""
    if vector is None:
        return None
    return tuple(
        component
        if np.ndim(component) == 0
        else component[tuple(part if size > 1 else slice(None) for part, size in zip(window, component.shape, strict=True))]
        for component in vector
    )
