"""Points of meshes that move with their triangles, for meshes that change their form or are flat."""

from typing import Any

import numpy as np

from ...conventions import gamma
from ...maths.vector import difference, matrix_rows, matvec, norm
from ...records import Shapes
from ..surface_points import Follow, Moved
from .mesh_surface import LOST, HitTriangles, places_from_middle


def follow_meshes(with_frames: Follow, all_triangles: HitTriangles, point: Any) -> Follow:
    """Return a function that moves points, components relative to the eye: with the frames of their shapes if that is
    enough, else with their triangles.
    """

    def moved(then: Shapes, rows: np.ndarray, indices: np.ndarray) -> Moved:
        result, triangles = with_frames(then, rows, indices), all_triangles.only(indices)
        others = np.flatnonzero(triangles.each(_are_flat(triangles) | _are_others(triangles, then, rows)))
        if others.size:
            by_triangles = _with_triangles(triangles.only(others), then, rows, tuple(c[indices[others]] for c in point))
            for values, new in zip(result, by_triangles, strict=True):
                values[..., others] = new
        return result

    return moved


def _are_flat(triangles: HitTriangles) -> np.ndarray:
    """Return for which triangles the axes of the shape lie in one plane and so have no usable inverse, (k,) bool."""
    product = triangles.shapes.shape_from_world[triangles.at] @ triangles.shapes.shapes.axes[triangles.at]
    return ~(np.abs(product - np.eye(3)).max(axis=(1, 2)) < LOST)


def _are_others(triangles: HitTriangles, then: Shapes, rows: np.ndarray) -> np.ndarray:
    """Return which triangles, (k,) bool, belong to another mesh in ``then``, where their shapes have the rows (n,)."""
    pairs, pair = _pairs(triangles, then, rows)
    differ = [triangles.shapes.shapes.meshes[here] is not then.meshes[there] for here, there in pairs.T]
    return np.array(differ, bool)[pair]


def _with_triangles(triangles: HitTriangles, then: Shapes, rows: np.ndarray, point: Any) -> Moved:
    """Return how points, components relative to the eye, move with their triangles: affinely, as the corners do. Where
    the face is divided otherwise in ``then``, they move with the triangles that it has here.
    """
    corners = np.empty_like(triangles.local)
    pairs, pair_of = _pairs(triangles, then, rows)
    for pair, (here, counterpart) in enumerate(pairs.T.tolist()):
        of_pair = pair_of == pair
        corner = triangles.shapes.shapes.meshes[here].triangles.take(triangles.number[of_pair], axis=1)
        corners[..., of_pair] = places_from_middle(then.meshes[counterpart], corner)
    there = rows[triangles.at]
    axes, shift = matrix_rows(then.axes[there]), (then.center[there] - triangles.shapes.shapes.center[triangles.at]).T
    steps = np.array([
        shift + difference(matvec(axes, new), matvec(triangles.axes, old))
        for new, old in zip(corners, triangles.local, strict=True)
    ])  # fmt: skip
    gradients = [norm(gradient) for gradient in triangles.gradients]
    spread = sum(norm(step - steps[0]) * gradient for step, gradient in zip(steps[1:], gradients, strict=True))
    reach = np.maximum.reduce([norm(corner) for corner in (*triangles.corners, *steps)])
    thin = np.maximum(*map(norm, triangles.edges)) * sum(gradients)
    error = gamma(64) * reach * (1 + spread) * (1 + thin)
    by = triangles.interpolated(steps, point)
    return Moved(by, triangles.each(spread), triangles.each(error))


def _pairs(triangles: HitTriangles, then: Shapes, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the pairs (2, p) of a mesh here and its counterpart in ``then``, and the pair of each triangle, (k,)."""
    of_shape = np.zeros(len(rows), int)
    of_shape[triangles.at] = 1
    seen = np.flatnonzero(of_shape)  # triangles are many, shapes are few
    meshes = triangles.shapes.shapes.mesh[seen], then.mesh[rows[seen]]
    pairs, pair = np.unique(meshes, axis=1, return_inverse=True)
    of_shape[seen] = pair.reshape(-1)
    return pairs, of_shape[triangles.at]
