"""Meshes as a camera sees them: vertices in its frame, and the pixels in which each triangle may be seen.

Only the triangles of blocks that are neither out of view nor hidden are bounded one by one: see ``mesh_blocks``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from .. import tuning
from ..maths.speed import Shared, lazy, taken
from ..memory import require
from ..mesh import Mesh
from .frames import InCamera
from .hulls import Points
from .kind import Visible
from .mesh_blocks import BlockRows, Blocks, camera_axes, vertex_count
from .triangles import side
from .windows import counted

VERTEX_BYTES, TRIANGLE_BYTES = 40, 32
"""Upper bounds of the memory of each vertex and each triangle in view."""

FEWER = "show fewer instances, or reduce the subdivision"


@dataclass(frozen=True, eq=False)
class Triangles:
    """Some triangles that some pixel may see."""

    which: np.ndarray
    """(k,): their indices among the triangles of all blocks; in a search their numbers there, see ``Found.enter``."""
    corners: np.ndarray
    """(3, k) indices of vertices."""
    bounds: np.ndarray
    """(k, 4): x0, x1, y0, y1."""
    near: np.ndarray
    """(k,): lower bounds of t; -inf where none is known."""

    def __len__(self) -> int:
        return len(self.which)

    def only(self, some: np.ndarray | slice, bounds: np.ndarray | None = None) -> Triangles:
        """Return some of them, by index, with other bounds if these are given; or a part of them, as views."""
        if isinstance(some, slice):
            return Triangles(self.which[some], self.corners[:, some], self.bounds[some], self.near[some])
        bounds = self.bounds.take(some, axis=0) if bounds is None else bounds
        return Triangles(taken(self.which, some), taken(self.corners, some), bounds, taken(self.near, some))


class Instances(NamedTuple):
    """Some consecutive shapes that show the same mesh."""

    mesh: Mesh
    rows: np.ndarray
    """Indices into ``Shapes``."""
    start: int
    """Index of the first vertex of the first instance; the other instances follow."""


class MeshesInView:
    """The meshes in view, computed at first use by all threads that need them.

    Rounding: the error of a vertex is at most gamma(8) times the sum of two lengths: that of the axes times that of the
    vertex from the mesh's middle, and that of the shape's center. All triangles that share a vertex use the same
    rounded position, since it is transformed by the same operations.
    """

    def __init__(self, shapes: InCamera, visible: Visible):
        self._shapes, self._from_eye = shapes, visible.from_eye
        groups = list(_groups(shapes, visible.at))
        total, count = (sum(len(group.rows) * n(group.mesh) for group in groups) for n in (vertex_count, len))
        require(VERTEX_BYTES * total + TRIANGLE_BYTES * count, f"{count:,} triangles in view", FEWER)
        self._vertices = Points(visible.pixels, total)
        self._index = np.int32 if total < 2**31 else np.int64
        self._placing = Shared([
            partial(self._place, group, part)
            for group in groups
            for part in _parts(vertex_count(group.mesh), tuning.CHUNK)
        ])  # fmt: skip
        self._imaging = Shared([
            partial(self._vertices.image, part)
            for part in _parts(total, tuning.CHUNK)
        ])  # fmt: skip
        rows = BlockRows(shapes, visible.at)
        self._boxing = Shared([
            partial(rows.in_view, visible.pixels, part)
            for part in _parts(max(len(rows), 1), tuning.CHUNK)
        ])  # fmt: skip

    def prepare(self) -> Iterator[None]:
        """Do all work that is left, in small steps."""
        for step in (self._placing, self._imaging, self._boxing):
            yield from step.work()
            step.results()

    @lazy
    def blocks(self) -> Blocks:
        """The blocks that some pixel may see."""
        return Blocks.joined(self._boxing.results())

    def triangles(self, some: np.ndarray) -> Triangles:
        """Return the triangles of some blocks, ascending, that some pixel may see."""
        blocks = self.blocks
        run, number = counted(blocks.count[some], blocks.first[some])
        corners = taken(blocks.vertex[some].astype(self._index), run) + np.zeros((3, 1), self._index)
        mesh = self._shapes.shapes.mesh[blocks.shape[some]]
        cuts = np.searchsorted(run, np.flatnonzero(np.diff(mesh)) + 1)
        for first, last in pairwise((0, *cuts.tolist(), len(run))):
            if first < last:
                shown = self._shapes.shapes.meshes[mesh[run[first]]]
                corners[:, first:last] += taken(shown.triangles, number[first:last])
        bounds, near, seen = self._vertices.hulls(corners)
        which = taken(number, seen) + taken((blocks.start[:-1] - blocks.first)[some], taken(run, seen))
        return Triangles(which, taken(corners, seen), bounds, near)

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

    def _place(self, group: Instances, some: slice) -> None:
        """Transform some vertices of a mesh for all instances of the group."""
        rows, count = group.rows, vertex_count(group.mesh)
        axes = camera_axes(self._shapes, rows)[..., None]
        q = group.mesh.vertices[:, some] - group.mesh.middle[:, None]
        own = slice(group.start, group.start + len(rows) * count)
        for i in range(3):
            place = self._vertices.places[i, own].reshape(len(rows), count)[:, some]
            np.add(axes[:, i, 1] * q[1], axes[:, i, 2] * q[2], out=place)
            place += axes[:, i, 0] * q[0]
            place += self._shapes.center[rows, i, None]


def _parts(count: int, most: int) -> Iterator[slice]:
    """Yield slices that divide ``count`` items into parts of at most ``most``."""
    for first in range(0, count, most):
        yield slice(first, min(first + most, count))


def _groups(shapes: InCamera, rows: np.ndarray) -> Iterator[Instances]:
    """Yield the instances of each mesh, in groups that fill a chunk with vertices or triangles."""
    mesh, start = shapes.shapes.mesh[rows], 0
    cuts = np.flatnonzero(np.diff(mesh)) + 1
    for first, last in pairwise((0, *cuts.tolist(), len(rows))):
        own = shapes.shapes.meshes[mesh[first]]
        for part in _parts(last - first, max(1, tuning.CHUNK // max(vertex_count(own), len(own), 1))):
            group = Instances(own, rows[first:last][part], start)
            start += len(group.rows) * vertex_count(own)
            yield group
