"""Key points of a scene: its empties, and the vertex groups of its meshes."""

from collections.abc import Sequence

import numpy as np

from ...core.annotations.keypoints import KeyPoint
from ...core.records import InputError
from .camera import ALL
from .meshes import vertices


def check_key_points(scene, names: Sequence[str]) -> None:
    """Raise InputError for a name that is neither an empty's nor that of a mesh with vertex groups, nor ALL."""
    if ALL in names and len(names) > 1:
        raise InputError(f"--keypoints {ALL} stands alone: leave out the names")
    known = {ALL, *(item.name for item in scene.objects if _has_points(item))}
    for name in names:
        if name not in known:
            raise InputError(
                f"the scene has no key point {name!r}: name empties, or meshes with vertex groups, or give {ALL}"
            )


def key_points(scene, depsgraph, names: Sequence[str]) -> list[KeyPoint]:
    """Return the key points of objects at the depsgraph's frame, in their order; for ALL of all objects, by name.

    An empty is one, at its origin, and belongs to the mesh that it is parented to, if any. A vertex group is one, at
    the mean of its vertices by their weights, after the modifiers, and belongs to its object.
    """
    if ALL in names:
        names = sorted(item.name for item in scene.objects if _has_points(item))
    items = [scene.objects[name] for name in names]
    return [point for item in items for point in _points_of(item, item.evaluated_get(depsgraph))]


def _has_points(item) -> bool:
    return item.type == "EMPTY" or (item.type == "MESH" and bool(item.vertex_groups))


def _points_of(item, evaluated) -> list[KeyPoint]:
    matrix = np.array(evaluated.matrix_world, float)
    if item.type == "EMPTY":
        owner = item.parent
        while owner is not None and owner.type != "MESH":
            owner = owner.parent
        return [KeyPoint(item.name, owner.name if owner else "", tuple(matrix[:3, 3].tolist()))]
    mesh = evaluated.data
    places = vertices(mesh) @ matrix[:3, :3].T + matrix[:3, 3]
    total, weight = np.zeros((len(item.vertex_groups), 3)), np.zeros(len(item.vertex_groups))
    for place, vertex in zip(places, mesh.vertices, strict=True):
        for entry in vertex.groups:
            total[entry.group] += entry.weight * place
            weight[entry.group] += entry.weight
    return [
        KeyPoint(group.name, item.name, tuple((total[group.index] / weight[group.index]).tolist()))
        for group in item.vertex_groups
        if weight[group.index] > 0
    ]
