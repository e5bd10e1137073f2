"""Meshes of other libraries, such as trimesh: objects with ``vertices``, ``faces`` and, in ``visual``, colors."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ..arguments import numbers, shown
from ..materials.surface import Surface
from ..materials.textures import linear
from ..materials.values import Layer, channel, function_of
from ..records import InputError, Shapes

LAYER = Layer("color", 4)
"""Colors of vertices or faces, at the corners of triangles."""


def arrays_of(mesh: Any) -> dict[str, Any]:
    """Return the vertices, faces and UV map of an object of trimesh, or of one that is like it, by argument of
    ``crc.mesh``. Raises InputError for any other object.
    """
    vertices, faces = (getattr(mesh, name, None) for name in ("vertices", "faces"))
    if vertices is None or faces is None:
        type_name = shown(type(mesh))
        raise InputError(f"{type_name} has no vertices and faces: give mesh(vertices, faces), or a mesh of trimesh")
    uv = getattr(getattr(mesh, "visual", None), "uv", None)
    return {"vertices": np.asarray(vertices), "faces": np.asarray(faces), "uv": None if uv is None else np.asarray(uv)}


def with_colors(shapes: Shapes, mesh: Any) -> Shapes:
    """Return the shapes of a mesh with the colors of its vertices or faces: sRGB, with 8 bits or from 0 to 1."""
    visual = getattr(mesh, "visual", None)
    names = {"vertex": ("vertex_colors",), "face": ("face_colors",), "any": ("vertex_colors", "face_colors")}
    candidates = ((name, getattr(visual, name, None)) for name in names.get(getattr(visual, "kind", "any"), ()))
    name, colors = next(((name, colors) for name, colors in candidates if colors is not None), ("", None))
    if colors is None or not len(shapes):
        return shapes
    of_faces = name == "face_colors"
    (triangles,) = shapes.meshes
    count = int(triangles.polygon.max()) + 1 if of_faces else triangles.vertices.shape[1]
    rgba = numbers(colors, "colors")
    if rgba.ndim != 2 or len(rgba) < count or rgba.shape[1] not in (3, 4):
        raise InputError(f"colors of the mesh are of shape {rgba.shape}: they must be ({count}, 3) or ({count}, 4)")
    rgba = rgba / 255 if np.asarray(colors).dtype.kind in "iu" else rgba
    alpha = rgba[:, 3:] if rgba.shape[1] == 4 else np.ones((len(rgba), 1))
    rgba = np.concatenate((linear(rgba[:, :3]), alpha), axis=1).astype(np.float32)
    corners = np.broadcast_to(triangles.polygon, triangles.triangles.shape) if of_faces else triangles.triangles
    surface = Surface(
        lit=function_of(lambda values: values[:3], LAYER), alpha=None if (alpha == 1).all() else channel(LAYER, 3)
    )
    n = len(shapes)
    return replace(
        shapes, color=np.tile(rgba.mean(axis=0), (n, 1)), surfaces=(surface,), surface=np.zeros(n, np.int32),
        meshes=(replace(triangles, layers=((LAYER.name, rgba[corners]),)),),
    )  # fmt: skip
