"""The color of the combined pass: the material's color lit by the scene's lights, or a grid on the surfaces."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import repeat
from typing import Any

import numpy as np

from ..materials.directions import Directions
from ..maths.speed import write_where
from ..maths.vector import difference, dot, inner
from ..records import AREA, EVERYWHERE
from .hit_values import HitValues
from .request import GRID

GRID_CELLS = {"u": 24, "v": 12}
"""Number of grid lines around a sphere and from pole to pole, one every 15 degrees; the same numbers on a plane."""

LINE_WIDTH = 0.12
"""Width of a grid line in cells."""

SUN, POINT, SPOT, AREA_LIGHT, HEADLIGHT = "sun", "point light", "spot light", "area light", "headlight"
"""Kinds of lights."""


def shade(values: HitValues, out: np.ndarray) -> None:
    """Write linear RGBA into ``out``, (rows, columns, 4), where shapes are hit.

    Lambert's law without shadows: a sun of E W/m^2 gives color E cos / pi; a point light of P W at distance r gives
    color P cos / (4 pi^2 r^2), in Blender's units; a spot light that, times its falloff towards the edge; an area light
    that of a point light at its center, times 4 times the cosine at the lamp. The world's color is added as uniform
    light from all directions, and then the emission of the surface. Without lights a headlight shines along each ray.
    GRID darkens lines of constant longitude, latitude or other coordinate of exact shapes, lines of constant uv of
    meshes, or the edges of faces without a UV map.
    """
    world_color = values.target.shapes.world_color
    lit, grid = irradiance(values), grid_factor(values)
    for channel, world in enumerate(world_color):
        surface = material_color(values, channel)
        if channel < len(lit):
            light = np.add(lit[channel], world, out=values.array("spare"))
            if grid is not None:
                np.multiply(light, grid, out=light)
            np.multiply(surface, light, out=surface)
            paint(values, surface, lambda painted: painted.glow, channel, np.add)
        np.copyto(out[..., channel], surface, where=values.hits.where, casting="same_kind")


def sky(values: HitValues, out: np.ndarray) -> None:
    """Write linear RGBA into ``out``, (rows, columns, 4), where nothing is hit: the world's, and transparent black
    where there is no ray.
    """
    write_where(out, values.target.shapes.world_color, values.hits.missed)
    if values.target.shapes.background is not None and values.hits.missed is not None:
        places = np.nonzero(values.hits.missed)
        direction = [np.broadcast_to(component, values.hits.missed.shape)[places] for component in values.direction]
        color = Directions(direction).value(values.target.shapes.background)
        out[..., :3][places] = np.broadcast_to(color, (3, len(places[0]))).T
    write_where(out, 0, values.hits.lost)


def albedo(values: HitValues, out: np.ndarray) -> None:
    """Write linear RGB into ``out``, (rows, columns, 3): the color of the material, without light, and of emission
    without its strength, where shapes are hit.
    """
    for channel in range(3):
        surface = material_color(values, channel)
        paint(values, surface, lambda material: material.emission, channel, np.add)
        np.copyto(out[..., channel], surface, where=values.hits.where, casting="same_kind")


def material_color(values: HitValues, channel: int) -> np.ndarray:
    """Return a channel, of RGBA, of the color that the hit materials show in light, (rows, columns)."""
    color = values.of_material(values.target.colors[channel], "color")
    if channel < 3:
        paint(values, color, lambda surface: surface.lit, channel)
    return color


def paint(values: HitValues, image: np.ndarray, of: Callable, channel: int, how: Callable | None = None) -> None:
    """Write a channel of a part of the hit surfaces, such as ``lit``, into an image, (rows, columns), or combine both.
    """
    flat = image.reshape(-1)
    for surface, where, places in values.painted:
        value = of(surface)
        if value is not None:
            color = np.broadcast_to(places.value(value), (3, len(where)))[channel]
            flat[where] = color if how is None else how(flat[where], color)


def grid_factor(values: HitValues) -> np.ndarray | None:
    """Return 1 between the lines of the grid and 0.15 on them, (rows, columns); None without a grid."""
    if values.target.request.shading != GRID:
        return None
    shade = np.ones(values.hits.t.shape)
    for (where, places), (_, from_edge) in zip(values.coordinates, values.from_edge, strict=True):
        on_line = np.zeros(len(places[0]), bool)
        for coordinate, cells in zip(places, GRID_CELLS.values(), strict=True):
            offset = coordinate * cells
            on_line |= np.abs(offset - np.rint(offset)) < LINE_WIDTH / 2
        on_line = np.where(from_edge < np.inf, from_edge < LINE_WIDTH / 2, on_line)
        shade[where] = np.where(on_line, 0.15, 1.0)
    return shade


@dataclass(frozen=True, eq=False)
class Light:
    """The light of a lamp, or of the headlight, on the hit surfaces. It adds ``gain`` times ``strength``."""

    kind: str
    power: np.ndarray
    """(3,): the lamp's entry in ``Lights.color``; 1 for the headlight."""
    towards: Any
    """Three components of vectors from the surfaces to the lamp, of any length, in the world; None for the headlight,
    which shines along the rays.
    """
    square: Any
    """Square of the lamp's distance; 1 for a sun and the headlight."""
    gain: np.ndarray
    """Cosine over ``square``, times ``beam``, (rows, columns)."""
    strength: np.ndarray
    """(3,): the factor of ``gain``, red, green and blue."""
    beam: Any = 1.0
    """Of spot and area lights: the fraction of the power that goes towards the surface."""


def lights(values: HitValues) -> Iterator[Light]:
    """Yield the light of each lamp in their order, or if there are none that of the headlight."""
    lamps = values.target.shapes.lights
    if len(lamps.is_sun) == 0:
        light, spare = values.array("light"), values.array("spare")
        inner(values.normal, values.direction, light, spare)
        np.divide(np.abs(light, out=light), values.length, out=light)
        yield Light(HEADLIGHT, np.ones(3), None, 1.0, light, np.ones(3))
    beams = zip(lamps.axis, lamps.cone, strict=True) if len(lamps.axis) else repeat((None, EVERYWHERE))
    for position, is_sun, color, beam in zip(lamps.position, lamps.is_sun, lamps.color, beams, strict=False):
        if is_sun:
            gain = np.maximum(dot(values.normal, position), 0.0)
            yield Light(SUN, color, position, 1.0, gain, color / np.pi)
        else:
            towards = difference(position - values.target.pose.eye, values.point)
            square = np.maximum(dot(towards, towards), np.finfo(float).tiny)
            gain = np.maximum(dot(values.normal, towards), 0.0) / (square * np.sqrt(square))
            kind, strength = _beam(*beam, towards, square)
            yield Light(kind, color, towards, square, gain * strength, color / (4 * np.pi**2), strength)


def _beam(axis: np.ndarray | None, cone: Any, towards: Any, square: Any) -> tuple[str, Any]:
    """Return the kind of a lamp and what part of its power goes from it to the surfaces, over that of a point light."""
    if axis is None or tuple(cone) == EVERYWHERE:
        return POINT, 1.0
    cosine = -dot(axis, towards) / np.sqrt(square)
    if tuple(cone) == AREA:
        return AREA_LIGHT, 4 * np.maximum(cosine, 0.0)
    falloff = np.clip((cosine - cone[0]) / cone[1], 0.0, 1.0)
    return SPOT, falloff * falloff * (3 - 2 * falloff)


def irradiance(values: HitValues) -> list[Any]:
    """Return the irradiance of each pixel's surface by the lights divided by pi: red, green and blue."""
    total = [0.0, 0.0, 0.0]
    for light in lights(values):
        if light.kind == HEADLIGHT:
            return [light.gain] * 3
        total = [sum_ + light.gain * strength for sum_, strength in zip(total, light.strength, strict=True)]
    return total
