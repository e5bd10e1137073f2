"""Meshes of other libraries: objects with ``vertices`` and ``faces``, as of trimesh, or ``triangles``, as of Open3D,
and their colors: of vertices, of faces, or by a texture.
"""

from dataclasses import replace
from typing import Any

import numpy as np

from ..arguments import number, numbers
from ..conventions import EPS32
from ..materials.surface import Surface
from ..materials.textures import Texels, Texture, linear
from ..materials.values import UV, Coordinates, Layer, channel, function_of
from ..records import InputError, Shapes

LAYER = Layer("color", 4)
"""Colors of vertices or faces, at the corners of triangles."""


def arrays_of(mesh: Any) -> dict[str, Any]:
    """Return the vertices, faces and UV map of an object of trimesh, or of one that is like it, by argument of
    ``crc.mesh``. Raises InputError for any other object.
    """
    vertices, faces = getattr(mesh, "vertices", None), getattr(mesh, "faces", getattr(mesh, "triangles", None))
    if vertices is None or faces is None:
        raise InputError(
            f"{type(mesh).__name__} has no vertices and faces: give mesh(vertices, faces), or a mesh of trimesh; "
            "of a scene of trimesh, scene.to_mesh()"
        )
    faces = faces if isinstance(faces, list | tuple) else np.asarray(faces)
    return {"vertices": vertices, "faces": faces, "uv": getattr(getattr(mesh, "visual", None), "uv", None)}


def _rgba(values: Any, name: str, count: int) -> np.ndarray:
    """Return ``count`` colors or more, (n, 4) from 0 to 1, of rows of 3 or 4 numbers of 8 bits, or from 0 to 1."""
    colors = numbers(values, name)
    if colors.ndim != 2 or len(colors) < count or colors.shape[1] not in (3, 4):
        raise InputError(f"{name} of the mesh are of shape {colors.shape}: they must be ({count}, 3) or ({count}, 4)")
    colors = colors / 255 if np.asarray(values).dtype.kind in "iu" else colors
    if not ((colors >= 0) & (colors <= 1 + 4 * EPS32)).all():
        raise InputError(f"{name} of the mesh must be whole numbers from 0 to 255, or numbers from 0 to 1")
    return colors if colors.shape[1] == 4 else np.column_stack((colors, np.ones(len(colors))))


def with_colors(shapes: Shapes, mesh: Any) -> Shapes:
    """Return the shapes of a mesh with the colors of its vertices or faces, sRGB with 8 bits or from 0 to 1, or with
    the texture or color of its material.
    """
    visual = getattr(mesh, "visual", mesh)
    names = {"vertex": ("vertex_colors",), "face": ("face_colors",), "any": ("vertex_colors", "face_colors")}
    candidates = {name: getattr(visual, name, None) for name in names.get(getattr(visual, "kind", "any"), ())}
    known = {name: colors for name, colors in candidates.items() if colors is not None and numbers(colors, name).size}
    name, colors = next(iter(known.items()), ("", None))
    if not len(shapes):
        return shapes
    if colors is None:
        return _with_material(shapes, getattr(visual, "material", None), getattr(visual, "uv", None) is not None)
    of_faces = name == "face_colors"
    (triangles,) = shapes.meshes
    count = int(triangles.polygon.max()) + 1 if of_faces else triangles.vertices.shape[1]
    rgba = _rgba(colors, "colors", count)
    alpha = rgba[:, 3:]
    rgba = np.concatenate((linear(rgba[:, :3]), alpha), axis=1).astype(np.float32)
    corners = np.broadcast_to(triangles.polygon, triangles.triangles.shape) if of_faces else triangles.triangles
    lit, opacity = function_of(lambda values: values[:3], LAYER), None if (alpha == 1).all() else channel(LAYER, 3)
    shapes = replace(shapes, meshes=(replace(triangles, layers=((LAYER.name, rgba[corners]),)),))
    return _with_surface(shapes, Surface(lit, alpha=opacity), rgba.mean(axis=0))


def _with_material(shapes: Shapes, material: Any, has_uv: bool) -> Shapes:
    """Return the shapes with a material of trimesh, a SimpleMaterial or PBRMaterial: its image, or its one color."""
    if material is None:
        return shapes
    factor = getattr(material, "baseColorFactor", None)
    color = getattr(material, "main_color", (204, 204, 204, 255)) if factor is None else factor
    (color,) = _rgba([color], "the material's color", 1)
    color = color if factor is not None else np.append(linear(color[:3]), color[3:])  # glTF's factor is linear
    images = (getattr(material, name, None) for name in ("baseColorTexture", "image"))
    image = next((image for image in images if image is not None), None)
    if image is None or not has_uv:
        return replace(shapes, color=np.tile(color.astype(np.float32), (len(shapes), 1)))
    texels = np.asarray(image.convert("RGBA") if hasattr(image, "convert") else image)
    if texels.dtype != np.uint8 or texels.ndim != 3 or texels.shape[2] != 4 or not texels.size:
        raise InputError(f"the texture of the mesh is {texels.dtype} of shape {texels.shape}: give RGBA of 8 bits")
    scale = np.ones(4) if factor is None else color
    texture = Texture(Texels("texture", np.ascontiguousarray(texels[::-1]), True, True), Coordinates(UV))
    lit = function_of(lambda values: values * scale[:3, None], texture)
    solid = (texels[..., 3] == 255).all() or getattr(material, "alphaMode", "MASK") in (None, "OPAQUE")
    alpha = None if solid else function_of(lambda values: values * scale[3], replace(texture, is_alpha=True))
    threshold = number(getattr(material, "alphaCutoff", None) or 0.5, "alphaCutoff of the mesh's material", 1.0, 0.0)
    mean = np.append(linear(texels[..., :3] / 255).mean(axis=(0, 1)), 1.0) * scale
    return _with_surface(shapes, Surface(lit, alpha=alpha, threshold=threshold), mean)


def _with_surface(shapes: Shapes, surface: Surface, mean: np.ndarray) -> Shapes:
    n = len(shapes)
    color = np.tile(mean.astype(np.float32), (n, 1))
    return replace(shapes, color=color, surfaces=(surface,), surface=np.zeros(n, np.int32))
