"""The normals of a tile's triangles as constants, computed once for all pixels of the tile."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ... import tuning
from ...maths.speed import taken
from ...maths.vector import dot, norm
from ...records import MESH
from ..kind import HitPixels
from ..shape_frames import InCamera
from .mesh_surface import HitTriangles, affine_at
from .nearest import SeenTriangles

NORMALS = "normals of triangles"
"""Name under which ``SeenTriangles.noted`` has the ``TriangleNormals`` of a tile."""


@dataclass(frozen=True, eq=False)
class TriangleNormals:
    """Normals of the k triangles that a tile sees: constant + slope . p, of any length, at p relative to the eye."""

    constant: np.ndarray
    """(3, k); of unit length if all triangles are flat-shaded."""
    slope: np.ndarray | None
    """(3, 3, k): axis of p, component; None if all triangles are flat-shaded."""
    area: np.ndarray | None
    """(3, k): face normals on the side of the normals; None for rays from the eye, which all normals face already."""

    @classmethod
    def of(cls, shapes: InCamera, pixels: HitPixels) -> TriangleNormals:
        """Return the normals of the pixels' tile."""
        seen = pixels.known[MESH]
        if NORMALS not in seen.noted:
            seen.noted[NORMALS] = cls._of_tile(shapes, seen, pixels.from_eye)
        return seen.noted[NORMALS]

    @classmethod
    def _of_tile(cls, shapes: InCamera, seen: SeenTriangles, from_eye: bool) -> TriangleNormals:
        count, step = len(seen.at), tuning.SURFACES
        meshes = np.flatnonzero(np.bincount(shapes.shapes.mesh[seen.at]))
        are_flat = all(shapes.shapes.meshes[k].normals is None for k in meshes.tolist())
        constant = np.empty((3, count))
        slope = None if are_flat else np.empty((3, 3, count))
        area = None if from_eye else np.empty((3, count))
        for chunk in (slice(first, first + step) for first in range(0, count, step)):
            triangles = HitTriangles(shapes, seen.at[:0], seen.at[chunk], seen.number[chunk], from_eye)
            turn = -np.sign(dot(triangles.area, triangles.corners[0])) if from_eye else 1.0
            if area is not None:
                area[:, chunk] = triangles.area
            if slope is None:
                constant[:, chunk] = turn * np.array(triangles.area)
                continue
            constant[:, chunk], slope[..., chunk] = triangles.affine(turn * triangles.corner_normals)
        if slope is None:
            constant *= _over_length(constant)
        return cls(constant, slope, area)

    def at(self, pixels: HitPixels, point: Any, direction: Any) -> Any:
        """Return the unit normals turned towards the rays, as in Blender's Normal pass; (m,) components.

        The sign comes from the side of the face that is hit, not from the interpolated normal. The result is 0 where
        the interpolated normals cancel.
        """
        triangle = pixels.in_tile(pixels.known[MESH].of_pixel).astype(np.intp)
        if self.slope is None:
            normal = taken(self.constant, triangle)
        else:
            normal = affine_at(triangle, self.constant, self.slope, point)
            normal *= _over_length(normal)
        if self.area is not None:
            normal *= -np.sign(dot(taken(self.area, triangle), direction))
        return normal


def _over_length(vector: np.ndarray) -> np.ndarray:
    """Return what makes a vector, (3, n), a unit vector, or 0 if it is that."""
    return 1 / np.maximum(norm(vector), np.finfo(float).tiny)
