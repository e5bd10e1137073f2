"""Meshes as a camera sees them: vertices in its frame, and the pixels in which each triangle may be seen."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields
from functools import partial
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from .. import tuning
from ..maths.speed import Shared, lazy
from ..maths.vector import inverse
from ..memory import require
from ..records import Mesh
from .frames import MARGIN, InCamera
from .kind import Visible
from .triangles import side

VERTEX_BYTES, TRIANGLE_BYTES = 40, 80
"""Upper bounds of the memory of each vertex and each triangle in view."""

FEWER = "show fewer instances, or reduce the subdivision"


@dataclass(frozen=True, eq=False)
class Triangles:
    """The triangles of the meshes in view that some pixel may see, in the order of their shapes."""

    corners: np.ndarray
    """(3, k) indices into the vertices."""
    shape: np.ndarray
    """(k,) int32 indices into ``Shapes``."""
    number: np.ndarray
    """(k,) int32 indices into the triangles of the mesh."""
    bounds: np.ndarray
    """(k, 4) int16, or int32 in large pictures: x0, x1, y0, y1 in the pixels of the plan."""
    near: np.ndarray
    """(k,) float32: lower bounds of t; -inf where none is known."""


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
        self._shapes, self._pixels, self._from_eye = shapes, visible.pixels, visible.from_eye
        chunk = tuning.CHUNK if visible.pixels.has_straight_lines else tuning.BOUNDED
        groups = list(_groups(shapes, visible.at, chunk))
        total, count = (sum(len(group.rows) * n(group.mesh) for group in groups) for n in (_vertex_count, len))
        require(VERTEX_BYTES * total + TRIANGLE_BYTES * count, f"{count:,} triangles in view", FEWER)
        self._vertices = np.empty((3, total))
        self._index = np.int32 if total < 2**31 else np.int64
        self._pixel = np.int16 if visible.pixels.whole.max() < 2**15 else np.int32
        self._images = np.empty((total, 4), self._pixel) if visible.pixels.has_straight_lines else None
        self._placing = Shared([
            partial(self._place, group, part)
            for group in groups
            for part in _parts(_vertex_count(group.mesh), tuning.CHUNK)
        ])  # fmt: skip
        self._imaging = Shared([
            partial(self._image, self._images, part)
            for part in _parts(total, tuning.CHUNK)
            if self._images is not None
        ])  # fmt: skip
        self._seeing = Shared([
            partial(self._see, group, part)
            for group in groups
            for part in _parts(len(group.mesh), chunk)
        ])  # fmt: skip
        self._joining = Shared([self._join])

    def prepare(self) -> Iterator[None]:
        """Do all work that is left, in small steps."""
        for step in (self._placing, self._imaging, self._seeing):
            yield from step.work()
            step.results()

    @lazy
    def triangles(self) -> Triangles:
        """The triangles that some pixel may see."""
        for _ in self.prepare():
            pass
        return self._joining.results()[0]

    def corners(self, some: np.ndarray) -> np.ndarray:
        """Return the corners of triangles, (3, 3, m): corner, component."""
        return self._at(self.triangles.corners.take(some, axis=1))

    def facing(self, some: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the indices of those among some triangles that a ray may hit, and their corners as ``corners`` does.
        If all rays leave the eye, the corners are ordered so that all volumes of a hit are positive.
        """
        corners = self.corners(some)
        turn = side(corners) if self._from_eye else np.ones(len(some))
        meets = np.flatnonzero(turn)
        if len(meets) < len(some):
            corners, turn = corners[:, :, meets], turn[meets]
        corners[1:] = np.where(turn > 0, corners[1:], corners[:0:-1])
        return meets, corners

    def _at(self, corners: np.ndarray) -> np.ndarray:
        return self._vertices.take(corners, axis=1).swapaxes(0, 1)

    def _join(self) -> Triangles:
        parts = self._seeing.results()
        whole = {name: [getattr(part, name) for part in parts] for name in (field.name for field in fields(Triangles))}
        parts.clear()
        bounds = np.concatenate(whole.pop("bounds"))
        return Triangles(bounds=bounds, **{name: np.concatenate(own, axis=-1) for name, own in whole.items()})

    def _place(self, group: Instances, some: slice) -> None:
        """Transform some vertices of a mesh for all instances of the group."""
        rows, count = group.rows, group.mesh.vertices.shape[1]
        axes = np.einsum("ij,njk->nik", inverse(self._shapes.pose.basis), self._shapes.shapes.axes[rows])[..., None]
        q = group.mesh.vertices[:, some] - group.mesh.middle[:, None]
        own = slice(group.start, group.start + len(rows) * count)
        for i in range(3):
            place = self._vertices[i, own].reshape(len(rows), count)[:, some]
            np.add(axes[:, i, 1] * q[1], axes[:, i, 2] * q[2], out=place)
            place += axes[:, i, 0] * q[0]
            place += self._shapes.center[rows, i, None]

    def _image(self, images: np.ndarray, some: slice) -> None:
        """Write the pixel bounds of some vertices as x0, -x1, y0, -y1, so that a triangle's bounds are the minima over
        its corners. A vertex without an image gets all pixels, and marks x0 with the least number of the type.
        """
        bounds, counts = self._pixels.of_points(self._vertices[:, some].T)
        bounds[~counts] = self._pixels.whole
        images[some] = bounds
        _turn_ends(images[some])
        images[some][~counts, 0] = np.iinfo(self._pixel).min

    def _see(self, group: Instances, some: slice) -> Triangles:
        """Return those among some triangles of a mesh, in all instances of the group, that some pixel may see."""
        own = group.mesh.triangles[:, None, some]
        starts = group.start + _vertex_count(group.mesh) * np.arange(len(group.rows))
        corners = (own + starts[:, None]).reshape(3, -1)
        if self._images is None:
            bounds, near, seen = self._in_balls(corners)
        else:
            bounds, near, seen = self._between(self._images, corners)
        instance, number = np.divmod(seen, own.shape[2])
        return Triangles(
            corners=corners.take(seen, axis=1).astype(self._index),
            shape=group.rows[instance].astype(np.int32),
            number=(number + some.start).astype(np.int32),
            bounds=bounds.astype(self._pixel, copy=False),
            near=np.nextafter(near.astype(np.float32), np.float32(-np.inf)),
        )

    def _between(self, images: np.ndarray, corners: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the pixel bounds of triangles, (k, 4), lower bounds of their t, (k,), and the indices (k,) of these
        triangles, which some pixel may see; from the images of their corners.
        """
        a, b, c = (images.take(corner, axis=0) for corner in corners)
        least = np.minimum(np.minimum(a, b, out=a), c, out=a)
        seen = np.flatnonzero((least[:, 0] < -least[:, 1]) & (least[:, 2] < -least[:, 3]))
        bounds, corners = least.take(seen, axis=0), corners.take(seen, axis=1)
        _turn_ends(bounds)
        near = -np.maximum.reduce([self._vertices[2].take(corner) for corner in corners])
        unknown = bounds[:, 0] == np.iinfo(self._pixel).min
        if not unknown.any():
            return bounds, near, seen
        known, unknown = np.flatnonzero(~unknown), np.flatnonzero(unknown)
        own_bounds, own_near, own = self._in_balls(corners[:, unknown])
        place = np.concatenate((known, unknown[own]))
        order = np.argsort(place)
        bounds, near = np.concatenate((bounds[known], own_bounds)), np.concatenate((near[known], own_near))
        return bounds[order], near[order], seen[place[order]]

    def _in_balls(self, corners: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the same as ``_between``, from the balls around triangles."""
        a, b, c = self._at(corners)
        low, high = np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
        middle = low / 2 + high / 2
        radius = MARGIN * np.sqrt(np.maximum.reduce([((corner - middle) ** 2).sum(axis=0) for corner in (a, b, c)]))
        bounds, seen = self._pixels.of_balls(middle.T, radius)
        at = np.flatnonzero(seen)
        return bounds[at], self._pixels.least_t(middle.T, radius)[at], at


def _turn_ends(bounds: np.ndarray) -> None:
    """Turn x0, x1, y0, y1 into x0, -x1, y0, -y1 or back, in place."""
    for column in bounds.T[1::2]:
        np.negative(column, out=column)


def _vertex_count(mesh: Mesh) -> int:
    return mesh.vertices.shape[1]


def _parts(count: int, most: int) -> Iterator[slice]:
    """Yield slices that divide ``count`` items into parts of at most ``most``."""
    for first in range(0, count, most):
        yield slice(first, min(first + most, count))


def _groups(shapes: InCamera, rows: np.ndarray, chunk: int) -> Iterator[Instances]:
    """Yield the instances of each mesh, in groups that fill a chunk with vertices or triangles."""
    mesh, start = shapes.shapes.mesh[rows], 0
    cuts = np.flatnonzero(np.diff(mesh)) + 1
    for first, last in pairwise((0, *cuts.tolist(), len(rows))):
        own = shapes.shapes.meshes[mesh[first]]
        for part in _parts(last - first, max(1, chunk // max(_vertex_count(own), len(own), 1))):
            group = Instances(own, rows[first:last][part], start)
            start += len(group.rows) * _vertex_count(own)
            yield group
