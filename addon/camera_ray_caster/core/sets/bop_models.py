"""The models of BOP's objects: triangles in millimeters in the frame of each object, as PLY.

Spheres, which are cast exactly, have vertices on the surface, and triangles inside of it by up to 0.12 % of the radius.
Reference: BOP toolkit documentation, BOP dataset format.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..records import MESH, PLANE, InputError, Shapes

RINGS = 64
DIRECTIONS = 3000
"""Directions of a half sphere in which the farthest vertices are looked for: the nearest one to any is within 2.3
degrees, so that a diameter is up to 0.1 % below the largest distance of two vertices.
"""


def model_of(shapes: Shapes, one: dict[str, Any]) -> tuple[np.ndarray, np.ndarray]:
    """Return the vertices (n, 3) float64 and triangles (k, 3) of an object, an entry of ``object_poses``: in the frame
    of its box, in Blender units. Raises InputError if the shapes do not have it, or of another size.
    """
    rows = [row for row in range(len(shapes)) if shapes.names[shapes.name_index[row]] == one["object"]]
    if len(rows) <= one["instance"]:
        raise InputError(f"the file of --models has no shape of {one['object']!r}: give the file that the set is of")
    row = rows[one["instance"]]
    if shapes.kind[row] == MESH:
        mesh = shapes.meshes[shapes.mesh[row]]
        vertices, triangles = mesh.vertices.T.astype(np.float64), mesh.triangles.T
        vertices = vertices - (vertices.min(0) + vertices.max(0)) / 2
    else:
        vertices, triangles = _square() if shapes.kind[row] == PLANE else _sphere()
    vertices = vertices * np.linalg.norm(shapes.axes[row], axis=0)
    if not np.allclose(np.ptp(vertices, axis=0), one["size"], rtol=0.05, atol=1e-6):
        raise InputError(
            f"{one['object']!r} is of another size in the file of --models: give the file that the set is of"
        )
    return vertices, triangles


def ply(vertices: np.ndarray, triangles: np.ndarray) -> bytes:
    """Return the binary PLY of a mesh."""
    head = "ply\nformat binary_little_endian 1.0\n" + f"element vertex {len(vertices)}\n"
    head += "".join(f"property float {axis}\n" for axis in "xyz")
    head += f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    faces = np.empty(len(triangles), np.dtype([("count", "u1"), ("vertices", "<i4", 3)]))
    faces["count"], faces["vertices"] = 3, triangles
    return head.encode() + vertices.astype("<f4").tobytes() + faces.tobytes()


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
    return vertices, np.vstack([np.stack([one.ravel() for one in part], axis=1) for part in parts])
