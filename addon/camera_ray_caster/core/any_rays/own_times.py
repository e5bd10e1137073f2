"""One shape where it is at the time of each ray: a row of ``Shapes`` for each ray, and the hits on these.

A ray meets a mesh by a tree of its triangles in the mesh's own frame, to which the ray is brought, or of the boxes in
which they move; the triangles that it may meet are tested in the world, where they are then.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from ..conventions import gamma
from ..maths.speed import Scratch, memoized
from ..mesh import Mesh
from ..motion.apart import rows_of
from ..records import MESH, Shapes
from ..shapes.bodies import Bodies
from ..shapes.in_camera import in_camera
from ..shapes.kind import Kind
from ..shapes.kinds import by_kind
from ..shapes.shape_frames import InCamera
from .body_search import SearchedRays, keep_nearest, met
from .forms import BOX_MARGIN, Form
from .packets import coherent_order
from .ray_bodies import WORLD, RayBodies, RayHits, Span
from .traversal import Traversal
from .tree import Tree, tree_of

PAIRS_AT_ONCE = 1 << 16
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

    @classmethod
    def joined(cls, parts: list[RowsPlaced]) -> RowsPlaced:
        """Return all parts, one after the other."""
        names = "row", "center", "axes"
        return cls(*(np.concatenate([getattr(placed, name) for placed in parts]) for name in names))

    def only(self, indices: np.ndarray) -> RowsPlaced:
        """Return some of them, by index."""
        return RowsPlaced(self.row[indices], self.center[indices], self.axes[indices])

    def shapes(self, shapes: Shapes) -> Shapes:
        """Return these rows of shapes, each at its place."""
        return replace(rows_of(shapes, self.row), center=self.center, axes=self.axes)

    def parts(self, shapes: Shapes, forms: Mapping[int, Form], number: np.ndarray, times: np.ndarray) -> BodyParts:
        """Return a part of each, by number; of meshes that bend the triangle as it is at its time."""
        placed, number = self.shapes(shapes), number.copy()
        meshes, mesh = list(placed.meshes), placed.mesh.copy()
        for row in np.intersect1d(list(forms), self.row).astype(int).tolist():
            of_row = np.flatnonzero(self.row == row)
            mesh[of_row] = len(meshes)
            meshes.append(forms[row].at(number[of_row], times[of_row]))
            number[of_row] = np.arange(len(of_row))
        return BodyParts(replace(placed, meshes=tuple(meshes), mesh=mesh), number)


class BodyParts(RayBodies):
    """A part of each of some shapes: its triangle by number, or the whole of another shape."""

    def __init__(self, shapes: Shapes, number: np.ndarray):
        super().__init__(shapes)
        self.at, self.number = np.arange(len(shapes)), number


@dataclass(frozen=True, eq=False)
class OwnTimes:
    """Shapes of one kind and mesh, one for each ray, (3, n): where it is at the time of the ray, (n,)."""

    shapes: Shapes
    form: Form | None
    """If the mesh bends."""
    origin: np.ndarray
    direction: np.ndarray
    times: np.ndarray

    def nearest(self, span: Span) -> RayHits:
        """Return the nearest hit of each ray that has one; its body is the number of the triangle."""
        t, number = np.full(len(self.times), np.inf), np.full(len(self.times), -1)
        rays = np.arange(len(t))
        for hits in self._hits(span, lambda: np.minimum(t, span[1]), twice=False):
            keep_nearest(hits, t, number, rays)
        return RayHits.of(t, number)

    def all(self, span: Span) -> RayHits:
        """Return all hits, in any order."""
        return RayHits.joined([*self._hits(span, lambda: np.full(len(self.times), span[1]), twice=True)])

    def _hits(self, span: Span, limit: Callable[[], np.ndarray], twice: bool) -> Iterator[RayHits]:
        if self.form is not None:
            placed = in_camera(replace(self.shapes, meshes=(self.form.hull,)), WORLD)
        else:
            placed = in_camera(self.shapes, WORLD)
        scratch, ((kind, _),) = Scratch(), by_kind(self.shapes.kind)
        with np.errstate(all="ignore"):  # NaN and inf mean no hit
            for ray, triangle in self._candidates(placed, span[0], limit):
                of_pairs = SearchedRays(self.origin, self.direction).only(ray)
                bodies = self._bodies(kind, placed, ray, triangle)
                for hits in met(bodies, np.arange(len(ray)), ray, of_pairs, *span, scratch, twice):
                    yield RayHits(hits.ray, hits.t, triangle[hits.body])

    def _bodies(self, kind: Kind, placed: InCamera, ray: np.ndarray, triangle: np.ndarray) -> Bodies:
        if self.form is None:
            return kind.bodies(placed, ray, triangle)
        now = replace(self.shapes, meshes=(self.form.at(triangle, self.times[ray]),))
        return kind.bodies(replace(placed, shapes=now), ray, np.arange(len(triangle), dtype=np.int32))

    def _candidates(
        self, placed: InCamera, near: float, limit: Callable[[], np.ndarray]
    ) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Yield rays and the triangles that they may meet, (m,) each; 0 for shapes other than meshes."""
        rays = np.arange(len(self.times))
        if placed.shapes.kind[0] != MESH:
            yield rays, np.zeros(len(rays), np.int32)
            return
        mesh = self.shapes.meshes[0]
        reach = _reach(mesh) if self.form is None else self.form.reach
        to_mesh, away = placed.shape_from_world, self.origin.T - placed.center
        rounding = 2 * (placed.rounding + gamma(4)) * np.linalg.norm(to_mesh, axis=2).max(axis=1)
        rounding *= np.linalg.norm(away, axis=1) + placed.radius
        if not (rounding < BOX_MARGIN / 2 * reach).all():  # flat, or far away
            for chunk in np.array_split(rays, -(-len(rays) * len(mesh) // PAIRS_AT_ONCE)):
                yield np.repeat(chunk, len(mesh)), np.tile(np.arange(len(mesh), dtype=np.int32), len(chunk))
            return
        start, ahead = (np.einsum("nij,nj->in", to_mesh, vector) for vector in (away, self.direction.T))
        for tree, chunk in [(_tree_of(mesh), rays)] if self.form is None else self.form.slices(self.times):
            yield from _in_boxes(tree, chunk, start, ahead, near, limit)


def _in_boxes(
    tree: Tree, rays: np.ndarray, start, ahead, near: float, limit: Callable[[], np.ndarray]
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    order = rays[coherent_order(start[:, rays], ahead[:, rays], tree.reach)]
    for ray, triangle in Traversal(tree, start[:, order], ahead[:, order], near, lambda: limit()[order]).pairs():
        yield order[ray], triangle.astype(np.int32)


def _reach(mesh: Mesh) -> float:
    return float(np.abs(mesh.vertices - mesh.middle[:, None]).max())


@memoized
def _tree_of(mesh: Mesh) -> Tree:
    """Return the tree of a mesh's triangles in its own frame, by boxes that are enlarged."""
    ends = [(mesh.vertices - mesh.middle[:, None])[:, corner] for corner in mesh.triangles]
    slack = BOX_MARGIN * _reach(mesh)
    low, high = np.minimum.reduce(ends) - slack, np.maximum.reduce(ends) + slack
    return tree_of(low, high, np.arange(len(mesh)))
