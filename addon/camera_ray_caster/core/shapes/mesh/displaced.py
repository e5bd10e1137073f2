"""True displacement: vertices of a mesh are moved, along their normals or not, by the displacement of their materials.

As in Cycles without adaptive subdivision, each vertex is moved once: by the material of the first triangle that has
the vertex and a displacement, with the map and the attributes of that triangle's corner, and along the normal of the
vertex, also where faces are flat. Normals of smooth faces are computed anew, the mean of the unit normals of the
triangles around a vertex, unless all materials keep them. In Blender before 5.2 the triangles without a displacement
do not count in that mean; here they do in every version.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...materials.values import OBJECT, UV, Places, Value
from ...mesh import Mesh

FARTHEST = 1e30
"""Offsets from which on, and those that are NaN, a vertex is not moved: float32 could not store its place."""


@dataclass(frozen=True)
class Displacement:
    """How a material moves vertices."""

    offset: Value
    """How far, in the object's space: one channel along the normals, or a vector of three."""
    turns: bool
    """Whether normals are computed anew; otherwise they stay those of the mesh."""


@dataclass(frozen=True, eq=False)
class MeshNormals:
    """The normals of a mesh before the displacement."""

    smooth: np.ndarray
    """(k,) bool: which triangles are smooth."""
    vertices: np.ndarray
    """(3, v): unit normals at the vertices."""


def displaced(mesh: Mesh, before: MeshNormals, materials: Sequence[Displacement | None]) -> Mesh:
    """Return a mesh moved by the displacement of its material slots; of slots after the last one that of the last."""
    slots = np.zeros(len(mesh), int) if mesh.slot is None else np.minimum(mesh.slot, len(materials) - 1)
    moves = np.array([material is not None for material in materials])[slots]
    vertices = mesh.vertices.astype(np.float64)
    corner, triangle = _first_corners(mesh, np.flatnonzero(moves))
    at = mesh.triangles[corner, triangle]
    for slot in np.unique(slots[triangle]).tolist():
        of_slot = np.flatnonzero(slots[triangle] == slot)
        offset = materials[slot].offset.at(_Corners(mesh, corner[of_slot], triangle[of_slot]))
        offset = np.where(np.abs(offset) < FARTHEST, offset, 0.0)
        vertices[:, at[of_slot]] += offset if len(offset) == 3 else offset * before.vertices[:, at[of_slot]]
    turns = any(material is not None and material.turns for material in materials)
    return _with_normals(replace(mesh, vertices=vertices.astype(np.float32)), mesh, before, turns)


def _first_corners(mesh: Mesh, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return a corner and a triangle, (m,) each, for each vertex of some triangles: the first of these that has it."""
    _, first = np.unique(mesh.triangles[:, triangles].T.reshape(-1), return_index=True)
    return first % 3, triangles[first // 3]


def _normals(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Return the unit normals of triangles, (3, k); 0 without an area."""
    a, b, c = (vertices[:, corner] for corner in triangles)
    normals = np.cross(b - a, c - a, axis=0)
    length = np.sqrt((normals * normals).sum(axis=0))
    return normals / np.where(length > 0, length, 1.0)


def _with_normals(moved: Mesh, mesh: Mesh, before: MeshNormals, turns: bool) -> Mesh:
    """Return a moved mesh with its normals; each triangle has loops of its own if some faces are flat."""
    if not before.smooth.any():
        return replace(moved, normals=None)
    faces, around = _normals(moved.vertices.astype(np.float64), mesh.triangles), before.vertices.astype(np.float64)
    if turns:
        count, corners = around.shape[1], mesh.triangles.reshape(-1)
        around = np.array([np.bincount(corners, np.tile(axis, 3), count) for axis in faces])
        length = np.sqrt((around * around).sum(axis=0))
        around /= np.where(length > 0, length, 1.0)
    normals = np.where(before.smooth, around[:, mesh.triangles].transpose(1, 0, 2), faces)  # (corner, axis, triangle)
    loops = np.arange(3 * len(mesh), dtype=np.int32).reshape(3, -1)
    uv = None if mesh.uv is None or mesh.loops is None else mesh.uv[mesh.loops].reshape(-1, 2)
    return replace(moved, loops=loops, normals=normals.transpose(0, 2, 1).reshape(-1, 3).astype(np.float32), uv=uv)


class _Corners(Places):
    """Corners of triangles as places of expressions: see ``Places``."""

    def __init__(self, mesh: Mesh, corner: np.ndarray, triangle: np.ndarray):
        super().__init__()
        self._mesh, self._corner, self._triangle = mesh, corner, triangle

    def coordinates(self, name: str) -> np.ndarray:
        mesh, result = self._mesh, np.zeros((3, len(self._corner)))
        if name == UV and mesh.uv is not None and mesh.loops is not None:
            result[:2] = mesh.uv[mesh.loops[self._corner, self._triangle]].T
        elif name == OBJECT:
            result[:] = mesh.vertices[:, mesh.triangles[self._corner, self._triangle]]
        return result

    def layer(self, name: str, channels: int) -> np.ndarray:
        values = dict(self._mesh.layers).get(name)
        if values is None:
            return np.zeros((channels, len(self._corner)))
        return values[self._corner, self._triangle].T.astype(np.float64)
