"""Key points of a scene: its empties, and the vertex groups of its meshes."""

from collections.abc import Sequence

import bpy
import numpy as np

from ...core.annotations.keypoints import KeyPoint
from ...core.records import InputError
from .camera_fields import ALL
from .mesh_reading import vertices
from .unique import by_name, named, unique_name


def check_key_points(scene, names: Sequence[str]) -> None:
    """Raise InputError for a name that is not ALL, an empty or a mesh with vertex groups, and for ALL with others."""
    if ALL in names and len(names) > 1:
        raise InputError(f"--keypoints {ALL} already includes all names: leave out the other names")
    items = [item for item in scene.objects if _has_points(item)]
    for name in names:
        if name != ALL and named(name, items) is None:
            raise InputError(
                f"the scene has no key point {name!r}: give the names of empties or of meshes with vertex groups, or "
                f"{ALL}"
            )


def key_points(scene, depsgraph, names: Sequence[str]) -> list[KeyPoint]:
    """Return the key points of objects at the depsgraph's frame, in the order of names; ALL gives all, sorted by name.

    An empty is a key point at its origin, and belongs to its nearest ancestor that is a mesh, if any. A vertex group is
    a key point at the weighted mean of its vertices after the modifiers, and belongs to its object. A group without
    weights, and one that only a modifier makes, have none.
    """
    known = [item for item in scene.objects if _has_points(item)]
    items = by_name(known).values() if ALL in names else [named(name, known) for name in names]
    return [point for item in items for point in _points_of(item, item.evaluated_get(depsgraph))]


def _has_points(item) -> bool:
    return item.type == "EMPTY" or (item.type == "MESH" and bool(item.vertex_groups))


def _points_of(item, evaluated) -> list[KeyPoint]:
    matrix = np.array(evaluated.matrix_world, float)
    if item.type == "EMPTY":
        owner = item.parent
        while owner is not None and owner.type != "MESH":
            owner = owner.parent
        return [KeyPoint(_name(item), _name(owner), tuple(matrix[:3, 3].tolist()))]
    mesh = evaluated.data
    places = vertices(mesh) @ matrix[:3, :3].T + matrix[:3, 3]
    index = {group.name: group.index for group in evaluated.vertex_groups}  # modifiers may add groups, also before
    total, weight = np.zeros((len(index), 3)), np.zeros(len(index))
    for position, vertex in zip(places, mesh.vertices, strict=True):
        for entry in vertex.groups:
            total[entry.group] += entry.weight * position
            weight[entry.group] += entry.weight
    named = [(group.name, index[group.name]) for group in item.vertex_groups if group.name in index]
    owner = _name(item)
    return [KeyPoint(name, owner, tuple((total[k] / weight[k]).tolist())) for name, k in named if weight[k] > 0]


def _name(item) -> str:
    """Return the name that ``Shapes`` have of an object; "" for None."""
    return "" if item is None else unique_name(item, bpy.data.objects)
