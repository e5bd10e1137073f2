"""Shapes of evaluated data: exact shapes, triangles, or nothing that can be cast."""

from collections.abc import Collection, Sequence
from dataclasses import replace
from hashlib import blake2b

import bpy
import numpy as np

from ...core.records import INFINITE_PLANE, PLANE, SPHERE
from ...core.shapes.instances import NO_MAP, Primitive, enclosing_primitive, mesh_primitive, points_primitive
from ...core.shapes.mesh.displaced import Displacement, displaced
from ...core.shapes.recognize import NOT_FINITE, MeshArrays, defect, exclude, recognize
from ...core.shapes.uv_maps import with_map
from .layers import with_layers
from .materials import slot_count
from .mesh_reading import fetched, is_smooth, mesh_arrays, mesh_record, normals_before, uv_map, vertices
from .shape_cache import Found

FORCED = {"SPHERE": SPHERE, "PLANE": PLANE, "INFINITE_PLANE": INFINITE_PLANE}
"""Kinds of shapes that an object's own setting can force, whatever its geometry is."""

COARSE = 0.02
"""Largest distance from a sphere, divided by its radius, of the flat faces of a mesh that is cast as a sphere. A
coarser mesh is cast as it is: Blender's ico sphere of 80 faces deviates by 0.066, that of 320 by 0.017.
"""

DEFAULT_RADIUS = 0.01
"""Radius of the points of a cloud without radii, as rendered by Cycles."""

REMEMBERED = 1024
"""Maximum number of meshes whose recognized shapes are cached: few meshes change between evaluations of a scene."""

NOTHING = None, ""
"""Result for data that a render does not show."""


def shapes_of(item, setting: str, layers: Collection[str] = (), moves: Sequence[Displacement | None] = ()) -> Found:
    """Return the shapes of an evaluated object's data, in object space, or the reason why it cannot be cast.

    ``setting`` is AUTOMATIC, MESH or a key of FORCED; ``layers`` are those of the mesh that its materials need,
    ``moves`` are the displacements of its material slots.
    """
    data = item.data
    if isinstance(data, bpy.types.PointCloud):
        return _of_points(data, FORCED.get(setting))
    if not isinstance(data, bpy.types.Mesh):
        return None, f"it is of type {data.bl_rna.name.lower()}, but only surfaces and point clouds are cast"
    try:  # a mesh in Edit Mode has its faces only there
        mesh = item.to_mesh()
        primitive, reason = mesh_shapes(mesh, setting, slot_count(item))
        if primitive is not None and layers:
            primitive = with_layers(primitive, mesh, item.original.data, layers)
        if primitive is not None and primitive.mesh is not None and any(moves):
            primitive = mesh_primitive(displaced(primitive.mesh, normals_before(mesh, primitive.mesh.polygon), moves))
        return primitive, reason
    finally:
        item.to_mesh_clear()


def mesh_shapes(mesh, setting: str, slots: int = 0) -> Found:
    """Return the shapes of an evaluated mesh, or the reason why it cannot be cast.

    With AUTOMATIC the number of its object's material slots counts: colors of several make it a mesh.
    """
    if not len(mesh.vertices):
        return NOTHING
    kind = FORCED.get(setting)
    if not len(mesh.polygons):
        return NOTHING if kind is None else _enclosing(kind, vertices(mesh))
    arrays = mesh_arrays(mesh)
    wrong = defect(arrays)
    recognized = wrong if wrong or setting == "MESH" else _recognized(arrays)
    if kind is not None:
        if isinstance(recognized, Primitive) and (recognized.kind == SPHERE) == (kind == SPHERE):
            return _mapped(replace(recognized, kind=kind), mesh, arrays), ""
        forced, reason = _enclosing(kind, arrays.vertices)
        return (forced, reason) if forced is None or wrong else (_mapped(forced, mesh, arrays), "")
    if isinstance(recognized, Primitive) and not _is_solid(recognized, mesh) and not _is_colorful(mesh, slots):
        exact = _mapped(recognized, mesh, arrays)
        if exact.kind == SPHERE or not exact.note:
            return exact, ""
    if wrong:
        return None, wrong
    return mesh_primitive(mesh_record(mesh, arrays)), ""


def _enclosing(kind, places: np.ndarray) -> Found:
    """Return the sphere or plane around (n, 3) places."""
    if not np.isfinite(places).all():
        return None, NOT_FINITE
    return replace(enclosing_primitive(kind, places), uv=NO_MAP), ""


def _mapped(exact: Primitive, mesh, arrays: MeshArrays) -> Primitive:
    """Return an exact shape with the render UV map of a mesh whose arrays are valid."""
    return with_map(exact, arrays.vertices[arrays.loop_vertices], uv_map(mesh))


def _is_solid(primitive: Primitive, mesh) -> bool:
    """Return whether a mesh recognized as a sphere is too coarse for a sphere, with faces that are not all smooth."""
    return primitive.kind == SPHERE and primitive.apart > COARSE and not is_smooth(mesh)


def _is_colorful(mesh, count: int) -> bool:
    """Return whether faces have different ones of ``count`` slots: an exact shape has one."""
    slot = mesh.attributes.get("material_index")
    if slot is None or count < 2:
        return False
    slots = np.clip(fetched(slot.data, "value", np.int32), 0, count - 1)
    return bool((slots != slots[0]).any())


_known: dict[bytes, Primitive | str] = {}


def _recognized(mesh: MeshArrays) -> Primitive | str:
    """Return the result of ``recognize``, which is called once for equal arrays."""
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
    if kind not in (None, SPHERE):
        return _enclosing(kind, positions)
    radius = cloud.attributes.get("radius")
    radii = fetched(radius.data, "value", np.float32) if radius else np.full(len(positions), DEFAULT_RADIUS, np.float32)
    id_attribute = cloud.attributes.get("id")
    ids = fetched(id_attribute.data, "value", np.int32) if id_attribute else np.arange(len(positions))
    primitive = replace(points_primitive(positions, radii, ids), uv=NO_MAP)
    missing = len(radii) - len(primitive)
    return primitive, (
        f"{missing} of its points have a radius that is not above zero, or a position that is not finite"
    ) if missing else ""
