"""The aperture of a real lens: the rays of a film point through the whole stop, traced through every surface.

A disc in the plane of the paraxial exit pupil, around the point where the pixel's chief ray crosses it, holds all rays
that pass. Rays in whose way the stop or a rim stands carry no light: that loss is the vignetting. The light of a ray is
in proportion to cos^4 of its angle to the axis at the film, relative to the middle of the picture.
References: C. Kolb, D. Mitchell, P. Hanrahan, A Realistic Camera Model for Computer Graphics (1995).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ...lenses.chief import ChiefRays
from ...lenses.optics import BISECTIONS, Optics
from ...lenses.trace import LensSurface, trace
from ...maths.recording import is_recorded, look_up
from ...maths.vector import norm
from .aperture import Aperture

RADII = 25
"""Radii on the film, from the axis to the end of the picture, at which the disc is tried."""

GRID = 65
"""Points along the side of a square in which the disc is tried."""

TRIED = 1.5
"""Half the side of that square over the radius of the paraxial exit pupil: six lenses need 0.98 to 1.1."""

SLACK = 2.0 * TRIED / (GRID - 1)
"""What the disc is wider than the farthest point that passes, in paraxial radii: the grid's step."""

MARGIN = 1.25
"""What the grid's largest values are multiplied by: a step at the rim changes third-order aberrations by 1.15."""

NARROWED = 8
"""Largest number of times that the picture's end is moved to where light ends, if that is less than half of it."""

LEVEL = 0.1
"""Smallest cosine by which the depth of focus is divided to have the distance along a chief ray."""

FEWEST = 1 / 64
"""Smallest share of passing rays by which light is divided, where vignetting is switched off."""


@dataclass(frozen=True)
class Pupil(Aperture):
    """The entrance pupil as an ``Aperture``, and the disc in the exit pupil."""

    plane: float = 0.0
    """z of the paraxial exit pupil in the lens frame, mm of the lens."""
    disc: float = 0.0
    """Radius of the disc there, mm of the lens."""
    stop_radius: float = np.inf
    """Radius of the stop, mm of the lens; inf if the points have its shape."""
    passing: tuple[float, ...] = ()
    """Share of the disc that passes, by the radius on the film in even steps from 0 to ``corner``."""
    cosine: float = 1.0
    """Mean of cos^4 of the angle at the film, of the rays that pass on the axis."""
    corner: float = np.inf
    """Radius on the film to which ``passing`` goes, mm of the lens."""
    colors: tuple[tuple[float, ...], ...] = ()
    """Indices of red, green and blue light before the lens and behind each surface; empty if they are not traced apart.
    """
    apart: float = np.inf
    """Largest distance of a ray's line from the origin of the pixel's chief ray, Blender units."""
    spread: tuple[float, ...] = ()
    """Largest distance of a ray from the chief ray where that one is sharp, over the way there, of chief rays at most
    ``angles`` from the axis, in radians.
    """
    angles: tuple[float, ...] = ()
    sharp: tuple[float, float] = (1.0, np.inf)
    """Least and largest distance along chief rays at which ``spread`` was found, Blender units."""
    reach: float = 0.0
    """Largest distance from the eye at which rays begin, Blender units."""

    def blur(self, centers, radii, planar: bool):
        """See Aperture. At a distance s of a chief ray that is sharp at D another ray of the pixel is at most
        apart |1 - s / D| + spread s away: it is a line.
        """
        distance = np.sqrt((centers * centers).sum(axis=1))
        near, far = np.maximum(distance - radii - self.reach, 0.0), distance + radii + self.reach
        blur = self.apart * np.maximum(1 - near / self.sharp[1], far / self.sharp[0] - 1)
        around = (radii + blur + far * self.spread[-1] + self.reach) / distance
        farthest = np.arccos(-centers[:, 2] / distance) + np.arcsin(np.minimum(around, 1.0))
        place = np.searchsorted(self.angles, np.where(around < 1, farthest, np.inf), "right")
        return blur + far * np.array(self.spread)[np.minimum(place, RADII - 1)]


def color_of(x, y):
    """Return a number from 0 to 3 for samples at pixel coordinates: below 1 they are red, below 2 green. It changes by
    an irrational number from sample to sample of a pixel, which spreads them evenly.
    """
    place = 7.236 * x + 5.412 * y
    return 3 * (place - np.floor(place))


def of_color(color, values):
    """Return that of three numbers which belongs to the color of each ray."""
    red, green, blue = values
    return red if red == green == blue else np.where(color < 1, red, np.where(color < 2, green, blue))


def from_film(optics: Optics, film: float, chief: ChiefRays, pupil: Pupil, a, b, point, color=None):
    """Return origin and direction of rays before the lens, in the lens frame.

    a, b: the picture's place on the film, upright, mm of the lens. point: of the unit disc. color: as of ``color_of``;
    None for the wavelength of ``optics``. NaN in the direction's x of rays that do not pass.
    """
    plane, crossing = pupil.plane, chief.crossing(a * a + b * b)
    across, up = (-place * crossing + pupil.disc * part for place, part in zip((a, b), point, strict=True))
    side = 1.0 if film > plane else -1.0
    direction = side * (across + a), side * (up + b), side * (plane - film)
    length = np.sqrt(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2])
    dx, dy, dz = (part / length for part in direction)
    return trace(_surfaces(optics, pupil, color)[::-1], (-a, -b, film), (dx, dy, dz), to_film=False)


def _surfaces(optics: Optics, pupil: Pupil, color) -> list[LensSurface]:
    """Return the surfaces with the pupil's stop, and with the indices for a color."""
    surfaces = list(optics.surfaces)
    surfaces[optics.stop] = replace(surfaces[optics.stop], rim=pupil.stop_radius)
    if color is None:
        return surfaces
    media = [of_color(color, pupil.colors[0])]
    for before, values in pairwise(pupil.colors):
        media.append(media[-1] if values == before else of_color(color, values))
    return [replace(each, before=media[k], behind=media[k + 1]) for k, each in enumerate(surfaces)]


def measured(
    optics: Optics, film: float, chief: ChiefRays, pupil: Pupil, radius: float, unit: float, corner: float
) -> Pupil:
    """Return a pupil with its disc, the shares that pass and the spread, by tracing a grid at RADII radii.

    radius: of the stop, and corner: the largest radius on the film, mm of the lens. unit: Blender units per mm. Beyond
    the radius at which all rays are stopped there is nothing to measure, and ``corner`` is that radius.
    """
    paraxial, depth = abs(optics.exit_pupil[1]) * radius, pupil.focus / unit
    is_round = pupil.blades < 3 and pupil.ratio == 1
    if is_round:
        side = np.linspace(-TRIED, TRIED, GRID)
        point = side[None, :], side[:, None]
    else:
        side = (np.arange(GRID) + 0.5) / GRID
        point = tuple(part / pupil.radius for part in pupil.points(side[None, :], side[:, None]))
    squared = point[0] ** 2 + point[1] ** 2
    plane = optics.exit_pupil[0]
    pupil = replace(pupil, plane=plane, disc=paraxial, stop_radius=radius if is_round else np.inf)
    with np.errstate(all="ignore"):
        for _ in range(NARROWED):
            r = np.linspace(0.0, corner, RADII)[:, None, None]
            origin, direction = from_film(optics, film, chief, pupil, r, 0.0 * r, point)
            passes = np.isfinite(direction[0]) & np.isfinite(origin[0])
            dark = int(np.flatnonzero(passes.any(axis=(1, 2))).max(initial=0)) + 1
            if dark > RADII // 2:
                break
            corner = float(r[dark, 0, 0])
        disc = float(np.sqrt(np.where(passes, squared, 0.0).max(initial=0.0))) + SLACK if is_round else 1.0
        within = squared <= disc * disc if is_round else np.full(squared.shape, True)
        share = (passes & within).sum(axis=(1, 2)) / within.sum()
        wide = (paraxial / (film - plane)) ** 2
        if is_round:  # on the axis what passes is a disc, and its share is known to rounding
            marginal = _marginal(optics, film, chief, pupil) ** 2
            share[0], cosine = min(marginal / disc**2, 1.0), 1 / (1 + wide * marginal)
        else:
            cosine = float((passes[0] / (1 + wide * squared) ** 2).sum() / max(passes[0].sum(), 1))
        r = np.minimum(r, chief.end * (1 - 1e-9))
        height, place, tangent = chief.at(r * r)
        turn = 2 / (1 + tangent * tangent * r * r)
        ahead = r * tangent * turn, 0.0, 1 - turn
        off = tuple(o - c for o, c in zip(origin, (r * height, 0.0, place), strict=True))
        way = sum(o * d for o, d in zip(off, direction, strict=True))
        off = tuple(o - way * d for o, d in zip(off, direction, strict=True))
        sharp = np.maximum(depth + place - optics.entrance_pupil[0], LEVEL * depth) / np.maximum(turn - 1, LEVEL)
        there = tuple(o / sharp + d - u for o, d, u in zip(off, direction, ahead, strict=True))
        lines, spread = (MARGIN * np.where(passes & within, norm(part), 0.0).max(axis=(1, 2)) for part in (off, there))
        apart, spread = float(lines.max()), np.maximum.accumulate(spread)
        angles = np.arccos(np.clip(turn - 1, -1.0, 1.0)).ravel()
        reach = float(np.hypot(r * height, place - optics.entrance_pupil[0]).max()) + apart
    return replace(
        pupil, disc=disc * paraxial, passing=tuple(share.tolist()), cosine=float(cosine), corner=corner,
        apart=apart * unit, spread=tuple(spread.tolist()), angles=tuple(angles.tolist()),
        sharp=(float(sharp.min()) * unit, float(sharp.max()) * unit), reach=reach * unit,
    )  # fmt: skip


def _marginal(optics: Optics, film: float, chief: ChiefRays, pupil: Pupil) -> float:
    """Return the largest radius in the exit pupil, over the disc's, of rays that pass from the film's center."""
    low, high, zero = 0.0, TRIED, np.zeros(1)
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        passes = np.isfinite(from_film(optics, film, chief, pupil, zero, zero, (zero + middle, zero))[1][0])[0]
        low, high = (middle, high) if passes else (low, middle)
    return low


def light_of(film: float, chief: ChiefRays, pupil: Pupil, place, point, falls_off: bool, vignetting: bool):
    """Return the light of rays that pass, relative to the mean of the middle of the picture; arguments as in
    ``from_film``. Without ``vignetting`` the rays that pass make up for those that do not.
    """
    distance = film - pupil.plane
    squared, value = place[0] * place[0] + place[1] * place[1], 1.0
    if falls_off:
        crossing = chief.crossing(squared)
        beside = [part - part * crossing + pupil.disc * own for part, own in zip(place, point, strict=True)]
        cosine = distance * distance / (distance * distance + beside[0] * beside[0] + beside[1] * beside[1])
        value = cosine * cosine / pupil.cosine
    if vignetting:
        return value / max(pupil.passing[0], FEWEST)
    table = np.maximum(np.array(pupil.passing), FEWEST)
    row = np.minimum(np.sqrt(squared) * ((RADII - 1) / pupil.corner), RADII - 1 - 1e-6)
    first = np.floor(row)
    low, high = (look_up(table, as_index(first + k)) for k in (0, 1))
    return value / (low + (row - first) * (high - low))


def as_index(number):
    """Return whole numbers in the type of an index, for ``look_up``."""
    return number if is_recorded(number) else np.nan_to_num(np.asarray(number)).astype(np.intp)
