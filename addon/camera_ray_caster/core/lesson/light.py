"""The color of one pixel in words: its material, the light of each lamp and of the world, the grid, and the product."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from ..casting.hit_values import HitValues
from ..casting.shading import HEADLIGHT, POINT, SUN, Light, grid_factor, irradiance, lights, material_color, paint
from .formula import digits, shown

MOST_LAMPS = 12
"""Maximum number of lamps listed: those that give most."""


def color_lines(values: HitValues, color: np.ndarray) -> Iterator[str]:
    """Yield lines on the linear color (4,) of one pixel, whose values are (1, 1) arrays."""
    if values.hits.lost is not None:
        yield f"no ray, no color: {shown(color)}"
        return
    if values.hits.missed is not None:
        yield f"linear, of the world: {shown(color)}"
        return
    world = values.target.shapes.world_color[:3]
    with np.errstate(all="ignore"):  # a lamp may be at the point itself
        material = np.array([_one(material_color(values, channel)) for channel in range(4)])
        glow = np.zeros((3, 1, 1))
        for channel, channel_glow in enumerate(glow):
            paint(values, channel_glow, lambda surface: surface.glow, channel)
        terms = [(_one(light.gain) * light.strength, *_told(light, number)) for number, light in
                 enumerate(lights(values), 1)]  # fmt: skip
        total = [_one(channel_sum) + of_world for channel_sum, of_world in zip(irradiance(values), world, strict=True)]
        grid = grid_factor(values)
    yield f"material {shown(material)}"
    ranked = sorted(range(len(terms)), key=lambda k: -terms[k][0].max())
    for share, line, formula in (terms[k] for k in sorted(ranked[:MOST_LAMPS])):
        yield line
        yield f"  {formula} = {shown(share)}"
    if len(terms) > MOST_LAMPS:
        yield f"{len(terms) - MOST_LAMPS} more lamps, together {shown(sum(terms[k][0] for k in ranked[MOST_LAMPS:]))}"
    yield f"world, from all directions {shown(world)}"
    yield f"light, of lamps and world {shown(total)}"
    if grid is not None:
        yield f"grid {_one(grid):g}, {'on a line' if _one(grid) < 1 else 'between its lines'}"
    if glow.any():
        yield f"emission {shown(glow[:, 0, 0])}"
    factors = f"material · light{'' if grid is None else ' · grid'}{' + emission' if glow.any() else ''}"
    yield f"linear, {factors}: {shown(color)}"


def _told(light: Light, number: int) -> tuple[str, str]:
    """Return the place of a light, and the formula of what it gives."""
    beam = _one(light.beam)
    cosine = f"cosine {digits(_one(light.gain * light.square) / beam if beam else 0.0)}"
    if light.kind == HEADLIGHT:
        return f"headlight along the ray, as there are no lamps: {cosine}", "cosine"
    towards = np.array([_one(component) for component in light.towards])
    line = f"{light.kind} {number} towards {shown(towards / np.linalg.norm(towards))}, {cosine}"
    if light.kind != SUN:
        beam_text = "" if light.kind == POINT else f"beam {digits(beam)}, "
        line = f"{line}, {beam_text}distance = {digits(np.sqrt(_one(light.square)))}, P = {shown(light.power)}"
        return line, f"P {'beam ' if beam_text else ''}cosine / (4 pi² distance²)"
    return f"{line}, E = {shown(light.power)}", "E cosine / pi"


def _one(values: Any) -> float:
    """Return the one value of a number or an array."""
    return float(np.ravel(values)[0])
