"""A real lens as it stands before its film, and a pixel's rays through the glass: lines to draw, and the sine law.

All is traced from the film, surface by surface (``core.lenses.trace``), the way a renderer follows light backwards.
Points are in the camera's frame, in Blender units; segments are (n, 2, 3).
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ..cameras.real_lens import RealLens
from ..lenses.trace import LensSurface, trace
from ..maths.vector import cross, norm, unit
from .diagram import segments_of
from .formula import digits

ARC_POINTS, CIRCLE_POINTS = 33, 49
"""Points along a surface's section, and around a rim."""
FAN = np.linspace(-0.95, 0.95, 9)
"""Places of the rays of a fan across the exit pupil, in radii of the stop's image."""


@dataclass(frozen=True)
class LensDrawing:
    """Segments of the parts of a lens."""

    glass: np.ndarray
    stop: np.ndarray
    pupils: np.ndarray
    """Circles: the images of the stop that the scene and the film see, paraxial."""
    film: np.ndarray
    """The frame on the film, which is upside down there."""


@dataclass(frozen=True)
class Refraction:
    """A ray at a surface; angles to the normal in radians, on the scene's and on the film's side."""

    surface: int
    before: float
    behind: float
    in_front: float
    at_back: float


@dataclass(frozen=True)
class GlassPath:
    """A ray from the film through the lens."""

    points: np.ndarray
    """(n, 3), from the film to the front surface, or to the rim that stops the ray."""
    direction: np.ndarray | None
    """In front of the lens, (3,), away from it; None for a ray that is stopped."""
    refractions: tuple[Refraction, ...]
    """From the scene to the film."""


def lens_drawing(model: RealLens) -> LensDrawing:
    """Return the segments of a lens."""
    glass = [line for turn in (0.0, np.pi / 2) for line in sections(model, turn)]
    glass += [_circle(model, surface.z + surface.sag(rim * rim)[0], rim) for surface, rim in _rims(model)]
    stop, radius = model.optics.surfaces[model.optics.stop], float(model.radius)
    images = model.optics.entrance_pupil, model.optics.exit_pupil
    pupils = [_circle(model, z, abs(size) * radius) for z, size in images]
    corners = model.window.corners(model.size)
    a, b = np.vstack((corners, corners[:1])).T
    x, y, z = model.tilted.places(a, b, float(model.film))
    frame = np.stack((-x, -y, np.broadcast_to(z, x.shape)), axis=-1)  # upside down
    return LensDrawing(
        glass=np.concatenate([segments_of(line[None]) for line in glass]),
        stop=segments_of(np.stack([_circle(model, stop.z, size) for size in (radius, _reach(model))])),
        pupils=segments_of(np.stack(pupils)),
        film=segments_of(_placed(model, frame)[None]),
    )


def chief_path(model: RealLens, x: float, y: float) -> GlassPath:
    """Return the path of the chief ray of a pixel."""
    return _path(model, x, y, 0.0)


def fan_of(model: RealLens, x: float, y: float) -> list[GlassPath]:
    """Return rays of a pixel, in the plane through the axis, across the whole stop."""
    return [_path(model, x, y, share) for share in FAN.tolist()]


def refraction_lines(model: RealLens, x: float, y: float) -> Iterator[str]:
    """Yield a line for each surface that the chief ray of a pixel passes, with the sine law in numbers."""
    path, lens = chief_path(model, x, y), model.prescription
    for refraction in path.refractions:
        surface = model.optics.surfaces[refraction.surface]
        name = lens.in_words(refraction.surface) if lens else f"surface {refraction.surface + 1}"
        shape = f"radius {digits(1 / surface.curvature)} mm" if surface.curvature else "plane"
        sines = " = ".join(
            f"{digits(index)} sin {digits(np.degrees(angle))}°"
            for index, angle in ((refraction.before, refraction.in_front), (refraction.behind, refraction.at_back))
        )
        yield f"{name}, {shape}: {sines} = {digits(refraction.before * np.sin(refraction.in_front))}"
    if path.direction is None:
        yield "the ray is stopped by a rim: the pixel has no chief ray"


def _path(model: RealLens, x: float, y: float, share: float) -> GlassPath:
    """Return the path of a pixel's ray through a point of the exit pupil, in radii from the chief ray, away from the
    axis.
    """
    (across, upward, film), (a, b) = model.on_film(x, y)
    optics, film, radius = model.optics, float(film), np.hypot(a, b)
    plane, size = optics.exit_pupil
    crossing = float(model.chief.crossing(np.float64(radius * radius)))
    aside = share * abs(size) * float(model.radius)
    ways = (a / radius, b / radius) if radius else (0.0, 1.0)
    up = [-coordinate * crossing + aside * way for coordinate, way in zip((a, b), ways, strict=True)]
    sign = 1.0 if film > plane else -1.0
    point = -float(across), -float(upward), film
    direction = unit((sign * (up[0] - point[0]), sign * (up[1] - point[1]), sign * (plane - film)))
    points, refractions = [point], list[Refraction]()
    for index in range(len(optics.surfaces) - 1, -1, -1):
        surface = optics.surfaces[index]
        if index == optics.stop:
            surface = replace(surface, rim=float(model.radius))
        with np.errstate(all="ignore"):  # NaN: the surface is missed
            point, ahead = trace((surface,), point, direction, to_film=False)
        if not np.isfinite(point).all():
            return GlassPath(_placed(model, np.array(points)), None, tuple(refractions))
        points.append((float(point[0]), float(point[1]), float(point[2])))
        if not np.isfinite(ahead).all():
            return GlassPath(_placed(model, np.array(points)), None, tuple(refractions))
        if surface.before != surface.behind:
            normal = _normal(surface, points[-1])
            angles = (np.arcsin(min(float(norm(cross(ray, normal))), 1.0)) for ray in (ahead, direction))
            refractions.insert(0, Refraction(index, surface.before, surface.behind, *angles))
        direction = tuple(map(float, ahead))
    return GlassPath(_placed(model, np.array(points)), np.array(direction), tuple(refractions))


def _normal(surface: LensSurface, point):
    """Return the unit normal of a surface at a point, by its slope."""
    slope = surface.sag(point[0] ** 2 + point[1] ** 2)[1]
    return unit((-2 * slope * point[0], -2 * slope * point[1], 1.0))


def stop_lines(model: RealLens) -> list[np.ndarray]:
    """Return the two lines of the stop in the plane x = 0, from its opening outwards, (2, 3) each."""
    z, radius, reach = model.optics.surfaces[model.optics.stop].z, float(model.radius), _reach(model)
    outer = max(reach, 1.2 * radius)
    return [_placed(model, np.array([(0.0, side * radius, z), (0.0, side * outer, z)])) for side in (-1.0, 1.0)]


def film_line(model: RealLens, up: np.ndarray, radius: float) -> np.ndarray:
    """Return the line of the film in the plane of the axis and of an upright direction, (2, 3), turned to x = 0: of the
    frame in the image circle, and to a radius on the upright film.
    """
    corner = float(np.hypot(*model.window.corners(model.size).T).max())
    reach = max(radius, min(float(model.chief.rim), corner))
    line = []
    for side in (reach, -reach):
        x, y, z = model.tilted.places(*model.tilted.onto(model.chief, *(side * up)), float(model.film))
        line.append((0.0, -float(np.dot((x, y), up)), float(z)))
    return _placed(model, np.array(line))


def _reach(model: RealLens) -> float:
    """Return the radius of the tube: of the widest rim that is known."""
    rims = [surface.rim for surface in model.optics.surfaces if surface.rim < np.inf]
    return max(rims) if len(rims) > 1 else 2 * float(model.radius)


def _rims(model: RealLens) -> Iterator[tuple[LensSurface, float]]:
    """Yield the surfaces that refract, with their rims; what a surface can have, where its rim is not known."""
    for surface in model.optics.surfaces:
        if surface.before != surface.behind:
            widest = 0.9 / abs(surface.curvature) if surface.curvature else np.inf
            yield surface, surface.rim if surface.rim < np.inf else min(_reach(model), widest)


def sections(model: RealLens, turn: float) -> Iterator[np.ndarray]:
    """Yield the lines of the surfaces, and of the edges of the glass between them, in a plane through the axis."""
    ends: list[tuple[float, np.ndarray]] = []
    for surface, rim in _rims(model):
        height = np.linspace(-rim, rim, ARC_POINTS)
        line = _turned(height, surface.z + surface.sag(height * height)[0], turn)
        yield _placed(model, line)
        if ends and ends[-1][0] != 1.0:
            for end in (0, -1):
                yield _placed(model, np.stack((ends[-1][1][end], line[end])))
        ends.append((surface.behind, line))


def _turned(height, z, turn: float) -> np.ndarray:
    return np.stack((height * np.sin(turn), height * np.cos(turn), np.broadcast_to(z, height.shape)), axis=-1)


def _circle(model: RealLens, z: float, radius: float) -> np.ndarray:
    angle = np.linspace(0, 2 * np.pi, CIRCLE_POINTS)
    flat = radius * np.cos(angle), radius * np.sin(angle), np.full(CIRCLE_POINTS, float(z))
    return _placed(model, np.stack(flat, axis=-1))


def _placed(model: RealLens, points: np.ndarray) -> np.ndarray:
    """Return points (n, 3) of the lens, mm of its file, in the camera's frame."""
    return (points - (0.0, 0.0, float(model.pupil))) * float(model.unit)
