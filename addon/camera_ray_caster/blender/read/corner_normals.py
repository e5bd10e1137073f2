"""Corner normals as Cycles has them before Blender 5.2: it splits a mesh at its sharp edges, and gives each vertex of
that mesh one normal, that of its last corner.

Blender's corner normals, which Cycles shows from 5.2 on, also end at edges with three or more faces, and at edges
whose two faces wind oppositely.
"""

import bpy
import numpy as np

from ...core.shapes.recognize import MeshArrays

SPLITS = bpy.app.version < (5, 2, 0)
"""Whether Cycles splits meshes at sharp edges, in place of reading the corner normals."""


def smooth_across(normals: np.ndarray, mesh: MeshArrays, sharp: np.ndarray) -> None:
    """Replace the corner normals, (l, 3) float32, at the vertices of edges that Cycles smooths across, though Blender
    does not. ``sharp``: (e,) bool, which edges end a normal in Cycles.
    """
    vertex, edge, starts = mesh.loop_vertices, mesh.loop_edges, np.empty((2, mesh.edge_count), np.int32)
    starts[0, edge], starts[1, edge[::-1]] = vertex, vertex[::-1]
    count = np.bincount(edge, minlength=mesh.edge_count)
    crossed = ~sharp & ((count > 2) | ((count == 2) & (starts[0] == starts[1])))
    if not crossed.any():
        return
    following, ends = np.arange(1, len(vertex) + 1), np.append(mesh.loop_starts[1:], len(vertex))
    following[ends - 1] = mesh.loop_starts
    before = np.empty_like(following)
    before[following] = np.arange(len(vertex))
    touched = np.zeros(len(mesh.vertices), bool)
    touched[vertex[crossed[edge]]] = touched[vertex[following[crossed[edge]]]] = True
    corners = np.flatnonzero(touched[vertex])
    edges = np.array([edge[corners], edge[before[corners]]])
    normals[corners] = normals[corners[_last_corners(vertex[corners], edges, ~sharp[edges])]]


def _last_corners(vertex: np.ndarray, edges: np.ndarray, joins: np.ndarray) -> np.ndarray:
    """Return the last one of the corners that edges connect each corner with, around its vertex, (m,).

    ``vertex``: (m,); ``edges``: (2, m), the edges of each corner's face at its vertex; ``joins``: which connect.
    """
    _, spoke = np.unique(vertex * (edges.max() + 1) + edges.astype(np.int64), return_inverse=True)
    spoke, last = spoke.reshape(edges.shape), np.arange(len(vertex))
    while True:
        known = np.zeros(int(spoke.max()) + 1, np.intp)
        for ends, joined in zip(spoke, joins, strict=True):
            np.maximum.at(known, ends[joined], last[joined])
        latest = np.maximum(last, np.where(joins, known[spoke], 0).max(axis=0))
        if np.array_equal(latest, last):
            return last
        last = latest
