"""One shape where it is at the time of each ray: a row of ``Shapes`` for each ray, and the nearest hits of these.

A ray meets a mesh by a tree of its triangles in the mesh's own frame, to which the ray is brought; the triangles that
it may meet are tested in the world, where they are then.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from weakref import WeakKeyDictionary

import numpy as np

from ..conventions import gamma
from ..maths.speed import Scratch, taken
from ..mesh import Mesh
from ..motion.apart import rows_of
from ..records import MESH, Shapes
from ..shapes.frames import InCamera
from ..shapes.in_camera import in_camera
from ..shapes.kinds import by_kind
from .packets import coherent_order, packets_of
from .search import WORLD, Found, RayHits, keep_nearest, met
from .traversal import Traversal
from .tree import Tree, tree_of
from .written import Span

SLACK = 1e-6
"""Fraction by which boxes are enlarged: far more than rounding."""

PAIRS = 1 << 16
"""Number of pairs of rays and triangles that are tested at once, of meshes without a tree. Not tuned."""


@dataclass(frozen=True, eq=False)
class RowsPlaced:
    """Shapes by row, each at a place of its own, one for each ray."""

    row: np.ndarray
    """(n,)."""
    center: np.ndarray
    """(n, 3)."""
    axes: np.ndarray
    """(n, 3, 3)."""

    def shapes(self, shapes: Shapes) -> Shapes:
        """Return these rows of shapes, each at its place."""
        return replace(rows_of(shapes, self.row), center=self.center, axes=self.axes)


class FoundParts(Found):
    """A part of each of some shapes: its triangle by number, or the whole of another shape."""

    def __init__(self, shapes: Shapes, number: np.ndarray):
        super().__init__(shapes)
        self.at, self.number = np.arange(len(shapes)), number


def nearest(shapes: Shapes, origin: np.ndarray, direction: np.ndarray, span: Span) -> tuple[np.ndarray, np.ndarray]:
    """Return t of the nearest hit of each ray (3, n) on the shape of its number, all of one kind and mesh, inf for
    none, and the number of the triangle, -1 for none.
    """
    near, far = span
    placed, scratch = in_camera(shapes, WORLD), Scratch()
    ((kind, _),) = by_kind(shapes.kind)
    t, number = np.full(origin.shape[1], np.inf), np.full(origin.shape[1], -1)
    rays = np.arange(len(t))
    with np.errstate(all="ignore"):  # NaN and inf mean no hit
        for ray, part in _candidates(placed, origin, direction, near, lambda: np.minimum(t, far)):
            bodies = kind.bodies(placed, ray, part)
            own = taken(origin, ray), taken(direction, ray)
            for hits in met(bodies, np.arange(len(ray)), ray, own, near, far, scratch, twice=False):
                keep_nearest(RayHits(hits.ray, hits.t, part[hits.body]), t, number, rays)
    return t, number


def _candidates(
    placed: InCamera, origin, direction, near: float, limit: Callable[[], np.ndarray]
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield rays and the triangles that they may meet, (m,) each; 0 for shapes that are no meshes."""
    rays = np.arange(origin.shape[1])
    if placed.shapes.kind[0] != MESH:
        yield rays, np.zeros(len(rays), np.int32)
        return
    mesh = placed.shapes.meshes[0]
    to_mesh, away = placed.shape_from_world, origin.T - placed.center
    rounding = 2 * (placed.rounding + gamma(4)) * np.linalg.norm(to_mesh, axis=2).max(axis=1)
    rounding *= np.linalg.norm(away, axis=1) + placed.radius
    if not (rounding < SLACK / 2 * _reach(mesh)).all():  # flat, or far away
        for some in np.array_split(rays, -(-len(rays) * len(mesh) // PAIRS)):
            yield np.repeat(some, len(mesh)), np.tile(np.arange(len(mesh), dtype=np.int32), len(some))
        return
    start, ahead = (np.einsum("nij,nj->in", to_mesh, vector) for vector in (away, direction.T))
    order = coherent_order(start, ahead)
    packets = packets_of(start[:, order], ahead[:, order])
    for ray, part in Traversal(_tree_of(mesh), packets, near, lambda: packets.farthest(limit()[order])).pairs():
        yield order[ray], part.astype(np.int32)


def _reach(mesh: Mesh) -> float:
    return float(np.abs(mesh.vertices - mesh.middle[:, None]).max())


_trees: WeakKeyDictionary[Mesh, Tree] = WeakKeyDictionary()


def _tree_of(mesh: Mesh) -> Tree:
    """Return the tree of a mesh's triangles in its own frame, by boxes that are enlarged."""
    if mesh not in _trees:
        ends = [(mesh.vertices - mesh.middle[:, None])[:, corner] for corner in mesh.triangles]
        slack = SLACK * _reach(mesh)
        low, high = np.minimum.reduce(ends) - slack, np.maximum.reduce(ends) + slack
        _trees[mesh] = tree_of(low, high, np.arange(len(mesh)))
    return _trees[mesh]
