"""Meshes that deform between a few evaluations: each vertex moves on the polynomial through its evaluated positions."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..mesh import Mesh
from ..records import Shapes
from .means import mean

FIXED = "triangles", "polygon", "loops", "slot"
"""Fields of ``Mesh`` that must be equal if the vertices of two meshes correspond."""

MOST_VERTICES = 4096
"""Maximum number of vertices of a mesh whose motion is checked; of more vertices, evenly spaced ones are taken."""


def alike(before: Sequence[Mesh], after: Sequence[Mesh]) -> bool:
    """Whether two lists of meshes have the same triangles, mesh by mesh, so that only their vertices may differ."""
    return len(before) == len(after) and all(
        first is second
        or (first.vertices.shape == second.vertices.shape and all(_same(first, second, name) for name in FIXED))
        for first, second in zip(before, after, strict=True)
    )


def same_faces(before: Mesh, after: Mesh) -> bool:
    """Whether two meshes have the same faces of the same vertices. Blender may divide a face otherwise as it bends."""
    return alike([before], [after]) or (
        before.vertices.shape == after.vertices.shape
        and _same(before, after, "polygon")
        and np.array_equal(_corners(before), _corners(after))
    )


def _corners(mesh: Mesh) -> np.ndarray:
    """Return the pairs of a face and one of its vertices as numbers, each once, in ascending order."""
    return np.unique(mesh.polygon * np.int64(1 << 32) + mesh.triangles)


def deformed(shapes: Shapes, evaluations: Sequence[Shapes], weights: Sequence[float]) -> Shapes:
    """Return shapes with their meshes interpolated between evaluations; the weights have the sum 1."""
    meshes = list(shapes.meshes)
    for k, forms in enumerate(zip(*(evaluation.meshes for evaluation in evaluations), strict=True)):
        if all(_same(forms[0], other, name) for other in forms[1:] for name in ("vertices", "normals", "uv")):
            continue
        middle = mean([form.middle for form in forms], weights)  # which the center of the shape is the image of
        places = mean([form.vertices - form.middle[:, None] for form in forms], weights) + middle[:, None]
        normals, uv = (_mean_of([getattr(form, name) for form in forms], weights) for name in ("normals", "uv"))
        normals = None if normals is None else unit(normals)
        meshes[k] = replace(meshes[k], vertices=places, normals=normals, uv=uv, own_middle=middle)
    return replace(shapes, meshes=tuple(meshes))


def unit(normals: np.ndarray) -> np.ndarray:
    """Return vectors (..., 3) with length 1; 0 stays 0."""
    lengths = np.sqrt((normals * normals).sum(axis=-1, keepdims=True))
    return normals / np.maximum(lengths, np.finfo(float).tiny)


def vertices(shapes: Shapes, rows: np.ndarray) -> np.ndarray:
    """Return vertices of the meshes of some rows in the world, (n, 3), at most MOST_VERTICES of each mesh."""
    places = [np.zeros((3, 0))]
    for row in rows.tolist():
        mesh = shapes.meshes[shapes.mesh[row]]
        sampled = mesh.vertices[:, :: -(-mesh.vertices.shape[1] // MOST_VERTICES)] - mesh.middle[:, None]
        places.append(shapes.axes[row] @ sampled + shapes.center[row][:, None])
    return np.concatenate(places, axis=1).T


def changed(before: Shapes, after: Shapes) -> np.ndarray:
    """Return the rows of the shapes whose meshes differ between two evaluations with ``alike`` meshes."""
    pairs = enumerate(zip(before.meshes, after.meshes, strict=True))
    return np.flatnonzero(np.isin(before.mesh, [k for k, (first, second) in pairs if first is not second]))


def _same(mesh: Mesh, other: Mesh, name: str) -> bool:
    first, second = getattr(mesh, name), getattr(other, name)
    return first is second or (first is not None and second is not None and np.array_equal(first, second))


def _mean_of(values: Sequence[np.ndarray | None], weights: Sequence[float]) -> np.ndarray | None:
    """Return the weighted mean of arrays, None if one is missing or has another shape."""
    known = [value for value in values if value is not None]
    if len(known) < len(values) or len({value.shape for value in known}) > 1:
        return None
    return mean(known, weights)
