"""The aperture of a real lens: the rays of a film point through the whole stop, traced through every surface.

A disc in the plane of the paraxial exit pupil, around the point where the pixel's chief ray crosses it, holds all rays
that pass. Rays in whose way the stop or a rim stands carry no light: that loss is the vignetting. The light of a ray is
in proportion to cos^4 of its angle to the axis at the film, relative to the middle of the picture.
References: C. Kolb, D. Mitchell, P. Hanrahan, A Realistic Camera Model for Computer Graphics (1995).
"""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ...lenses.chief import ChiefRays
from ...lenses.optics import Optics, bisected
from ...lenses.trace import LensSurface, trace
from ...maths.recording import is_recorded, look_up
from .traced_aperture import TracedAperture, lines

RADII = 25
"""Radii on the film, from the axis to the end of the picture, at which the disc is tried."""

GRID_POINTS = 65
"""Points along the side of a square in which the disc is tried."""

TRIED = 1.5
"""Half the side of that square over the radius of the paraxial exit pupil: six lenses need 0.98 to 1.1."""

DISC_MARGIN = 2.0 * TRIED / (GRID_POINTS - 1)
"""What the disc is wider than the farthest point that passes, in paraxial radii: the grid's step."""

NARROWED = 8
"""Largest number of times that the picture's end is moved to where light ends, if that is less than half of it."""

LEAST_SHARE = 1 / 64
"""Smallest share of passing rays by which light is divided, where vignetting is switched off."""


@dataclass(frozen=True)
class Pupil(TracedAperture):
    """The entrance pupil as an ``Aperture``, and the disc in the exit pupil."""

    plane: float = 0.0
    """z of the paraxial exit pupil in the lens frame, mm of the lens."""
    away: float = 1.0
    """Distance from there to the film on the axis, mm of the lens."""
    disc: float = 0.0
    """Radius of the disc there, mm of the lens."""
    stop_radius: float = np.inf
    """Radius of the stop, mm of the lens; inf if the points have its shape."""
    passing: tuple[float, ...] = ()
    """Share of the disc that passes, by the radius on the film in even steps from 0 to ``corner``."""
    cosine: float = 1.0
    """Mean of the falloff of the rays that pass on the axis; see ``_falloff``."""
    corner: float = np.inf
    """Radius on the film to which ``passing`` goes, mm of the lens."""
    colors: tuple[tuple[float, ...], ...] = ()
    """Indices of red, green and blue light before the lens and behind each surface; empty if they are not traced apart.
    """


def color_of(x, y):
    """Return a number from 0 to 3 for samples at pixel coordinates: below 1 they are red, below 2 green. It changes by
    an irrational number from sample to sample of a pixel, which spreads them evenly.
    """
    phase = 7.236 * x + 5.412 * y
    return 3 * (phase - np.floor(phase))


def of_color(color, values):
    """Return that of three numbers which belongs to the color of each ray."""
    red, green, blue = values
    return red if red == green == blue else np.where(color < 1, red, np.where(color < 2, green, blue))


def from_film(optics: Optics, chief: ChiefRays, pupil: Pupil, film_point, upright, point, color=None):
    """Return origin and direction of rays before the lens, in the lens frame.

    film_point: of the picture, x and y upright and z in the lens frame, mm of the lens. upright: where its chief
    ray meets the upright film. point: of the unit disc. color: as of ``color_of``; None for the wavelength of
    ``optics``. NaN in the direction's x of rays that do not pass.
    """
    (x, y, z), plane = film_point, pupil.plane
    across, up = _in_pupil(chief, pupil, upright, point)
    side = 1.0 if pupil.away > 0 else -1.0
    direction = side * (across + x), side * (up + y), side * (plane - z)
    length = np.sqrt(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2])
    dx, dy, dz = (component / length for component in direction)
    return trace(_surfaces(optics, pupil, color)[::-1], (-x, -y, z), (dx, dy, dz), to_film=False)


def _in_pupil(chief: ChiefRays, pupil: Pupil, upright, point):
    """Return the place in the plane of the exit pupil of points of the unit disc."""
    crossing = chief.crossing(upright[0] * upright[0] + upright[1] * upright[1])
    return tuple(-coordinate * crossing + pupil.disc * aside for coordinate, aside in zip(upright, point, strict=True))


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
    optics: Optics, chief: ChiefRays, pupil: Pupil, radius: float, unit: float, corner: float, film: float, places
) -> Pupil:
    """Return a pupil with its disc, the shares that pass and the spread, by tracing a grid at RADII radii, and at some
    places of a tilted film.

    radius: of the stop, and corner: the largest radius on the film, mm of the lens. unit: Blender units per mm. Beyond
    the radius at which all rays are stopped there is nothing to measure, and ``corner`` is that radius. film: its z on
    the axis. places: None, or points of a tilted film as ``from_film`` takes them, (n,) each.
    """
    paraxial = abs(optics.exit_pupil[1]) * radius
    is_round = pupil.blades < 3 and pupil.ratio == 1
    if is_round:
        side = np.linspace(-TRIED, TRIED, GRID_POINTS)
        point = side[None, :], side[:, None]
    else:
        side = (np.arange(GRID_POINTS) + 0.5) / GRID_POINTS
        point = tuple(coordinate / pupil.radius for coordinate in pupil.points(side[None, :], side[:, None]))
    squared = point[0] ** 2 + point[1] ** 2
    plane = optics.exit_pupil[0]
    stop = radius if is_round else np.inf
    pupil = replace(pupil, plane=plane, away=film - plane, disc=paraxial, stop_radius=stop)
    with np.errstate(all="ignore"):
        for _ in range(NARROWED):
            r = np.linspace(0.0, corner, RADII)[:, None, None]
            upright = r, 0.0 * r
            origin, direction = from_film(optics, chief, pupil, (*upright, film), upright, point)
            passes = np.isfinite(direction[0]) & np.isfinite(origin[0])
            dark = int(np.flatnonzero(passes.any(axis=(1, 2))).max(initial=0)) + 1
            if dark > RADII // 2:
                break
            corner = float(r[dark, 0, 0])
        share, middle = passes, passes[0]
        if places is not None:
            film_point, at = ([coordinate[:, None, None] for coordinate in each] for each in places)
            upright = at[0], at[1]
            origin, direction = from_film(optics, chief, pupil, film_point, upright, point)
            passes = np.isfinite(direction[0]) & np.isfinite(origin[0])
        widest = max(float(np.where(each, squared, 0.0).max(initial=0.0)) for each in (share, passes))
        disc = float(np.sqrt(widest)) + DISC_MARGIN if is_round else 1.0
        within = squared <= disc * disc if is_round else np.full(squared.shape, True)
        share = (share & within).sum(axis=(1, 2)) / within.sum()
        wide = (paraxial / (film - plane)) ** 2
        if is_round:  # on the axis what passes is a disc, and its share is known to rounding
            marginal = _marginal(optics, chief, pupil, film) ** 2
            share[0], cosine = min(marginal / disc**2, 1.0), 1 / (1 + wide * marginal)
        else:
            cosine = float((middle / (1 + wide * squared) ** 2).sum() / max(middle.sum(), 1))
        apart, sharp, spread, angles, reach = _lines(chief, optics, origin, direction, upright, passes & within)
    return replace(
        pupil, disc=disc * paraxial, passing=tuple(share.tolist()), cosine=float(cosine), corner=corner,
        apart=tuple((apart * unit).tolist()), sharp=tuple((sharp / unit).tolist()), spread=tuple(spread.tolist()),
        angles=() if places else tuple(angles.tolist()), reach=reach * unit,
    )  # fmt: skip


def _lines(chief: ChiefRays, optics: Optics, origin, direction, upright, passes):
    """Return what bounds the blur of rays that pass, (n, ...), of points of the upright film, and the angles of their
    chief rays, (n,), and how far from the eye rays begin, in mm: see ``Pupil``.
    """
    r = np.sqrt(upright[0] ** 2 + upright[1] ** 2)
    kept = np.minimum(r, chief.end * (1 - 1e-9)) / np.where(r > 0, r, 1.0)
    a, b = (coordinate * kept for coordinate in upright)
    squared = a * a + b * b
    height, front, tangent = chief.at(squared)
    turn = 2 / (1 + tangent * tangent * squared)
    ahead = a * tangent * turn, b * tangent * turn, 1 - turn
    apart, sharp, spread = lines(((a * height, b * height, front), ahead), origin, direction, passes)
    angles = np.arccos(np.clip(turn - 1, -1.0, 1.0)).ravel()
    reach = float(np.hypot(np.sqrt(squared) * height, front - optics.entrance_pupil[0]).max() + apart.max())
    return apart, sharp, spread, angles, reach


def _marginal(optics: Optics, chief: ChiefRays, pupil: Pupil, film: float) -> float:
    """Return the largest radius in the exit pupil, over the disc's, of rays that pass from the film's center."""
    zero = np.zeros(1)

    def passes(radius):
        return np.isfinite(from_film(optics, chief, pupil, (zero, zero, film), (zero, zero), (radius, zero))[1][0])

    return bisected(passes, 0.0, TRIED)


def _falloff(pupil: Pupil, film_point, target, normal):
    """Return the light of rays from the film to the exit pupil over that of one on the axis: cos^3 of their angle to
    the axis, times the cosine to the film's normal over that of the axis; on an upright film cos^4.
    """
    (a, b, c), (across, up) = film_point, target
    x, y, z = a + across, b + up, c - pupil.plane  # the film is upside down
    squared, before = z * z + x * x + y * y, pupil.away * pupil.away
    along = z + (x * normal[0] + y * normal[1]) / normal[2] if normal[0] or normal[1] else z
    return before * (z * along) / (squared * squared)


def light_of(chief: ChiefRays, pupil: Pupil, film_point, upright, point, normal, falls_off: bool, vignetting: bool):
    """Return the light of rays that pass, relative to the mean of the middle of the picture; arguments as in
    ``from_film``, and the film's normal. Without ``vignetting`` the rays that pass make up for those that do
    not, as far as they do so where the film is upright.
    """
    value = 1.0
    if falls_off:
        value = _falloff(pupil, film_point, _in_pupil(chief, pupil, upright, point), normal) / pupil.cosine
    if vignetting:
        return value / max(pupil.passing[0], LEAST_SHARE)
    table = np.maximum(np.array(pupil.passing), LEAST_SHARE)
    squared = upright[0] * upright[0] + upright[1] * upright[1]
    row = np.minimum(np.sqrt(squared) * ((RADII - 1) / pupil.corner), RADII - 1 - 1e-6)
    first = np.floor(row)
    low, high = (look_up(table, as_index(first + k)) for k in (0, 1))
    return value / (low + (row - first) * (high - low))


def as_index(number):
    """Return whole numbers in the type of an index, for ``look_up``."""
    return number if is_recorded(number) else np.nan_to_num(np.asarray(number)).astype(np.intp)
