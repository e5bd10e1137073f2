"""Lights and the world, as evaluated by a depsgraph."""

import math

import numpy as np

from ...core.materials.directions import over_all_directions
from ...core.materials.values import Constant, Value, constant
from ...core.records import AREA, EVERYWHERE
from ...core.shape_records import World
from .materials import ALWAYS_NODES, VIEWPORT_COLOR, as_color, shown
from .nodes import Nodes, Unread, output_of
from .shader_nodes import colors
from .value_nodes import ENVIRONMENT, READ, READ_OF_WORLDS

DIRECTIONS = 1 << 12
"""Number of directions, evenly spread, whose mean is the light of a background that changes."""


def cone_of(light) -> tuple[float, float]:
    """Return how a light shines: see ``Lights.cone``. Spot lights fade as in Cycles."""
    if light.type == "AREA":
        return AREA
    if light.type != "SPOT":
        return EVERYWHERE
    edge = math.cos(light.spot_size / 2)
    return edge, max((1 - edge) * light.spot_blend, 1e-6)


def light_color(light) -> tuple[float, float, float]:
    """Return a light's color times its strength, exposure, temperature and what its nodes emit, in Blender's units.

    Raises Unread for nodes that are not read, or whose light differs by direction.
    """
    emitted = _emitted(light, READ) if getattr(light, "use_nodes", False) else None
    if not isinstance(emitted, Constant | None):
        raise Unread("it changes over the light")
    nodes = np.ones(3) if emitted is None else emitted.values[:, 0]
    with np.errstate(over="ignore"):
        strength = float(light.energy * np.exp2(light.exposure))
    tint = light.temperature_color if light.use_temperature else (1.0, 1.0, 1.0)
    return tuple(strength * a * b * c for a, b, c in zip(light.color, tint, nodes.tolist(), strict=True))


def world_of(depsgraph) -> tuple[World, tuple[tuple[str, str], ...]]:
    """Return the world that a depsgraph shows: the view layer's world override, or the scene's world; and its name and
    what is not read of it, in words.

    It is what the nodes of the world emit. A world without nodes, or with others than are read, shows its viewport
    color. Its alpha is 0 under a transparent film; without a world it is black.
    """
    scene = depsgraph.scene_eval
    world = depsgraph.view_layer_eval.world_override or scene.world
    if scene.render.film_transparent:
        return World((0.0, 0.0, 0.0, 0.0)), ()
    if world is None:
        return World(), ()
    unread: tuple[tuple[str, str], ...] = ()
    try:
        emitted = _emitted(world, READ_OF_WORLDS) if ALWAYS_NODES or world.use_nodes else None
    except Unread as error:
        emitted, unread = None, ((world.name, f"the world's color is not read: {error}. {VIEWPORT_COLOR}"),)
    if emitted is None or isinstance(emitted, Constant):
        red, green, blue = shown(world.color if emitted is None else emitted.values[:, 0].tolist())
        return World((red, green, blue, 1.0)), unread
    red, green, blue = over_all_directions(emitted, DIRECTIONS).tolist()
    return World((red, green, blue, 1.0), emitted), ()


def _emitted(owner, read: dict) -> Value | None:
    """Return what the nodes of a world or a light emit, three channels, given the functions that read them; None
    without nodes. Nodes with nothing at the output emit nothing, as in Cycles. Raises Unread.
    """
    if owner.node_tree is None:
        return None
    output, nodes = output_of(owner.node_tree), Nodes(read)
    glow = None if output is None else colors(nodes, *output["Surface"], weighs=False).glow
    glow = constant(0, 0, 0) if glow is None else as_color(glow)
    if ENVIRONMENT not in nodes.needs and not isinstance(glow, Constant):
        raise Unread("it changes without an environment image")
    return glow
