"""Lights and the world as a depsgraph evaluated them."""

import math

import bpy
import numpy as np

USED = {"SUN": True, "POINT": False}
"""The types that the combined pass uses, each with whether it is a sun."""


def light_color(light) -> tuple[float, float, float]:
    """Return a light's color times its strength, exposure and temperature, in Blender's units."""
    with np.errstate(over="ignore"):
        strength = float(light.energy * np.exp2(light.exposure))
    tint = light.temperature_color if light.use_temperature else (1.0, 1.0, 1.0)
    return tuple(strength * a * b for a, b in zip(light.color, tint, strict=True))


def is_finite(color) -> bool:
    """Return whether all parts of a color are numbers that light can be."""
    return all(map(math.isfinite, color))


def shown(color) -> tuple[float, ...]:
    """Return a color of three or four parts; black where one is NaN or infinite, which would spread to every pixel."""
    return tuple(color) if is_finite(color) else (0.0, 0.0, 0.0, 1.0)[: len(color)]


def world_color(scene) -> tuple[float, float, float, float]:
    """Return the color behind everything: (0, 0, 0, 0) under a transparent film, black without a world.

    A world that is one Background of plain color and strength shows that; any other shows its viewport color.
    """
    if scene.render.film_transparent:
        return 0.0, 0.0, 0.0, 0.0
    if scene.world is None:
        return 0.0, 0.0, 0.0, 1.0
    red, green, blue = shown(_background(scene.world) or scene.world.color)
    return red, green, blue, 1.0


def _background(world) -> tuple[float, ...] | None:
    """Return the plain color that the world's nodes emit, None where they do not or depend on something."""
    uses_nodes = bpy.app.version >= (5, 0, 0) or world.use_nodes  # from 5.0 on a world has no other way
    output = world.node_tree.get_output_node("ALL") if uses_nodes and world.node_tree else None
    links = output.inputs["Surface"].links if output else ()
    if not links or links[0].from_node.bl_idname != "ShaderNodeBackground":
        return None
    color, strength = (links[0].from_node.inputs[name] for name in ("Color", "Strength"))
    if color.is_linked or strength.is_linked:
        return None
    return tuple(strength.default_value * value for value in color.default_value[:3])
