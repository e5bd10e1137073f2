"""Lights and the world, as evaluated by a depsgraph."""

import numpy as np

from .materials import shown, surface_node

USED = {"SUN": True, "POINT": False}
"""Types of lights that the combined pass uses, and whether each is a sun."""


def light_color(light) -> tuple[float, float, float]:
    """Return a light's color times its strength, exposure and temperature, in Blender's units."""
    with np.errstate(over="ignore"):
        strength = float(light.energy * np.exp2(light.exposure))
    tint = light.temperature_color if light.use_temperature else (1.0, 1.0, 1.0)
    return tuple(strength * a * b for a, b in zip(light.color, tint, strict=True))


def world_color(depsgraph) -> tuple[float, float, float, float]:
    """Return the color behind everything: (0, 0, 0, 0) under a transparent film, black without a world.

    The color of a world with a single Background node of plain color and strength is that color times the strength; any
    other world shows its viewport color. The view layer's world override takes precedence over the scene's world.
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
    """Return the plain color that the world's nodes emit; None if there is none or if it depends on other nodes."""
    node = surface_node(world, "ShaderNodeBackground")
    if node is None:
        return None
    color, strength = node.inputs["Color"], node.inputs["Strength"]
    if color.is_linked or strength.is_linked:
        return None
    return tuple(strength.default_value * value for value in color.default_value[:3])
