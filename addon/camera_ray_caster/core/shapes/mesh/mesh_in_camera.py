"""Meshes as a camera sees them: vertices in its frame, and the pixels in which each triangle may be seen.

Only shapes with blocks that are neither out of view nor hidden are placed, and only the triangles of these blocks are
bounded one by one: see ``blocks``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np

from ... import tuning
from ...maths.speed import Shared, lazy, taken
from ...memory import require
from ..hulls import HullPoints
from ..kind import Visible
from ..shape_frames import InCamera
from ..windows import counted
from .blocks import BlockRows, Blocks, camera_axes, vertex_count
from .triangles import side

VERTEX_BYTES, TRIANGLE_BYTES, KEPT_BYTES = 40, 32, 24
"""Upper bounds of the memory of each vertex and each triangle in view, and of its bounds that are kept."""

FEWER = "show fewer instances, or reduce the subdivision"


@dataclass(frozen=True, eq=False)
class Triangles:
    """Some triangles that some pixel may see."""

    index: np.ndarray
    """(k,): their indices among the triangles of all blocks; in a search their numbers there, see ``Nearest.enter``."""
    corners: np.ndarray
    """(3, k) indices of vertices."""
    bounds: np.ndarray
    """(k, 4): x0, x1, y0, y1."""
    near: np.ndarray
    """(k,): lower bounds of t; -inf where none is known."""

    def __len__(self) -> int:
        return len(self.index)

    def only(self, indices: np.ndarray | slice, bounds: np.ndarray | None = None) -> Triangles:
        """Return some of them, by index, with other bounds if these are given; or a part of them, as views."""
        if isinstance(indices, slice):
            return Triangles(self.index[indices], self.corners[:, indices], self.bounds[indices], self.near[indices])
        bounds = self.bounds.take(indices, axis=0) if bounds is None else bounds
        return Triangles(taken(self.index, indices), taken(self.corners, indices), bounds, taken(self.near, indices))


class MeshesInView:
    """The meshes in view. Threads share the work: the blocks of all meshes are bounded, vertices are placed shape by
    shape, if a block of the shape may be seen.

    Rounding: the error of a vertex is at most gamma(8) times the sum of two lengths: that of the axes times that of the
    vertex from the mesh's middle, and that of the shape's center. All triangles that share a vertex use the same
    rounded position, since it is transformed by the same operations.
    """

    def __init__(self, shapes: InCamera, visible: Visible):
        self._shapes, self._at, self._from_eye = shapes, visible.at, visible.from_eye
        self._mesh = shapes.shapes.mesh[visible.at]
        sizes = np.array([(vertex_count(mesh), len(mesh)) for mesh in shapes.shapes.meshes])[self._mesh]
        total, count = sizes.sum(axis=0).tolist()
        self._has_straight_lines = visible.pixels.has_straight_lines
        each = TRIANGLE_BYTES if self._has_straight_lines else TRIANGLE_BYTES + KEPT_BYTES
        require(VERTEX_BYTES * total + each * count, f"{count:,} triangles in view", FEWER)
        self._start = np.cumsum(sizes[:, 0]) - sizes[:, 0]
        self.chunk = tuning.CHUNK if self._has_straight_lines else tuning.BALLS
        """Number of triangles or blocks to be bounded at once."""
        self._vertices = HullPoints(visible.pixels, total)
        self.is_planar = visible.pixels.is_planar
        self._index = np.int32 if total < 2**31 else np.int64
        rows = BlockRows(shapes, visible.at, self._start)
        self._boxing = Shared([
            partial(rows.in_view, visible.pixels, chunk)
            for chunk in _parts(max(len(rows), 1), self.chunk)
        ])  # fmt: skip
        placing: list[Callable[[], None]] = []
        self._placed_by = np.zeros((2, len(visible.at)), np.intp)
        for group in _together(self._mesh, visible.near, sizes.max(axis=1)):
            parts = [partial(self._place, group, chunk) for chunk in _parts(sizes[group[0], 0], tuning.CHUNK)]
            self._placed_by[:, group] = [[len(placing)], [len(parts)]]
            placing += parts
        self._placing = Shared(placing)

    def prepare(self) -> Iterator[None]:
        """Compute the bounds of the blocks, in small steps."""
        yield from self._boxing.work()

    def place(self, blocks: np.ndarray) -> Iterator[None]:
        """Place the shapes of some blocks, in small steps."""
        first, count = self._placed_by[:, np.searchsorted(self._at, np.unique(self.blocks.shape[blocks]))]
        yield from self._placing.work(np.unique(counted(count, first)[1]))

    @lazy
    def blocks(self) -> Blocks:
        """The blocks that some pixel may see."""
        return Blocks.joined(self._boxing.results())

    def triangles(self, indices: np.ndarray) -> Triangles:
        """Return the triangles of some blocks, ascending, that some pixel may see."""
        blocks = self.blocks
        run, number = counted(blocks.count[indices], blocks.first[indices])
        corners = taken(blocks.vertex[indices].astype(self._index), run) + np.zeros((3, 1), self._index)
        mesh = self._shapes.shapes.mesh[blocks.shape[indices]]
        cuts = np.searchsorted(run, np.flatnonzero(np.diff(mesh)) + 1)
        for first, last in pairwise((0, *cuts.tolist(), len(run))):
            if first < last:
                shown = self._shapes.shapes.meshes[mesh[run[first]]]
                corners[:, first:last] += taken(shown.triangles, number[first:last])
        offset = (blocks.start[:-1] - blocks.first)[indices]
        if self._has_straight_lines:
            bounds, near, seen = self._vertices.hulls(corners)
        else:
            bounds, near, seen = self._balls(indices, run, number + taken(offset, run), corners)
        index = taken(number, seen) + taken(offset, taken(run, seen))
        return Triangles(index, taken(corners, seen), bounds, near)

    def _balls(
        self, indices: np.ndarray, run: np.ndarray, number: np.ndarray, corners: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return ``HullPoints.hulls`` of the triangles of some blocks, which are kept for all samples: balls take a
        tenth of each sample. Threads that meet in a block write the same values.
        """
        is_bounded, all_bounds, all_near = self._bounded
        new = np.flatnonzero(taken(~is_bounded[indices], run))
        if new.size:
            bounds, near, seen = self._vertices.hulls(taken(corners, new))
            seen = taken(number, taken(new, seen))
            all_bounds[seen], all_near[seen] = bounds, near
            is_bounded[indices] = True
        bounds = all_bounds.take(number, axis=0)
        seen = np.flatnonzero(bounds[:, 0] < bounds[:, 1])
        return bounds.take(seen, axis=0), taken(all_near, taken(number, seen)), seen

    @lazy
    def _bounded(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Which blocks are bounded triangle by triangle so far, (b,), and of the triangles of all blocks the bounds,
        (k, 4), 0 where no pixel sees them, and lower bounds of t, (k,).
        """
        count = self.blocks.start[-1]
        return np.zeros(len(self.blocks.count), bool), np.zeros((count, 4), self._vertices.type), np.empty(count)

    def places(self, corners: np.ndarray) -> np.ndarray:
        """Return the places of vertices, (3, 3, m): corner, component."""
        return self._vertices.at(corners)

    def facing(self, corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the indices of those among some triangles that a ray may hit, and the places of their corners, given
        as indices of vertices. If all rays leave the eye, the corners are ordered so that all volumes of a hit are
        positive.
        """
        corners = self.places(corners)
        turn = side(corners) if self._from_eye else np.ones(corners.shape[2])
        meets = np.flatnonzero(turn)
        if len(meets) < len(turn):
            corners, turn = corners[:, :, meets], turn[meets]
        corners[1:] = np.where(turn > 0, corners[1:], corners[:0:-1])
        return meets, corners

    def _place(self, group: np.ndarray, chunk: slice) -> None:
        """Transform a part of the vertices of some shapes in view, which show the same mesh."""
        mesh, rows = self._shapes.shapes.meshes[self._mesh[group[0]]], self._at[group]
        axes = camera_axes(self._shapes, rows)[..., None]
        q = mesh.vertices[:, chunk] - mesh.middle[:, None]
        places = np.empty((3, len(group), q.shape[1]))
        for i, component in enumerate(places):
            np.add(axes[:, i, 1] * q[1], axes[:, i, 2] * q[2], out=component)
            component += axes[:, i, 0] * q[0]
            component += self._shapes.center[rows, i, None]
        first = self._start[group]
        at: Any = slice(first[0] + chunk.start, first[0] + chunk.stop)
        if len(group) > 1:
            at = (first[:, None] + np.arange(chunk.start, chunk.stop)).reshape(-1)
        self._vertices.write(at, places.reshape(3, -1))


def _parts(count: int, limit: int) -> Iterator[slice]:
    """Yield slices that divide ``count`` items into parts of at most ``limit``."""
    for first in range(0, count, limit):
        yield slice(first, min(first + limit, count))


def _together(mesh: np.ndarray, near: np.ndarray, size: np.ndarray) -> Iterator[np.ndarray]:
    """Yield the indices of shapes, given their meshes, least t and number of vertices or triangles, in groups of about
    CHUNK of these: neighbors in depth that show one mesh.
    """
    order = np.lexsort((near, mesh))
    for of_mesh in np.split(order, np.flatnonzero(np.diff(mesh[order])) + 1):
        for chunk in _parts(len(of_mesh), max(1, tuning.CHUNK // max(1, size[of_mesh[0]]))):
            yield of_mesh[chunk]
