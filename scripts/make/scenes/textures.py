"""Image textures of the example scenes: drawn by formulas, packed, and mapped to meshes. Lengths are in meters."""

from __future__ import annotations

from math import pi

import bpy
import numpy as np

from .parts import geometry_nodes, material

BOARD = 1.3, 0.26
"""Length and width of what the image of wood shows."""


def packed(name: str, pixels):
    """Return an image of sRGB in 0 .. 1, (rows, columns, 3) from below."""
    rows, columns, _ = pixels.shape
    image = bpy.data.images.new(name, columns, rows)
    opaque = np.dstack([np.clip(pixels, 0, 1), np.ones((rows, columns))])
    image.pixels.foreach_set(opaque.astype(np.float32).ravel())
    image.pack()
    return image


def textured(color: str, image) -> None:
    """Give the material of an sRGB color an image in place of the color."""
    tree = material(color).node_tree
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image, node.location.x = image, -300
    tree.links.new(node.outputs["Color"], tree.nodes["Principled BSDF"].inputs["Base Color"])


def mapped(thing, across, up, middle: float = 0.0):
    """Give an object a mesh of its own with a flat UV map, and return the object.

    A corner's u and v are the dot products of its place, in meters, with ``across`` and ``up``, plus ``middle``.
    """
    thing.data = thing.data.copy()
    corners = np.array([thing.data.vertices[loop.vertex_index].co * thing.scale for loop in thing.data.loops])
    places = corners @ np.transpose([across, up]) + middle
    thing.data.uv_layers.new(name="UVMap").uv.foreach_set("vector", places.astype(np.float32).ravel())
    return thing


def grained(thing):
    """Map wood to a box: the grain is parallel to its longest side."""
    lengthwise = np.eye(3)[np.argmax(np.ptp([vertex.co for vertex in thing.data.vertices], axis=0))]
    return mapped(thing, lengthwise / BOARD[0], (1 - lengthwise) / BOARD[1])


def seen_from_above(thing, width: float) -> None:
    """Map an image of this width to what the modifiers make of an object: u along x, v along y, centered."""
    thing.data.uv_layers.new(name="UVMap")  # the active one, which the nodes fill
    store, tree = geometry_nodes(thing, "GeometryNodeStoreNamedAttribute")
    store.data_type, store.domain = "FLOAT2", "CORNER"
    store.inputs["Name"].default_value = "UVMap"
    position, scaled = tree.nodes.new("GeometryNodeInputPosition"), tree.nodes.new("ShaderNodeVectorMath")
    scaled.operation = "MULTIPLY_ADD"
    scaled.inputs[1].default_value, scaled.inputs[2].default_value = (1 / width,) * 3, (0.5,) * 3
    tree.links.new(position.outputs["Position"], scaled.inputs[0])
    tree.links.new(scaled.outputs["Vector"], store.inputs["Value"])


def rgb(color: str):
    """Return the sRGB of a color such as "e07a5f", (3,) in 0 .. 1."""
    return np.frombuffer(bytes.fromhex(color), np.uint8) / 255


def grid(rows: int, columns: int):
    """Return u and v of an image's pixel centers, (rows, columns) each, in 0 .. 1."""
    v, u = np.mgrid[:rows, :columns]
    return (u + 0.5) / columns, (v + 0.5) / rows


def wood(color: str, seed: int = 0):
    """Draw rings and fibers that continue from one edge to the opposite one."""
    u, v = grid(96, 256)
    bend = 0.45 * np.sin(2 * pi * (u + v) + seed) + 0.3 * np.sin(2 * pi * (2 * u - v) + 2 * seed)
    rings = 0.5 + 0.5 * np.sin(2 * pi * (5 * v + bend))
    fibers = sum(np.sin(2 * pi * (f * v + (f % 4 - 1) * u) + f * f + seed) for f in (13, 18, 23, 31)) / 4
    return rgb(color) * (1.04 - 0.1 * rings**2 + 0.04 * fibers)[..., None]


def wallpaper(color: str):
    """Draw stripes and flowers of six petals, a little darker than the color."""
    u, v = grid(64, 64)
    stripes = np.clip(4 * np.cos(2 * pi * 2 * u), -1, 1)
    flowers = np.zeros_like(u)
    for x, y in ((0.25, 0.25), (0.75, 0.75)):
        away, angle = np.hypot(u - x, v - y), np.arctan2(v - y, u - x)
        flowers += np.clip(0.5 + 32 * (0.08 + 0.03 * np.cos(6 * angle) - away), 0, 1) - (away < 0.03)
    return rgb(color) * (0.98 + 0.02 * stripes - 0.07 * flowers)[..., None]


def rosette(layers, width: float, side: int = 384):
    """Draw closed curves, each filled and covered by the next: (radius, wave, petals, color) of radius + wave cos."""
    x, y = (width * (coordinate - 0.5) for coordinate in grid(side, side))
    away, angle = np.hypot(x, y), np.arctan2(y, x)
    pixels = np.broadcast_to(rgb(layers[0][-1]), (side, side, 3))
    for radius, wave, petals, color in layers[1:]:
        inside = 0.5 + (radius + wave * np.cos(petals * angle) - away) * side / width
        pixels = pixels + np.clip(inside, 0, 1)[..., None] * (rgb(color) - pixels)
    return pixels


def evening(low: str, high: str, cloud: str):
    """Draw a sky that changes its color upward, with clouds."""
    u, v = grid(112, 192)
    wisps = sum(np.sin(a * u + b * v + 3 * np.sin(2 * u + a)) for a, b in ((9, 21), (14, -34), (23, 55))) / 3
    sky = rgb(low) + v[..., None] ** 0.8 * (rgb(high) - rgb(low))
    return sky + 0.85 * np.clip(2.2 * wisps - 0.3, 0, 1)[..., None] * (rgb(cloud) - sky)


def slope(color: str, top: str, at: float):
    """Draw a hillside whose color changes, along a ragged line at a height, to that of its top."""
    u, v = grid(96, 192)
    ragged = v + 0.07 * np.sin(37 * u) + 0.05 * np.sin(71 * u + 2) - at
    pixels = rgb(color) + np.clip(0.5 + 20 * ragged, 0, 1)[..., None] * (rgb(top) - rgb(color))
    return pixels * (1 + 0.1 * np.sin(24 * u + 9 * np.sin(11 * v)) * np.sin(31 * v - 18 * u))[..., None]
