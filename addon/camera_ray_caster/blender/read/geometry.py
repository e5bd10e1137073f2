"""Meshes and point clouds in bulk: plain arrays, and the shapes that they stand for."""

from dataclasses import replace
from hashlib import blake2b

import bpy
import numpy as np

from ...core.records import INFINITE_PLANE, PLANE, SPHERE
from ...core.shapes.instances import Primitive, enclosing_primitive, points_primitive
from ...core.shapes.recognize import NOT_FINITE, MeshArrays, recognize

FORCED = {"SPHERE": SPHERE, "PLANE": PLANE, "INFINITE_PLANE": INFINITE_PLANE}
"""What an object's own setting makes of it, whatever its geometry is."""

DEFAULT_RADIUS = 0.01
"""Of the points of a cloud without a radius, as Cycles renders them."""

REMEMBERED = 1024
"""Meshes whose shapes are kept in mind: a scene is evaluated again and again, and few of its meshes change."""

NOTHING = None, ""
"""The answer for data that a render shows nothing of."""


def shapes_of(data, setting: str) -> tuple[Primitive | None, str]:
    """Return what evaluated data stands for, in object space, and in words what of it cannot be cast.

    ``setting`` is AUTOMATIC or a key of FORCED.
    """
    kind = FORCED.get(setting)
    if isinstance(data, bpy.types.Mesh):
        return _of_mesh(data, kind)
    if isinstance(data, bpy.types.PointCloud):
        return _of_points(data, kind)
    return None, f"it is of type {data.bl_rna.name.lower()}: only meshes and point clouds are cast"


def _of_mesh(mesh, kind) -> tuple[Primitive | None, str]:
    found = _recognized(mesh_arrays(mesh)) if len(mesh.polygons) else ""
    if kind is None:
        return (None, found) if isinstance(found, str) else (found, "")
    if isinstance(found, Primitive) and (found.kind == SPHERE) == (kind == SPHERE):
        return replace(found, kind=kind), ""
    vertices = fetched(mesh.vertices, "co", np.float32, 3).reshape(-1, 3)
    return _enclosing(kind, vertices)


def _enclosing(kind, places: np.ndarray) -> tuple[Primitive | None, str]:
    """Return the sphere or plane around (n, 3) places."""
    if not len(places):
        return NOTHING
    return (enclosing_primitive(kind, places), "") if np.isfinite(places).all() else (None, NOT_FINITE)


_known: dict[bytes, Primitive | str] = {}


def _recognized(mesh: MeshArrays) -> Primitive | str:
    """Return what ``recognize`` does, which is asked once for the same arrays."""
    content = blake2b(f"{len(mesh.vertices)} {len(mesh.loop_vertices)} {mesh.edge_count}".encode())
    for array in (mesh.vertices, mesh.loop_vertices, mesh.loop_edges, mesh.loop_starts):
        content.update(array)
    key = content.digest()
    if key not in _known:
        if len(_known) >= REMEMBERED:
            _known.clear()
        _known[key] = recognize(mesh)
    return _known[key]


def _of_points(cloud, kind) -> tuple[Primitive | None, str]:
    if not len(cloud.points):
        return NOTHING
    positions = fetched(cloud.attributes["position"].data, "vector", np.float32, 3).reshape(-1, 3)
    if kind in (PLANE, INFINITE_PLANE):
        return _enclosing(kind, positions)
    radius = cloud.attributes.get("radius")
    radii = fetched(radius.data, "value", np.float32) if radius else np.full(len(positions), DEFAULT_RADIUS, np.float32)
    primitive = points_primitive(positions, radii)
    missing = len(radii) - len(primitive)
    return primitive, f"{missing} of its points have no radius above zero or no finite position" if missing else ""


def mesh_arrays(mesh) -> MeshArrays:
    """Return the plain arrays of a mesh."""
    return MeshArrays(
        vertices=fetched(mesh.vertices, "co", np.float32, 3).reshape(-1, 3),
        loop_vertices=fetched(mesh.loops, "vertex_index", np.int32),
        loop_edges=fetched(mesh.loops, "edge_index", np.int32),
        loop_starts=fetched(mesh.polygons, "loop_start", np.int32),
        edge_count=len(mesh.edges),
    )


def fetched(collection, name: str, dtype, width: int = 1) -> np.ndarray:
    """Return a property of all members of a collection as one flat array; ``width`` values each."""
    values = np.empty(len(collection) * width, dtype)
    collection.foreach_get(name, values)
    return values
