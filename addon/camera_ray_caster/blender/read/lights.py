"""Lights and the world as a depsgraph evaluated them."""

import numpy as np

from .materials import shown, surface_node

USED = {"SUN": True, "POINT": False}
"""The types that the combined pass uses, each with whether it is a sun."""


def light_color(light) -> tuple[float, float, float]:
    """Return a light's color times its strength, exposure and temperature, in Blender's units."""
    with np.errstate(over="ignore"):
        strength = float(light.energy * np.exp2(light.exposure))
    tint = light.temperature_color if light.use_temperature else (1.0, 1.0, 1.0)
    return tuple(strength * a * b for a, b in zip(light.color, tint, strict=True))


def world_color(depsgraph) -> tuple[float, float, float, float]:
    """Return the color behind everything: (0, 0, 0, 0) under a transparent film, black without a world.

    A world that is one Background of plain color and strength shows that; any other shows its viewport color. The view
    layer may have another one than the scene.
    """
    scene = depsgraph.scene_eval
    world = depsgraph.view_layer_eval.world_override or scene.world
    if scene.render.film_transparent:
        return 0.0, 0.0, 0.0, 0.0
    if world is None:
        return 0.0, 0.0, 0.0, 1.0
    red, green, blue = shown(_background(world) or world.color)
    return red, green, blue, 1.0


def _background(world) -> tuple[float, ...] | None:
    """Return the plain color that the world's nodes emit, None where they do not or depend on something."""
    node = surface_node(world, "ShaderNodeBackground")
    if node is None:
        return None
    color, strength = node.inputs["Color"], node.inputs["Strength"]
    if color.is_linked or strength.is_linked:
        return None
    return tuple(strength.default_value * value for value in color.default_value[:3])
