"""Attributes of meshes that materials use: UV maps, color attributes and texture space, at the corners of faces."""

from collections.abc import Collection, Iterator
from dataclasses import replace

import bpy
import numpy as np

from ...core.shapes.instances import Primitive
from ...core.shapes.recognize import MeshArrays
from .mesh_reading import faces, fetched, mesh_arrays, triangle_loops
from .value_nodes import GENERATED


def with_layers(primitive: Primitive, mesh, original, names: Collection[str]) -> Primitive:
    """Return a primitive whose triangles have the layers of these names that an evaluated mesh has; unchanged if it is
    an exact shape. "uv:NAME" is a UV map, "color:NAME" an attribute as RGBA, without a name the render color attribute,
    GENERATED the texture space. ``original`` is the data that the mesh was evaluated from.
    """
    if primitive.mesh is None:
        return primitive
    loops = triangle_loops(mesh)
    layers = tuple((name, values[loops]) for name, values in _layers(mesh, mesh_arrays(mesh), original, names))
    return replace(primitive, mesh=replace(primitive.mesh, layers=layers))


def _layers(mesh, arrays: MeshArrays, original, names: Collection[str]) -> Iterator[tuple[str, np.ndarray]]:
    """Yield layers at the corners, (l, channels) float32."""
    for name in sorted(names):
        kind, _, label = name.partition(":")
        if kind == "uv" and label in mesh.uv_layers:
            uv = _values(mesh.uv_layers[label].uv, "vector", 2)
            yield name, np.hstack((uv, np.zeros((len(uv), 1), np.float32)))
        elif kind == "color":
            color = _color(mesh, arrays, label)
            if color is not None:
                yield name, color
        elif kind == GENERATED:
            yield name, _generated(mesh, original)[arrays.loop_vertices]


def _color(mesh, arrays: MeshArrays, label: str) -> np.ndarray | None:
    """Return an attribute as RGBA at the corners; None if there is none of this name that can be read."""
    attribute = mesh.attributes.get(label or mesh.color_attributes.default_color_name or "")
    if attribute is None or attribute.domain not in CORNERS:
        return None
    if attribute.data_type in {"FLOAT_COLOR", "BYTE_COLOR"}:
        values = _values(attribute.data, "color", 4)
    elif attribute.data_type in {"FLOAT_VECTOR", "FLOAT2"}:
        wide = 3 if attribute.data_type == "FLOAT_VECTOR" else 2
        values = np.pad(_values(attribute.data, "vector", wide), ((0, 0), (0, 4 - wide)))
        values[:, 3] = 1
    elif attribute.data_type in {"FLOAT", "INT", "BOOLEAN", "INT8"}:
        kind = {"FLOAT": np.float32, "BOOLEAN": bool}.get(attribute.data_type, np.int32)
        value = fetched(attribute.data, "value", kind)
        values = np.repeat(value.astype(np.float32)[:, None], 4, axis=1)
        values[:, 3] = 1
    else:
        return None
    return np.nan_to_num(CORNERS[attribute.domain](arrays, values))


CORNERS = {
    "CORNER": lambda arrays, values: values,
    "POINT": lambda arrays, values: values[arrays.loop_vertices],
    "FACE": lambda arrays, values: values[faces(arrays)],
}
"""The values at the corners of values by domain."""


def _generated(mesh, original) -> np.ndarray:
    """Return the places of vertices in the mesh's texture space, (v, 3): 0 to 1 over the box before modifiers.

    Only a render keeps these places. Otherwise they are those of the original mesh, if it has as many vertices.
    """
    places = _values(mesh.vertices, "undeformed_co", 3)
    as_evaluated = np.array_equal(places, _values(mesh.vertices, "co", 3))
    if as_evaluated and isinstance(original, bpy.types.Mesh) and len(original.vertices) == len(places):
        places = _values(original.vertices, "co", 3)
    size, middle = (np.array(tuple(vector), np.float64) for vector in (mesh.texspace_size, mesh.texspace_location))
    scale = np.where(size != 0, 0.5 / np.where(size != 0, size, 1.0), 1.0)
    return ((places.astype(np.float64) - middle) * scale + 0.5).astype(np.float32)


def _values(collection, name: str, width: int) -> np.ndarray:
    return fetched(collection, name, np.float32, width).reshape(-1, width)
