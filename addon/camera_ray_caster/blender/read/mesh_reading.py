"""Bulk reading of Blender's meshes: arrays for the recognition of shapes, and the record of the triangles."""

from ctypes import c_char

import numpy as np

from ...core.mesh import Mesh
from ...core.shapes.mesh.displaced import MeshNormals
from ...core.shapes.recognize import MeshArrays
from .corner_normals import SPLITS, smooth_across


def vertices(mesh) -> np.ndarray:
    """Return the vertices of a mesh that has vertices, (n, 3) float32."""
    return fetched(mesh.attributes["position"].data, "vector", np.float32, 3).reshape(-1, 3)


def mesh_arrays(mesh) -> MeshArrays:
    """Return the plain arrays of a mesh with faces. They may be corrupt: Blender stores any index."""
    return MeshArrays(
        vertices=vertices(mesh),
        loop_vertices=fetched(mesh.attributes[".corner_vert"].data, "value", np.int32),
        loop_edges=fetched(mesh.attributes[".corner_edge"].data, "value", np.int32),
        loop_starts=copied(mesh.polygons, "loop_start", np.int32),
        edge_count=len(mesh.edges),
    )


def mesh_record(mesh, arrays: MeshArrays) -> Mesh:
    """Return the record of an evaluated mesh and its arrays, which must be valid. Blender triangulates the faces.

    In every Blender version the normals are those of Blender 5.2: corners of flat faces have the face's normal. There
    are no normals if all faces are flat.
    """
    loops = triangle_loops(mesh)
    uv = uv_map(mesh)
    slot = mesh.attributes.get("material_index")
    polygon = fetched(mesh.loop_triangle_polygons, "value", np.int32)
    triangles = arrays.loop_vertices[loops]
    by_vertex = uv is None and mesh.normals_domain == "POINT" and (_free(mesh) is None or is_smooth(mesh))
    normals = _normals(mesh, arrays, by_vertex)
    if by_vertex:
        loops = triangles
    return Mesh(
        vertices=_rows(arrays.vertices),
        triangles=triangles,
        polygon=polygon,
        loops=None if normals is None and uv is None else loops,
        normals=normals,
        uv=uv,
        slot=None if slot is None else _slots(fetched(slot.data, "value", np.int32), polygon),
    )


def uv_map(mesh) -> np.ndarray | None:
    """Return the render UV map at the loops, (l, 2) float32; None without a UV map."""
    layer = next((layer for layer in mesh.uv_layers if layer.active_render), None)
    return None if layer is None else fetched(layer.uv, "vector", np.float32, 2).reshape(-1, 2)


def normals_before(mesh, polygon: np.ndarray) -> MeshNormals:
    """Return the normals that displacement starts from, given the face of each triangle."""
    smooth = np.ones(len(mesh.polygons), bool) if mesh.attributes.get("sharp_face") is None else ~_flat(mesh)
    normals = copied(mesh.vertex_normals, "vector", np.float32, 3).reshape(-1, 3)
    return MeshNormals(smooth[polygon], _rows(normals))


def is_smooth(mesh) -> bool:
    """Return whether every face is shaded smooth."""
    sharp = mesh.attributes.get("sharp_face")
    return sharp is None or not _flat(mesh).any()


def _flat(mesh) -> np.ndarray:
    """Return which faces of a mesh with the attribute sharp_face are shaded flat."""
    return fetched(mesh.attributes["sharp_face"].data, "value", bool)


def triangle_loops(mesh) -> np.ndarray:
    """Return the loops of each triangle, (3, k) int32."""
    if len(mesh.loops) == 3 * len(mesh.polygons):
        return np.arange(len(mesh.loops), dtype=np.int32).reshape(-1, 3).T.copy()
    mesh.calc_loop_triangles()
    return _rows(copied(mesh.loop_triangles, "loops", np.int32, 3).reshape(-1, 3))


def _normals(mesh, arrays: MeshArrays, by_vertex: bool) -> np.ndarray | None:
    """Return the normals at the loops, (l, 3) float32, or at the vertices if ``by_vertex``; None if all faces are flat.

    If corners have no normals of their own, the vertices' normals are used: Blender computes them in a tenth of the
    time.
    """
    domain, free = mesh.normals_domain, _free(mesh)
    if domain == "FACE":
        return None
    corners = mesh.vertex_normals if domain == "POINT" else mesh.corner_normals
    if free is None:
        normals = copied(corners, "vector", np.float32, 3).reshape(-1, 3)
        if SPLITS and domain == "CORNER":
            smooth_across(normals, arrays, _sharp(mesh, arrays))
    else:  # of any length; as corner normals, Blender 4.5 and 5.0 return freed memory
        normals = fetched(free.data, "vector", np.float32, 3).reshape(-1, 3)
        lengths = np.sqrt((normals * normals).sum(axis=1, keepdims=True))
        normals /= np.where(lengths > 0, lengths, 1)
    if domain != "POINT" or by_vertex:
        return normals
    normals = normals[arrays.loop_vertices]
    if free is not None and not is_smooth(mesh):  # they count for nothing on flat faces
        face = faces(arrays)
        flat = _flat(mesh)[face]
        if flat.all():
            return None
        # not polygon_normals, which Blender 5.0 returns wrong beside such normals
        normals[flat] = fetched(mesh.polygons, "normal", np.float32, 3).reshape(-1, 3)[face[flat]]
    return normals


def _sharp(mesh, arrays: MeshArrays) -> np.ndarray:
    """Return which edges are sharp, or next to a flat face, (e,) bool."""
    sharp = mesh.attributes.get("sharp_edge")
    edges = np.zeros(len(mesh.edges), bool) if sharp is None else fetched(sharp.data, "value", bool)
    if not is_smooth(mesh):
        edges[arrays.loop_edges[_flat(mesh)[faces(arrays)]]] = True
    return edges


def faces(arrays: MeshArrays) -> np.ndarray:
    """Return the face of each corner, (l,)."""
    counts = np.diff(arrays.loop_starts, append=len(arrays.loop_vertices))
    return np.repeat(np.arange(len(arrays.loop_starts)), counts)


def _free(mesh):
    """Return the attribute of normals that are stored as plain vectors; None without it."""
    free = mesh.attributes.get("custom_normal")
    return free if free is not None and free.data_type == "FLOAT_VECTOR" else None


def _slots(slots: np.ndarray, polygon: np.ndarray) -> np.ndarray | None:
    """Return the slot of each triangle, (k,) int16, clipped to Blender's range 0 .. 32767; None if all are 0."""
    slots = np.clip(slots, 0, np.iinfo(np.int16).max).astype(np.int16)
    return slots[polygon] if slots.any() else None


def _rows(values: np.ndarray) -> np.ndarray:
    """Return (n, m) values as m contiguous rows."""
    return np.ascontiguousarray(values.T)


def fetched(collection, name: str, dtype, width: int = 1) -> np.ndarray:
    """Return a property of all members of a collection as one flat array, ``width`` values per member."""
    values = np.empty(len(collection) * width, dtype)
    collection.foreach_get(name, values)
    return values


def copied(collection, name: str, dtype, width: int = 1) -> np.ndarray:
    """Return the same as ``fetched``, for a property that is the whole content of each member.

    For some collections ``foreach_get`` reads each member separately, which takes 0.2 s per million members. Such a
    collection is copied as one block, if the addresses of its first, second and last member and the last member's value
    show that it is contiguous.
    """
    count, size = len(collection), width * np.dtype(dtype).itemsize
    if count > 1:
        first, second, last = (collection[k].as_pointer() for k in (0, 1, count - 1))
        if (second - first, last - first) == (size, (count - 1) * size):
            values = np.frombuffer((c_char * (count * size)).from_address(first), dtype).copy()
            if np.array_equal(values[-width:], np.ravel(getattr(collection[count - 1], name))):
                return values
    return fetched(collection, name, dtype, width)
