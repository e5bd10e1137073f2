"""The colour of the combined pass: the material's colour lit by the scene's lights, or a grid of constant uv."""

from __future__ import annotations

import numpy as np

from .records import Lights
from .vector import difference, dot, norm

MATERIAL, GRID = "MATERIAL", "GRID"
SHADINGS = (MATERIAL, GRID)

GRID_CELLS = {"u": 24, "v": 12}
"""Lines of the grid around and from pole to pole of a sphere: every 15 degrees; on a plane as many across."""

LINE_WIDTH = 0.12
"""Width of a grid line in cells."""


def shade(surface) -> np.ndarray:
    """Return linear RGBA (m, 4) for the pixels of a surface.

    Lambert's law without shadows: a sun of E W/m^2 gives colour E cos / pi; a point light of P W at distance r
    gives colour P cos / (4 pi^2 r^2), as Blender's units have it; the world's colour is added as even light from
    all around. Without sun and point lights a headlight shines along each ray. GRID darkens lines of constant uv.
    """
    plan = surface.hits.plan
    shapes = plan.shapes
    normal = surface.select(surface.hits.normal)
    colour = shapes.colour[surface.rows].astype(np.float64)
    if plan.shading == GRID:
        colour[:, :3] *= _grid(surface)[:, None]
    light = _headlight(surface, normal) if len(shapes.lights.is_sun) == 0 else _lamps(surface, normal, shapes.lights)
    colour[:, :3] *= light + np.asarray(shapes.world_colour[:3])
    return colour


def _grid(surface) -> np.ndarray:
    """Return 1 between the lines and 0.15 on them."""
    on_line = np.zeros(len(surface.rows), bool)
    for coordinate, cells in zip(surface.kind.uv(surface.q), GRID_CELLS.values(), strict=True):
        offset = coordinate * cells
        on_line |= np.abs(offset - np.rint(offset)) < LINE_WIDTH / 2
    return np.where(on_line, 0.15, 1.0)


def _headlight(surface, normal) -> np.ndarray:
    direction = surface.select(surface.hits.world_direction)
    return (np.abs(dot(normal, direction)) / norm(direction))[:, None]


def _lamps(surface, normal, lights: Lights) -> np.ndarray:
    eye = surface.hits.plan.camera.pose.eye
    total = np.zeros((len(surface.rows), 3))
    point = surface.select(surface.hits.point)
    for position, is_sun, colour in zip(lights.position, lights.is_sun, lights.colour, strict=True):
        if is_sun:
            total += np.maximum(dot(normal, position), 0.0)[:, None] * (colour / np.pi)
            continue
        towards = difference(position - eye, point)
        length = norm(towards)
        cosine = np.maximum(dot(normal, towards), 0.0) / np.maximum(length, np.finfo(float).tiny)
        total += (cosine / np.maximum(length * length, np.finfo(float).tiny))[:, None] * (colour / (4 * np.pi**2))
    return total
