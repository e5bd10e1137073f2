"""The triangles of a mesh that bends: where they are at the times of rays, and trees of the space that they sweep.

Between evaluations a vertex moves on a polynomial, and stays among its Bezier points. Time is cut into slices so short
that few triangles move by more than their own size in one; the box of a triangle in a slice is that of the Bezier
points of its corners.
Reference: G. Farin, Curves and Surfaces for CAGD (convex hull property).
"""

from collections.abc import Iterator
from itertools import pairwise
from math import comb

import numpy as np

from ..maths.speed import lazy
from ..mesh import LooseTriangles, Mesh
from ..motion.apart import mesh_of
from ..motion.bending_triangles import triangles_at
from ..motion.evaluations import Motion
from ..motion.interpolation import TimeInterval
from .tree import Tree, tree_of

BOX_MARGIN = 1e-6
"""Fraction by which boxes are enlarged: far more than rounding, and than the rounding of times."""

SLICES = 32
"""Largest number of slices of an interval. Not tuned."""

MOVED_SIZES = 2.0
"""Number of sizes of triangles by which they may move in a slice."""


class Form:
    """The mesh of a shape over a motion in which it bends."""

    def __init__(self, motion: Motion, row: int):
        self._motion, self._row = motion, row
        self.mesh: Mesh = mesh_of(next(iter(motion.states.values()))[1], row)

    def __len__(self) -> int:
        return len(self.mesh)

    def at(self, number: np.ndarray, frames: np.ndarray) -> LooseTriangles:
        """Return triangles, (k,) by number, each as it is at a frame of its own, (k,)."""
        return triangles_at(self._motion, self._row, number, frames)

    @lazy
    def box(self) -> np.ndarray:
        """(2, 3): the lowest and the highest corner of all places of vertices, from the middle of the mesh then."""
        points = [_bezier(span, self._row, span.frames[0], span.frames[-1]) for span in self._motion.intervals]
        return np.array((
            np.min([each.min(axis=(0, 2)) for each in points], axis=0),
            np.max([each.max(axis=(0, 2)) for each in points], axis=0),
        ))  # fmt: skip

    @lazy
    def reach(self) -> float:
        """The largest distance of a vertex from the middle of the mesh, along an axis."""
        return float(np.abs(self.box).max())

    @lazy
    def hull(self) -> Mesh:
        """A mesh without triangles whose bounds are those of the mesh at all times."""
        return Mesh(self.box.T, np.zeros((3, 0), np.int32), np.zeros(0, np.int32), own_middle=np.zeros(3))

    def slices(self, frames: np.ndarray) -> Iterator[tuple[Tree, np.ndarray]]:
        """Yield trees of boxes from the middle of the mesh, and the indices of the frames (n,) for which they hold."""
        for interval, indices in self._motion.parts(frames):
            first, last = interval.frames[0], interval.frames[-1]
            ends = np.linspace(first, last, self._count(interval) + 1)
            piece = np.clip(np.searchsorted(ends, frames[indices], side="right") - 1, 0, len(ends) - 2)
            for k, (start, end) in enumerate(pairwise(ends.tolist())):
                if (now := indices[piece == k]).size:
                    yield self._tree(interval, start, end), now

    def _count(self, interval: TimeInterval) -> int:
        points = _bezier(interval, self._row, interval.frames[0], interval.frames[-1])
        moved = np.abs(np.diff(points, axis=0)).sum(axis=0).max()
        corners = points[0][:, self.mesh.triangles]
        size = np.median((corners.max(axis=1) - corners.min(axis=1)).max(axis=0))
        return int(np.clip(np.ceil(moved / max(MOVED_SIZES * size, moved / SLICES)), 1, SLICES)) if moved > 0 else 1

    def _tree(self, interval: TimeInterval, start: float, end: float) -> Tree:
        points = _bezier(interval, self._row, start, end)
        low, high = points.min(axis=0) - BOX_MARGIN * self.reach, points.max(axis=0) + BOX_MARGIN * self.reach
        corners = self.mesh.triangles
        return tree_of(low[:, corners].min(axis=1), high[:, corners].max(axis=1), np.arange(len(self)))


def _bezier(interval: TimeInterval, row: int, start: float, end: float) -> np.ndarray:
    """Return the Bezier points of the vertices from ``start`` to ``end``, (points, 3, v), from the mesh's middle."""
    degree = len(interval.frames) - 1
    forms = np.array([mesh.vertices - mesh.middle[:, None] for mesh in (mesh_of(s, row) for _, s in interval.states)])
    parameter = np.linspace(0, 1, degree + 1)
    basis = [[comb(degree, k) * u**k * (1 - u) ** (degree - k) for k in range(degree + 1)] for u in parameter.tolist()]
    weights = np.array(interval.weights(start + (end - start) * parameter)).T
    return np.tensordot(np.linalg.solve(np.array(basis), weights), forms, axes=1)
