"""The color of the combined pass: the material's color lit by the scene's lights, or a grid of constant uv."""

from __future__ import annotations

import numpy as np

from ..maths.vector import difference, dot, inner
from ..records import Lights

MATERIAL, GRID = "MATERIAL", "GRID"
SHADINGS = (MATERIAL, GRID)

GRID_CELLS = {"u": 24, "v": 12}
"""Lines of the grid around and from pole to pole of a sphere: every 15 degrees; on a plane as many across."""

LINE_WIDTH = 0.12
"""Width of a grid line in cells."""


def shade(hits, out) -> None:
    """Write linear RGBA into ``out``, (rows, columns, 4): the shapes', or the world's where nothing is hit.

    Lambert's law without shadows: a sun of E W/m^2 gives color E cos / pi; a point light of P W at distance r
    gives color P cos / (4 pi^2 r^2), as Blender's units have it; the world's color is added as even light from
    all around. Without sun and point lights a headlight shines along each ray. GRID darkens lines of constant uv.
    """
    shapes = hits.plan.shapes
    color = hits.plan.colors
    lit = _headlight(hits) if len(shapes.lights.is_sun) == 0 else _lamps(hits, shapes.lights)
    grid = _grid(hits) if hits.plan.shading == GRID else None
    for channel, light in enumerate(lit):
        light = np.add(light, shapes.world_color[channel], out=hits.scratch("spare", hits.t.shape, np.float64))
        if grid is not None:
            np.multiply(light, grid, out=light)
        surface = hits.look_up(color[channel], "color")
        np.multiply(surface, light, out=out[..., channel], casting="same_kind")
    out[..., 3] = hits.look_up(color[3], "color")
    if hits.missed is not None:
        out[hits.missed] = shapes.world_color


def _grid(hits) -> np.ndarray:
    """Return 1 between the lines and 0.15 on them."""
    shade = np.ones(hits.t.shape)
    for surface in hits.surfaces:
        on_line = np.zeros(len(surface.rows), bool)
        for coordinate, cells in zip(surface.kind.uv(surface.q), GRID_CELLS.values(), strict=True):
            offset = coordinate * cells
            on_line |= np.abs(offset - np.rint(offset)) < LINE_WIDTH / 2
        shade[surface.where] = np.where(on_line, 0.15, 1.0)
    return shade


def _headlight(hits):
    light, spare = (hits.scratch(name, hits.t.shape, np.float64) for name in ("light", "spare"))
    inner(hits.normal, hits.world_direction, light, spare)
    np.divide(np.abs(light, out=light), hits.length, out=light)
    return light, light, light


def _lamps(hits, lights: Lights):
    """Return the light that falls on each pixel's surface, over pi: red, green and blue."""
    total = [0.0, 0.0, 0.0]
    for position, is_sun, color in zip(lights.position, lights.is_sun, lights.color, strict=True):
        if is_sun:
            light = np.maximum(dot(hits.normal, position), 0.0)
            strength = color / np.pi
        else:
            towards = difference(position - hits.plan.camera.pose.eye, hits.point)
            square = np.maximum(dot(towards, towards), np.finfo(float).tiny)
            light = np.maximum(dot(hits.normal, towards), 0.0) / (square * np.sqrt(square))
            strength = color / (4 * np.pi**2)
        total = [sum_ + light * part for sum_, part in zip(total, strength, strict=True)]
    return total
