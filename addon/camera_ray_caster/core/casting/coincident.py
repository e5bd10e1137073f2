"""Surfaces in the same place: pixels in which it is arbitrary which surface is the nearest."""

import numpy as np

from ..conventions import EPS32
from ..records import MESH, Shapes
from ..shapes.search_rays import Crossings
from .hits import Hits

SAME_DEPTH = 8 * EPS32
"""Difference of t, over t, up to which two surfaces are in the same place: vertices and matrices are float32, and each
of them may be off by a rounding or two.
"""


def coincident(hits: Hits, met: list[Crossings]) -> tuple[np.ndarray, np.ndarray]:
    """Return the pixels of a tile, (m,), in which another surface is where the nearest one is, and the other shapes,
    (m,). ``met`` are the crossings that the search for the hits has met.

    Triangles of one mesh that share an edge or a vertex do not count: a ray through it meets both.
    """
    if not met:
        return np.zeros(0, np.intp), np.zeros(0, np.intp)
    pixel, t, at, triangle = (np.concatenate(parts) for parts in zip(*met, strict=True))
    nearest, index = hits.t.reshape(-1)[pixel], hits.index.reshape(-1)[pixel]
    same = (index >= 0) & (np.abs(t - nearest) <= SAME_DEPTH * np.abs(nearest))
    pixel, at, triangle, index = pixel[same], at[same], triangle[same], index[same]
    others = index != at
    seen = hits.known.get(MESH)
    on_mesh = np.flatnonzero(~others & (triangle >= 0))
    if on_mesh.size and seen is not None:
        number = seen.number[seen.of_pixel.reshape(-1)[pixel[on_mesh]]]
        touching = _touch(hits.target.shapes, at[on_mesh], number, triangle[on_mesh])
        others[on_mesh] = (number != triangle[on_mesh]) & ~touching
    return pixel[others], at[others]


def _touch(shapes: Shapes, at: np.ndarray, first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Return which pairs of triangles of some shapes share one or two vertices, (m,)."""
    touching = np.zeros(len(at), bool)
    for row in np.unique(at).tolist():
        pairs = np.flatnonzero(at == row)
        corners = shapes.meshes[shapes.mesh[row]].triangles
        first_corners, second_corners = corners[:, first[pairs]], corners[:, second[pairs]]
        shared = (first_corners[:, None] == second_corners[None]).any(axis=1).sum(axis=0)
        touching[pairs] = (shared > 0) & (shared < 3)
    return touching
