"""Meshes as a camera sees them: vertices in its frame, and in which pixels each triangle may be seen."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..maths.vector import inverse
from ..records import Mesh
from .frames import MARGIN, InCamera
from .kind import PixelBounds, Visible
from .triangles import side

CHUNK = 1 << 16
"""Vertices or triangles that are worked on at once: their working arrays stay in a core's cache."""


@dataclass(frozen=True, eq=False)
class Triangles:
    """The triangles of the meshes in view that some pixel may see, in the order of their shapes."""

    vertices: np.ndarray
    """(3, v) camera frame, of all meshes in view."""
    corners: np.ndarray
    """(3, k) intp into ``vertices``; turned so that volumes of rays from the eye are positive, where all leave it."""
    shape: np.ndarray
    """(k,) int32 indices into ``Shapes``."""
    number: np.ndarray
    """(k,) int32 indices into the triangles of its mesh."""
    bounds: np.ndarray
    """(k, 4) int32: x0, x1, y0, y1 in the pixels of the plan."""

    def at(self, some: np.ndarray) -> np.ndarray:
        """Return the corners of triangles, (3, 3, m): corner, component."""
        return self.vertices.take(self.corners[:, some], axis=1).transpose(1, 0, 2)


def triangles_in_view(shapes: InCamera, visible: Visible) -> Triangles:
    """Return the triangles that some pixel may see.

    Rounding: a vertex is right to gamma(8) of the length of the axes times its own from the mesh's middle, plus that of
    the shape's center. It is transformed by the same operations wherever it is used, so that triangles that share it
    share its rounded place.
    """
    vertices, kept, start = [np.zeros((3, 0))], [], 0
    for mesh, rows in _runs(shapes, visible.at):
        for some in _parts(rows, mesh.vertices.shape[1]):
            placed = _placed(shapes, mesh, some)
            vertices.append(placed.reshape(3, -1))
            for k, row in enumerate(some.tolist()):
                kept += _seen(placed[:, k], mesh, row, start, visible.pixels, visible.from_eye)
                start += mesh.vertices.shape[1]
    empty = np.zeros((3, 0), np.intp), *np.zeros((2, 0), np.int32), np.zeros((0, 4), np.int32)
    corners, shape, number, bounds = zip(empty, *kept, strict=True)
    return Triangles(
        np.concatenate(vertices, axis=1), np.concatenate(corners, axis=1),
        np.concatenate(shape), np.concatenate(number), np.concatenate(bounds),
    )  # fmt: skip


def _runs(shapes: InCamera, rows: np.ndarray) -> Iterator[tuple[Mesh, np.ndarray]]:
    """Yield meshes with the shapes that show them, one after the other."""
    mesh = shapes.shapes.mesh[rows]
    cuts = np.flatnonzero(np.diff(mesh)) + 1
    for first, last in pairwise((0, *cuts.tolist(), len(rows))):
        yield shapes.shapes.meshes[mesh[first]], rows[first:last]


def _parts(rows: np.ndarray, size: int) -> Iterator[np.ndarray]:
    step = max(1, CHUNK // max(size, 1))
    for first in range(0, len(rows), step):
        yield rows[first : first + step]


def _placed(shapes: InCamera, mesh: Mesh, rows: np.ndarray) -> np.ndarray:
    """Return the vertices of shapes in the camera's frame, (3, rows, v)."""
    camera_from_world = inverse(shapes.pose.basis)
    axes = np.einsum("ij,njk->nik", camera_from_world, shapes.shapes.axes[rows])[..., None]
    q = mesh.vertices - mesh.middle[:, None]
    result = np.empty((3, len(rows), q.shape[1]))
    for i in range(3):
        np.add(axes[:, i, 1] * q[1], axes[:, i, 2] * q[2], out=result[i])
        result[i] += axes[:, i, 0] * q[0]
        result[i] += shapes.center[rows, i, None]
    return result


def _seen(vertices: np.ndarray, mesh: Mesh, row: int, start: int, pixels: PixelBounds, from_eye: bool) -> list:
    """Return the fields of ``Triangles``, but the vertices, of one shape, in parts; its vertices begin at ``start``."""
    images = pixels.images(vertices.T) if pixels.has_straight_lines else None
    kept = []
    for first in range(0, len(mesh), CHUNK):
        corners = mesh.triangles[:, first : first + CHUNK]
        bounds, seen = _bounds(vertices, images, corners, pixels)
        number = np.flatnonzero(seen)
        bounds, corners = bounds[number].astype(np.int32), corners[:, number]
        if from_eye:
            turn = side(vertices.take(corners, axis=1).transpose(1, 0, 2))
            corners = np.where(turn > 0, corners, corners[[0, 2, 1]])
            if not turn.all():
                number, bounds, corners = number[turn != 0], bounds[turn != 0], corners[:, turn != 0]
        shape = np.full(len(number), row, np.int32)
        kept.append((corners + start, shape, (number + first).astype(np.int32), bounds))
    return kept


def _bounds(vertices: np.ndarray, images: np.ndarray | None, corners: np.ndarray, pixels: PixelBounds):
    """Return in which pixels triangles may be seen, (k, 4), and which are in any: between the images of their corners
    where lines stay straight, otherwise where their balls are.
    """
    if images is None:
        return _ball_bounds(vertices, corners, pixels)
    low, high = images[corners[0]], images[corners[0]]
    for corner in corners[1:]:
        low, high = np.minimum(low, images[corner]), np.maximum(high, images[corner])
    bounds, seen = pixels.of_corners(low, high)
    behind = np.flatnonzero(np.isnan(low).any(axis=1))
    if behind.size:
        bounds[behind], seen[behind] = _ball_bounds(vertices, corners[:, behind], pixels)
    return bounds, seen


def _ball_bounds(vertices: np.ndarray, corners: np.ndarray, pixels: PixelBounds):
    a, b, c = vertices.take(corners, axis=1).transpose(1, 0, 2)
    low, high = np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
    middle = low / 2 + high / 2
    radius = np.sqrt(np.maximum.reduce([((corner - middle) ** 2).sum(axis=0) for corner in (a, b, c)]))
    return pixels.of_balls(middle.T, radius * MARGIN)
