"""The surface of meshes where rays meet it: normals, uv, faces and materials of the triangles that pixels see.

Many pixels may see the same triangle. Values that depend on the triangle alone are computed once for all of them; over
a triangle, normals and uv are affine in the hit point.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...conventions import EPS
from ...maths.speed import lazy, merged, taken
from ...maths.vector import components, cross, difference, dot, matrix_rows, matvec, norm
from ...mesh import Mesh
from ...records import MESH
from ..kind import HitPixels
from ..shape_frames import InCamera

TRIANGLES = "triangles"
"""Name under which ``HitPixels.noted`` has the ``HitTriangles`` of the pixels."""

LOST = 1 / 16
"""If rounding of a triangle's points may move a barycentric coordinate by this much, values are constant over it."""


@dataclass(frozen=True, eq=False)
class HitTriangles:
    """The k triangles that m pixels see; vectors in the world."""

    shapes: InCamera
    of_pixel: np.ndarray
    """(m,) indices into these triangles."""
    at: np.ndarray
    """(k,) indices into ``Shapes``."""
    number: np.ndarray
    """(k,) indices into the triangles of the mesh."""
    from_eye: bool
    """Whether the rays leave the eye, so that all pixels see the same side of a triangle."""

    @classmethod
    def of(cls, shapes: InCamera, pixels: HitPixels) -> HitTriangles:
        """Return the triangles of one or more pixels that see meshes; they are made at first use and noted."""
        if TRIANGLES not in pixels.noted:
            seen = pixels.known[MESH]
            triangles = cls(shapes, pixels.in_tile(seen.of_pixel), seen.at, seen.number, pixels.from_eye)
            pixels.noted[TRIANGLES] = triangles.only(slice(None))
        return pixels.noted[TRIANGLES]

    def only(self, pixels: Any) -> HitTriangles:
        """Return the triangles that some of the pixels, indices or a slice, see."""
        of_pixel = self.of_pixel[pixels]
        rank = np.zeros(len(self.at), np.int32)
        rank[of_pixel] = 1
        seen = np.flatnonzero(rank)
        rank[seen] = np.arange(len(seen))
        return HitTriangles(self.shapes, rank.take(of_pixel), self.at[seen], self.number[seen], self.from_eye)

    def each(self, values: Any) -> np.ndarray:
        """Return the values of triangles (..., k) for the pixels that see them, (..., m)."""
        return taken(values, self.of_pixel)

    @property
    def polygon(self) -> np.ndarray:
        """(m,) int32: the faces of the meshes."""
        return self.each(self._gather((), np.int32, lambda mesh, number: mesh.polygon[number]))

    @property
    def slot(self) -> np.ndarray:
        """(m,) int32: indices of the materials in the shape's ``Slots``."""
        return self.each(self._gather((), np.int32, lambda mesh, k: 0 if mesh.slot is None else mesh.slot[k]))

    @lazy
    def local(self) -> np.ndarray:
        """The corners relative to the middles of their meshes, in mesh frames, (3, 3, k): corner, component."""
        return self._gather((3, 3), float, corners_from_middle)

    @lazy
    def axes(self) -> tuple[Any, ...]:
        """The rows of the shapes' axes, three times three (k,), or (1,) if all triangles are of one shape."""
        return matrix_rows(self.shapes.shapes.axes[self._places])

    @lazy
    def center(self) -> tuple[np.ndarray, ...]:
        """The shapes' centers relative to the eye, three (k,), or (1,) if all triangles are of one shape."""
        return components(self.shapes.shapes.center[self._places] - self.shapes.pose.eye)

    @lazy
    def corners(self) -> list[tuple[np.ndarray, ...]]:
        """The corners relative to the eye, three times three (k,)."""
        return [
            tuple(c + p for c, p in zip(self.center, matvec(self.axes, corner), strict=True)) for corner in self.local
        ]

    @lazy
    def edges(self) -> tuple[Any, Any]:
        """The vectors from the first corner to the two others."""
        return difference(self.corners[1], self.corners[0]), difference(self.corners[2], self.corners[0])

    @lazy
    def area(self) -> Any:
        """The cross product of the edges: a normal on the mesh's front side, or on the back side of mirrored meshes."""
        return cross(*self.edges)

    @lazy
    def corner_normals(self) -> np.ndarray:
        """The normals at the corners on the side of ``area``, (3, 3, k): corner, component; not of unit length.

        They are normalized in the world, except those of a shared mesh, which are unit vectors in its own frame: see
        ``Shapes.shared``. A triangle is flat if a flattened object leaves one of its corner normals no direction.
        """
        smooth = self._gather((), bool, lambda mesh, k: mesh.normals is not None)
        local = self._gather((3, 3), float, _normals)
        first, second, third = zip(*self.axes, strict=True)
        columns = [cross(second, third), cross(third, first), cross(first, second)]
        turned = np.array([matvec(tuple(zip(*columns, strict=True)), corner) for corner in local])
        lengths = np.array([norm(corner) for corner in turned])
        smooth &= (lengths > 0).all(axis=0)
        turned /= np.where(self.shapes.shapes.shared[self.at], 1.0, lengths)[:, None]
        return np.where(smooth, turned, np.array(self.area))

    @lazy
    def gradients(self) -> tuple[Any, Any]:
        """The gradients of the second and third barycentric coordinates; 0 for triangles that are too thin (LOST)."""
        square = dot(self.area, self.area)
        towards = cross(self.edges[1], self.area), cross(self.area, self.edges[0])
        gradients = tuple(tuple(component / square for component in vector) for vector in towards)
        reach = np.maximum.reduce([norm(corner) for corner in self.corners])
        lost = ~(16 * EPS * reach * np.maximum(norm(gradients[0]), norm(gradients[1])) < LOST)
        second, third = (tuple(np.where(lost, 0.0, component) for component in vector) for vector in gradients)
        return second, third

    def affine(self, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return constants, (c, k), and slopes, (3, c, k), of values at the corners, (3, c, k): the values at points
        p relative to the eye are constant + slope . p.
        """
        first, to_second, to_third = values[0], values[1] - values[0], values[2] - values[0]
        slope = np.array([to_second * g + to_third * h for g, h in zip(*self.gradients, strict=True)])
        return first - dot(slope, self.corners[0]), slope

    def interpolated(self, values: np.ndarray, point: Any) -> np.ndarray:
        """Return values at the corners, (3, c, k), at hit points relative to the eye, (c, m)."""
        return affine_at(self.of_pixel, *self.affine(values), point)

    def uv(self, point: Any) -> tuple[np.ndarray, np.ndarray]:
        """Return u and v, (m,) each; 0 if the mesh has no map."""
        if all(self.shapes.shapes.meshes[k].uv is None for k in self._meshes):
            return np.zeros(len(self.of_pixel)), np.zeros(len(self.of_pixel))
        u, v = self.interpolated(self._gather((3, 2), float, _uv), point)
        return u, v

    def layer(self, point: Any, name: str, channels: int) -> np.ndarray:
        """Return a layer of the meshes, (channels, m); 0 where a mesh has none of this name."""

        def at_corners(mesh: Mesh, number: np.ndarray) -> Any:
            values = dict(mesh.layers).get(name)
            return 0.0 if values is None else values.take(number, axis=1).swapaxes(1, 2)

        return self.interpolated(self._gather((3, channels), float, at_corners), point)

    def in_object(self, point: Any) -> np.ndarray:
        """Return the points in the spaces of their objects, (3, m)."""
        middle = self._gather((3,), float, lambda mesh, number: mesh.middles(number))
        return self.interpolated(self.local + middle, point)

    def from_edge(self, point: Any) -> np.ndarray:
        """Return the distances from edges, (m,), as ``Kind.from_edge`` does."""
        outer = self._gather((3,), bool, lambda mesh, k: False if mesh.uv is not None else mesh.is_outer[:, k])
        corners = np.broadcast_to(np.eye(3)[..., None], (3, 3, len(self.at)))
        heights = self.interpolated(corners, point)
        return np.where(self.each(outer), heights, np.inf).min(axis=0)

    @lazy
    def _places(self) -> np.ndarray:
        """Indices into ``Shapes``: (k,), or (1,) if all triangles are of one shape."""
        return merged(self.at)

    @lazy
    def mesh(self) -> np.ndarray:
        """(k,) indices into ``Shapes.meshes``."""
        return self.shapes.shapes.mesh[self.at]

    @lazy
    def _meshes(self) -> list[int]:
        """Indices of the meshes that are seen, in ``Shapes.meshes``."""
        return np.flatnonzero(np.bincount(self.mesh)).tolist()

    def _gather(self, shape: tuple[int, ...], dtype: type, of: Callable[[Mesh, np.ndarray], Any]) -> np.ndarray:
        """Return the values, (*shape, k), of a function that takes a mesh and the indices of some of its triangles."""
        result: np.ndarray = np.empty((*shape, len(self.at)), dtype)
        for k in self._meshes:
            of_mesh = self.mesh == k if len(self._meshes) > 1 else slice(None)
            result[..., of_mesh] = of(self.shapes.shapes.meshes[k], self.number[of_mesh])
        return result


def affine_at(index: np.ndarray, constant: np.ndarray, slope: np.ndarray, point: Any) -> np.ndarray:
    """Return constant + slope . point, (c, m), with constants (c, k) and slopes (3, c, k) at the indices ``index``."""
    total = taken(constant, index)
    for along, component in zip(slope, point, strict=True):
        term = taken(along, index)
        term *= component
        total += term
    return total


def corners_from_middle(mesh: Mesh, number: np.ndarray) -> np.ndarray:
    """Return the corners of triangles (k,) relative to the mesh's middle, (3, 3, k): corner, component."""
    return mesh.vertices.take(mesh.triangles.take(number, axis=1), axis=1).swapaxes(0, 1) - mesh.middles(number)


def places_from_middle(mesh: Mesh, vertices: np.ndarray) -> np.ndarray:
    """Return the places of vertices, (3, k) indices, relative to the mesh's middle, (3, 3, k): corner, component."""
    return mesh.vertices.take(vertices, axis=1).swapaxes(0, 1) - mesh.middle[:, None]


def _at_loops(values: np.ndarray, loops: Any, number: np.ndarray) -> np.ndarray:
    """Return the values (l, c) at the loops of triangles, (3, c, k)."""
    return values.take(loops.take(number, axis=1), axis=0).swapaxes(1, 2)


def _normals(mesh: Mesh, number: np.ndarray) -> Any:
    """Return the normals of triangles at their corners, (3, 3, k); 0 if the mesh is shaded flat."""
    return 0.0 if mesh.normals is None else _at_loops(mesh.normals, mesh.loops, number)


def _uv(mesh: Mesh, number: np.ndarray) -> Any:
    """Return u and v of triangles at their corners, (3, 2, k); 0 if the mesh has no map."""
    return 0.0 if mesh.uv is None else _at_loops(mesh.uv, mesh.loops, number)
