"""The color of the combined pass: the material's color lit by the scene's lights, or a grid of constant uv."""

from __future__ import annotations

import numpy as np

from ..maths.speed import write_where
from ..maths.vector import difference, dot, inner
from ..records import Lights
from .hit_values import HitValues
from .request import GRID

GRID_CELLS = {"u": 24, "v": 12}
"""Number of grid lines around a sphere and from pole to pole, one every 15 degrees; the same numbers on a plane."""

LINE_WIDTH = 0.12
"""Width of a grid line in cells."""


def shade(values: HitValues, out: np.ndarray) -> None:
    """Write linear RGBA into ``out``, (rows, columns, 4): the color of the shape, or of the world where nothing is hit.

    Lambert's law without shadows: a sun of E W/m^2 gives color E cos / pi; a point light of P W at distance r gives
    color P cos / (4 pi^2 r^2), in Blender's units; the world's color is added as uniform light from all directions.
    Without sun and point lights a headlight shines along each ray. GRID darkens lines of constant uv, or the edges of
    faces without a UV map.
    """
    shapes, missed = values.plan.shapes, values.hits.missed
    color = values.plan.colors
    lit = _headlight(values) if len(shapes.lights.is_sun) == 0 else _lamps(values, shapes.lights)
    grid = _grid(values) if values.plan.request.shading == GRID else None
    for channel, world in enumerate(shapes.world_color):
        surface = np.take(color[channel], values.material, mode="wrap", out=values.array("color"))
        if channel < len(lit):
            light = np.add(lit[channel], world, out=values.array("spare"))
            if grid is not None:
                np.multiply(light, grid, out=light)
            np.multiply(surface, light, out=surface)
        out[..., channel] = surface
    write_where(out, shapes.world_color, missed)


def _grid(values: HitValues) -> np.ndarray:
    """Return 1 between the lines and 0.15 on them."""
    shade = np.ones(values.hits.t.shape)
    for (where, uv), (_, from_edge) in zip(values.uv, values.from_edge, strict=True):
        on_line = np.zeros(len(uv[0]), bool)
        for coordinate, cells in zip(uv, GRID_CELLS.values(), strict=True):
            offset = coordinate * cells
            on_line |= np.abs(offset - np.rint(offset)) < LINE_WIDTH / 2
        on_line = np.where(from_edge < np.inf, from_edge < LINE_WIDTH / 2, on_line)
        shade[where] = np.where(on_line, 0.15, 1.0)
    return shade


def _headlight(values: HitValues):
    light, spare = values.array("light"), values.array("spare")
    inner(values.normal, values.direction, light, spare)
    np.divide(np.abs(light, out=light), values.length, out=light)
    return light, light, light


def _lamps(values: HitValues, lights: Lights):
    """Return the irradiance of each pixel's surface divided by pi: red, green and blue."""
    total = [0.0, 0.0, 0.0]
    for position, is_sun, color in zip(lights.position, lights.is_sun, lights.color, strict=True):
        if is_sun:
            light = np.maximum(dot(values.normal, position), 0.0)
            strength = color / np.pi
        else:
            towards = difference(position - values.plan.camera.pose.eye, values.point)
            square = np.maximum(dot(towards, towards), np.finfo(float).tiny)
            light = np.maximum(dot(values.normal, towards), 0.0) / (square * np.sqrt(square))
            strength = color / (4 * np.pi**2)
        total = [sum_ + light * part for sum_, part in zip(total, strength, strict=True)]
    return total
