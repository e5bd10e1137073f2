"""The models of a data set's objects: triangles in millimeters in the frame of each object, as PLY.

Meshes are those that were cast. Objects that are cast as exact spheres by their own setting have vertices on the
surface, and triangles inside of it by up to 0.12 % of the radius.
Normals of vertices are those of the faces about them, weighted by their angles. A vertex has the color of its material,
or the mean of those of its triangles; a model whose color changes over a surface has none, and no symmetries.
References: see ``object_scenes``; G. Thürmer and C. Wüthrich, Computing Vertex Normals from Polygonal Facets (1998).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..records import MESH, PLANE, SPHERE, InputError, Shapes
from .png import srgb
from .symmetries import of_ellipsoid, symmetries

RINGS = 64
DIRECTIONS = 3000
"""Directions of a half sphere in which the farthest vertices are looked for: the nearest one to any is within 2.3
degrees, so that a diameter is up to 0.1 % below the largest distance of two vertices.
"""

ON_SURFACE, ROUND = 1e-3, 0.95
"""Of a mesh that counts as a sphere: how far vertices may be from it, and how far faces must be from its center."""


@dataclass(frozen=True, eq=False)
class ObjectModel:
    """The triangles of an object in the frame of its box."""

    vertices: np.ndarray
    """(n, 3) float64"""
    triangles: np.ndarray
    """(k, 3), counterclockwise as seen from outside."""
    colors: np.ndarray | None
    """(n, 3) float64, linear; None if they change over a surface."""
    kind: int
    """That of the shape."""

    @cached_property
    def normals(self) -> np.ndarray:
        """(n, 3) float64: of unit length, or 0 for vertices without a face."""
        sides = [np.roll(self.triangles, -k, axis=1) for k in range(3)]
        a, b, c = self.vertices[self.triangles.T]
        face = np.cross(b - a, c - a)
        total = np.zeros_like(self.vertices)
        with np.errstate(invalid="ignore"):  # a triangle without an area has no normal
            face /= np.linalg.norm(face, axis=1)[:, None]
            for corner in sides:
                here, after, before = self.vertices[corner.T]
                across = np.linalg.norm(np.cross(after - here, before - here), axis=1)
                angle = np.arctan2(across, np.einsum("ij,ij->i", after - here, before - here))
                np.add.at(total, corner[:, 0], np.nan_to_num(face * angle[:, None]))
            return np.nan_to_num(total / np.linalg.norm(total, axis=1)[:, None])

    @property
    def _is_round(self) -> bool:
        """Whether this is a fine mesh of an ellipsoid: its vertices on the surface, its faces near to it."""
        half = np.ptp(self.vertices, axis=0) / 2
        if self.kind != MESH or not half.all():
            return False
        a, b, c = (self.vertices / half)[self.triangles.T]
        across = np.cross(b - a, c - a)
        with np.errstate(invalid="ignore"):  # of a triangle without an area
            depth = np.einsum("ij,ij->i", across, a) / np.linalg.norm(across, axis=1)
        off = np.abs(np.linalg.norm(self.vertices / half, axis=1) - 1)
        return bool(off.max() < ON_SURFACE and np.nanmin(depth) > ROUND)

    def symmetries(self, scale: float) -> dict[str, list[Any]]:
        """Return the entries of models_info.json for lengths times ``scale``; see ``symmetries``."""
        if self.colors is None:
            return {}
        if self.kind == SPHERE or self._is_round:
            return of_ellipsoid(np.ptp(self.vertices, axis=0))
        normals = np.zeros_like(self.normals) if self.kind == PLANE else self.normals  # a plane is seen from both sides
        return symmetries(scale * self.vertices, normals, self.colors)


def model_of(shapes: Shapes, entry: dict[str, Any]) -> ObjectModel:
    """Return the model of an object, an entry of ``object_poses``, in Blender units. Raises InputError if the shapes do
    not have it, or of another size.
    """
    rows = [row for row in range(len(shapes)) if shapes.names[shapes.name_index[row]] == entry["object"]]
    if len(rows) <= entry["instance"]:
        raise no_shape(entry["object"])
    row = rows[entry["instance"]]
    slot = None
    if shapes.kind[row] == MESH:
        mesh = shapes.meshes[shapes.mesh[row]]
        vertices, triangles, slot = mesh.vertices.T.astype(np.float64), mesh.triangles.T, mesh.slot
        vertices = vertices - (vertices.min(0) + vertices.max(0)) / 2
    else:
        vertices, triangles = _square() if shapes.kind[row] == PLANE else _sphere()
    vertices = vertices * np.linalg.norm(shapes.axes[row], axis=0)
    check_size(entry, np.ptp(vertices, axis=0))
    colors = _colors(shapes, row, slot, triangles, len(vertices))
    return ObjectModel(vertices, triangles, colors, int(shapes.kind[row]))


def no_shape(name: str) -> InputError:
    """Return the refusal of a file without an object of the set."""
    return InputError(
        f"the file of --models has no shape of {name!r}: give the file that the set is of, and show it in the viewport"
    )


def check_size(entry: dict[str, Any], size: Sequence[float] | np.ndarray) -> None:
    """Raise InputError if an object, an entry of ``object_poses``, is of another size; exact shapes may be a little."""
    if not np.allclose(size, entry["size"], rtol=0.05, atol=1e-6):
        raise InputError(
            f"{entry['object']!r} is of another size in the file of --models: give the file that the set is of"
        )


def _colors(shapes: Shapes, row: int, slot: np.ndarray | None, triangles: np.ndarray, count: int) -> np.ndarray | None:
    """Return the linear colors of the vertices of a shape, (count, 3); None if materials change over the surface."""
    slots = shapes.slots
    if slots is None or slots.first[row] < 0:
        changes = len(shapes.surface) and shapes.surface[row] >= 0
        return None if changes else np.tile(shapes.color[row, :3].astype(np.float64), (count, 1))
    used = slots.first[row] + (np.zeros(len(triangles), int) if slot is None else slot)
    if len(slots.surface) and (slots.surface[used] >= 0).any():
        return None
    total, number = np.zeros((count, 3)), np.zeros(count)
    np.add.at(total, triangles, slots.color[used, None, :3])
    np.add.at(number, triangles, 1.0)
    return total / np.maximum(number, 1.0)[:, None]


def ply(model: ObjectModel, scale: float) -> bytes:
    """Return the binary PLY of a model whose lengths are multiplied by ``scale``, with normals, and its colors as
    sRGB.
    """
    columns = dict(zip(("x", "y", "z", "nx", "ny", "nz"), (*(scale * model.vertices).T, *model.normals.T), strict=True))
    kinds = dict.fromkeys(columns, ("float", "<f4"))
    if model.colors is not None:
        columns |= zip(("red", "green", "blue"), srgb(model.colors).T, strict=True)
        kinds = {name: kinds.get(name, ("uchar", "u1")) for name in columns}
    head = "ply\nformat binary_little_endian 1.0\n" + f"element vertex {len(model.vertices)}\n"
    head += "".join(f"property {word} {name}\n" for name, (word, _) in kinds.items())
    head += f"element face {len(model.triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    points = np.empty(len(model.vertices), np.dtype([(name, kind) for name, (_, kind) in kinds.items()]))
    for name, values in columns.items():
        points[name] = values
    faces = np.empty(len(model.triangles), np.dtype([("count", "u1"), ("vertices", "<i4", 3)]))
    faces["count"], faces["vertices"] = 3, model.triangles
    return head.encode() + points.tobytes() + faces.tobytes()


def diameter(vertices: np.ndarray) -> float:
    """Return the largest distance of two vertices, to 0.1 %."""
    z = (np.arange(DIRECTIONS) + 0.5) / DIRECTIONS
    turn = np.pi * (1 + 5**0.5) * np.arange(DIRECTIONS)
    radius = np.sqrt(1 - z * z)
    far = 0.0
    for direction in np.stack((radius * np.cos(turn), radius * np.sin(turn), z), axis=1):
        along = vertices @ direction
        far = max(far, float(np.linalg.norm(vertices[along.argmax()] - vertices[along.argmin()])))
    return far


def _square() -> tuple[np.ndarray, np.ndarray]:
    return np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], np.float64), np.array([(0, 1, 2), (0, 2, 3)])


def _sphere() -> tuple[np.ndarray, np.ndarray]:
    """Return a unit sphere of RINGS parts from pole to pole, counterclockwise as seen from outside."""
    columns = 2 * RINGS
    polar, around = np.meshgrid(np.pi * np.arange(1, RINGS) / RINGS, np.pi * np.arange(columns) / RINGS, indexing="ij")
    ring = np.stack((np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar)), axis=-1)
    vertices = np.vstack((ring.reshape(-1, 3), (0, 0, 1), (0, 0, -1)))
    index = np.arange(len(vertices) - 2).reshape(RINGS - 1, columns)
    after = np.roll(index, -1, axis=1)
    top, bottom = np.full(columns, len(vertices) - 2), np.full(columns, len(vertices) - 1)
    parts = (
        (index[:-1], index[1:], after[1:]), (index[:-1], after[1:], after[:-1]),
        (top, index[0], after[0]), (index[-1], bottom, after[-1]),
    )  # fmt: skip
    return vertices, np.vstack([np.stack([corner.ravel() for corner in triangles], axis=1) for triangles in parts])
