"""The record of a triangle mesh, which all its instances share, and what is derived from it once."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .tuning import MESH_BLOCK

SAMPLED = 1024
"""Number of vertices, evenly spaced in their order, that say where most of them lie."""

FARTHEST = 1e6
"""Size of a mesh over that of its middle half from which on the middle of its bounding box is not its own middle."""


@dataclass(frozen=True, eq=False)
class Mesh:
    """The triangles of an evaluated mesh in its object's space; instances share one mesh. A loop is a corner of a face.

    Data of vertices and triangles have one contiguous row per component or corner. Data of loops are read at scattered
    loops; the components of a loop are therefore contiguous.
    """

    vertices: np.ndarray
    """(3, v) float32; float64 if interpolated between evaluations."""
    triangles: np.ndarray
    """(3, k) int32: the vertices of each triangle, counterclockwise as seen from its front."""
    polygon: np.ndarray
    """(k,) int32: the face to which each triangle belongs."""
    loops: np.ndarray | None = None
    """(3, k) int32: the loops of each triangle; None if neither normals nor uv are stored by loop."""
    normals: np.ndarray | None = None
    """(l, 3) float32: unit normals at the loops; None if all faces are flat and have the normals of their triangles."""
    uv: np.ndarray | None = None
    """(l, 2) float32: the render UV map at the loops; None without a UV map."""
    slot: np.ndarray | None = None
    """(k,) int16: the material slot of each triangle; None if all have the first slot."""
    layers: tuple[tuple[str, np.ndarray], ...] = ()
    """Further attributes that the materials use, by name: at the corners of triangles, (3, k, channels) float32."""
    own_middle: np.ndarray | None = None
    """(3,) float64: ``middle`` of a mesh between evaluations, which is the mean of theirs; None for ``box_middle``."""

    def __len__(self) -> int:
        return self.triangles.shape[1]

    @property
    def middle(self) -> np.ndarray:
        """(3,) float64: the point from which places are computed: ``own_middle``, or else ``box_middle``."""
        return self.box_middle if self.own_middle is None else self.own_middle

    @cached_property
    def box_middle(self) -> np.ndarray:
        """(3,) float64: the middle of the bounding box. If a few vertices lie so far away that the others would lose
        their digits, it is the median of some of the vertices instead.
        """
        low, high = self.vertices.min(axis=1).astype(np.float64), self.vertices.max(axis=1).astype(np.float64)
        sampled = np.sort(self.vertices[:, :: max(1, self.vertices.shape[1] // SAMPLED)].astype(np.float64))
        first, median, last = (sampled[:, sampled.shape[1] * k // 4] for k in (1, 2, 3))
        return np.where(high - low > FARTHEST * (last - first).max(), median, low / 2 + high / 2)

    @cached_property
    def blocks(self) -> tuple[np.ndarray, np.ndarray]:
        """The middles, relative to ``middle``, and the half sizes of the bounding boxes of the blocks: (3, b) float64
        each. A block is MESH_BLOCK consecutive triangles; the last may have fewer.
        """
        starts = np.arange(0, len(self), MESH_BLOCK)
        lows, highs = [], []
        for corner in self.triangles:
            places = self.vertices.take(corner, axis=1)
            lows.append(np.minimum.reduceat(places, starts, axis=1))
            highs.append(np.maximum.reduceat(places, starts, axis=1))
        low, high = (ends.astype(np.float64) / 2 for ends in (np.min(lows, axis=0), np.max(highs, axis=0)))
        return low + high - self.middle[:, None], high - low

    @cached_property
    def is_outer(self) -> np.ndarray:
        """(3, k) bool: whether the side opposite each corner is an edge of the face, not a diagonal within the face."""
        ends = np.sort([self.triangles[[1, 2, 0]], self.triangles[[2, 0, 1]]], axis=0).reshape(2, -1)
        sides = np.vstack((np.tile(self.polygon, 3), ends))
        order = np.lexsort(sides)
        same = (np.diff(sides[:, order], axis=1) == 0).all(axis=0)
        outer = np.ones(len(order), bool)
        outer[order[1:][same]] = outer[order[:-1][same]] = False
        return outer.reshape(3, -1)

    def middles(self, triangles: np.ndarray) -> np.ndarray:
        """Return the middles, (3, 1), from which the places of some triangles are computed; or (3, k), of each."""
        return self.middle[:, None]

    @cached_property
    def half_size(self) -> np.ndarray:
        """(3,) float64: the largest distance of a vertex from the middle along each axis."""
        return np.abs(self.vertices - self.middle[:, None]).max(axis=1)


@dataclass(frozen=True, eq=False, kw_only=True)
class LooseTriangles(Mesh):
    """Triangles that share no vertices, each with the middle of its mesh at a time of its own."""

    middle_of: np.ndarray
    """(3, k)."""
    outer: np.ndarray
    """(3, k) bool: ``is_outer`` in their meshes."""

    def middles(self, triangles: np.ndarray) -> np.ndarray:
        """See ``Mesh``."""
        return self.middle_of[:, triangles]

    @cached_property
    def is_outer(self) -> np.ndarray:
        """See ``Mesh``."""
        return self.outer

    @cached_property
    def half_size(self) -> np.ndarray:
        """See ``Mesh``."""
        return np.abs(self.vertices.reshape(3, 3, -1) - self.middle_of[:, None]).max(axis=(1, 2), initial=0.0)
