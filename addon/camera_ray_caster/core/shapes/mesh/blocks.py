"""Blocks of meshes: some consecutive triangles, in most meshes neighbors, that are found visible or hidden together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from itertools import product

import numpy as np

from ... import tuning
from ...conventions import gamma
from ...maths.speed import lazy, taken
from ...maths.vector import inverse
from ...mesh import Mesh
from ..hulls import HullPoints
from ..kind import PixelBounds
from ..shape_frames import InCamera
from ..windows import counted


@dataclass(frozen=True, eq=False)
class Blocks:
    """Blocks of the meshes in view that some pixel may see, in the order of their shapes; (b,) arrays."""

    shape: np.ndarray
    """Indices into ``Shapes``."""
    first: np.ndarray
    """The first triangle of each block, an index into the triangles of the mesh."""
    count: np.ndarray
    """The number of triangles in each block."""
    vertex: np.ndarray
    """The index of the first vertex of the shape."""
    bounds: np.ndarray
    """(b, 4): x0, x1, y0, y1 in the pixels of the plan."""
    near: np.ndarray
    """Lower bounds of t; -inf where none is known."""

    @classmethod
    def joined(cls, parts: Sequence[Blocks]) -> Blocks:
        """Return the blocks of several parts, in their order."""
        return cls(*(np.concatenate([getattr(blocks, field.name) for blocks in parts]) for field in fields(cls)))

    @lazy
    def start(self) -> np.ndarray:
        """(b + 1,): the number of triangles before each block, and of all."""
        return np.append(0, np.cumsum(self.count))

    def numbers(self, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the shapes of some triangles of all blocks, and their indices in the meshes."""
        block = np.searchsorted(self.start, triangles, side="right") - 1
        return self.shape[block], triangles + (self.first - self.start[:-1])[block]


class BlockRows:
    """All blocks of some shapes, given by their indices (n,), each of which shows a mesh, and their first vertices."""

    def __init__(self, shapes: InCamera, rows: np.ndarray, vertex: np.ndarray):
        self._shapes, self._rows, self._vertex = shapes, rows, vertex
        used, mesh = np.unique(shapes.shapes.mesh[rows], return_inverse=True)
        self._meshes = [shapes.shapes.meshes[k] for k in used.tolist()]
        sizes = np.array([(_block_count(shown), len(shown)) for shown in self._meshes]).reshape(-1, 2)
        blocks, self._triangles = sizes[mesh].T
        self._row, self._block = counted(blocks, np.zeros_like(blocks))
        self._box = self._block + (np.cumsum(sizes[:, 0]) - sizes[:, 0])[mesh][self._row]

    def __len__(self) -> int:
        return len(self._row)

    @lazy
    def _boxes(self) -> tuple[np.ndarray, np.ndarray]:
        """The middles and half sizes of the boxes of all meshes: see ``Mesh.blocks``."""
        middles, halves = zip(*(mesh.blocks for mesh in self._meshes), strict=True)
        return np.concatenate(middles, axis=1), np.concatenate(halves, axis=1)

    def in_view(self, pixels: PixelBounds, chunk: slice) -> Blocks:
        """Return those of a part of the blocks that some pixel may see, from boxes in the camera's frame that hold the
        rounded vertices.
        """
        row, block = self._row[chunk], self._block[chunk]
        offset, half = (taken(values, self._box[chunk]) for values in self._boxes)
        axes = taken(camera_axes(self._shapes, self._rows).transpose(1, 2, 0), row)
        center = taken(self._shapes.center[self._rows].T, row)
        size = np.abs(axes)
        lost = size.sum(axis=(0, 1)) * (np.abs(offset) + half).sum(axis=0) + np.abs(center).sum(axis=0)
        middle = center + (axes * offset).sum(axis=1)
        reach = (size * half).sum(axis=1) + gamma(16) * lost
        count = len(row)
        corners = HullPoints(pixels, 8 * count)
        signs = np.array([*product((-1.0, 1.0), repeat=3)]).T
        corners.write(slice(None), (middle[:, None] + reach[:, None] * signs[..., None]).reshape(3, -1))
        bounds, near, seen = corners.hulls(np.arange(8 * count).reshape(8, -1))
        row, first = row[seen], block[seen] * tuning.MESH_BLOCK
        return Blocks(
            shape=self._rows[row],
            first=first,
            count=np.minimum(self._triangles[row] - first, tuning.MESH_BLOCK),
            vertex=self._vertex[row],
            bounds=bounds,
            near=near,
        )


def camera_axes(shapes: InCamera, rows: np.ndarray) -> np.ndarray:
    """Return the axes of some shapes in the camera's frame, (n, 3, 3)."""
    return np.einsum("ij,njk->nik", inverse(shapes.pose.basis), shapes.shapes.axes[rows])


def vertex_count(mesh: Mesh) -> int:
    """Return the number of vertices of a mesh."""
    return mesh.vertices.shape[1]


def _block_count(mesh: Mesh) -> int:
    return -(-len(mesh) // tuning.MESH_BLOCK)
