"""What evaluated data stands for: exact shapes, triangles, or nothing that can be cast."""

from dataclasses import replace
from hashlib import blake2b

import bpy
import numpy as np

from ...core.records import INFINITE_PLANE, PLANE, SPHERE
from ...core.shapes.instances import Primitive, enclosing_primitive, mesh_primitive, points_primitive
from ...core.shapes.recognize import NOT_FINITE, MeshArrays, defect, exclude, recognize
from .kept import Found
from .meshes import fetched, is_smooth, mesh_arrays, mesh_record, vertices

FORCED = {"SPHERE": SPHERE, "PLANE": PLANE, "INFINITE_PLANE": INFINITE_PLANE}
"""What an object's own setting makes of it, whatever its geometry is."""

COARSE = 0.02
"""How far from a sphere, over its radius, the flat faces of a mesh may be that is still cast as one. A coarser one is a
solid of its own: Blender's ico sphere of 80 faces is 0.066 off, that of 320 is 0.017.
"""

DEFAULT_RADIUS = 0.01
"""Of the points of a cloud without a radius, as Cycles renders them."""

REMEMBERED = 1024
"""Meshes whose shapes are kept in mind: a scene is evaluated again and again, and few of its meshes change."""

NOTHING = None, ""
"""The answer for data that a render shows nothing of."""


def shapes_of(item, setting: str) -> Found:
    """Return what the data of an evaluated object stands for, in object space.

    ``setting`` is AUTOMATIC, MESH or a key of FORCED.
    """
    data = item.data
    if isinstance(data, bpy.types.PointCloud):
        return _of_points(data, FORCED.get(setting))
    if not isinstance(data, bpy.types.Mesh):
        return None, f"it is of type {data.bl_rna.name.lower()}: only surfaces and point clouds are cast"
    try:  # a mesh that is being edited has its faces only there
        return mesh_shapes(item.to_mesh(), setting)
    finally:
        item.to_mesh_clear()


def mesh_shapes(mesh, setting: str) -> Found:
    """Return what an evaluated mesh stands for."""
    if not len(mesh.vertices):
        return NOTHING
    kind = FORCED.get(setting)
    if not len(mesh.polygons):
        return NOTHING if kind is None else _enclosing(kind, vertices(mesh))
    arrays = mesh_arrays(mesh)
    wrong = defect(arrays)
    found = wrong if wrong or setting == "MESH" else _recognized(arrays)
    if kind is not None:
        if isinstance(found, Primitive) and (found.kind == SPHERE) == (kind == SPHERE):
            return replace(found, kind=kind), ""
        return _enclosing(kind, arrays.vertices)
    if isinstance(found, Primitive) and not _is_solid(found, mesh):
        return found, ""
    if wrong:
        return None, wrong
    return mesh_primitive(mesh_record(mesh, arrays)), ""


def _enclosing(kind, places: np.ndarray) -> Found:
    """Return the sphere or plane around (n, 3) places."""
    return (enclosing_primitive(kind, places), "") if np.isfinite(places).all() else (None, NOT_FINITE)


def _is_solid(found: Primitive, mesh) -> bool:
    """Return whether what might be a sphere is a solid with faces that are meant as they are."""
    return found.kind == SPHERE and found.apart > COARSE and not is_smooth(mesh)


_known: dict[bytes, Primitive | str] = {}


def _recognized(mesh: MeshArrays) -> Primitive | str:
    """Return what ``recognize`` does, which is asked once for the same arrays."""
    if reason := exclude(mesh):
        return reason
    content = blake2b(f"{len(mesh.vertices)} {len(mesh.loop_vertices)} {mesh.edge_count}".encode())
    for array in (mesh.vertices, mesh.loop_vertices, mesh.loop_edges, mesh.loop_starts):
        content.update(array)
    key = content.digest()
    if key not in _known:
        if len(_known) >= REMEMBERED:
            _known.clear()
        _known[key] = recognize(mesh)
    return _known[key]


def _of_points(cloud, kind) -> Found:
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
