"""The guard of every inverse: a pixel that ``Model.project`` returns is kept only if its ray passes through the point.

One evaluation of the rays tells most points apart. The few whose ray is off by more than rounding may still be right,
where a pixel's own rounding turns the ray, as at the rim of a mirror ball; otherwise Newton's method, with
the exact derivatives of the rays, starts at the pixel, and brings the ray to the point or finds none.
"""

import numpy as np

from ..cameras.model import Model
from ..conventions import EPS
from ..maths.vector import along, components, difference, dot, norm
from ..records import Pose
from .jacobian import RayDerivatives

MISS_DISTANCE = 256 * EPS
"""Distance by which a ray may miss a point, over the point's distance from the ray's origin: rounding of the point and
of the direction, and of the inverse, which amplifies it.
"""

MOVES = 16
"""A pixel may be off by this many times ``Model.pixel_rounding``, which states the rounding of one way, and EPS of its
coordinate; a ray by as many times ``Model.formula_rounding``.
"""

LARGEST_ANGLE = 2.0**-20
"""Angle that both may make up for at most: with more, rounding leaves the pixel no place."""

NEWTON_STEPS = 8
"""Number of Newton's steps: from a pixel that is almost right each step squares the error."""


def checked(model: Model, points: np.ndarray, pixels: np.ndarray, always: bool = False) -> np.ndarray:
    """Return the pixels (n, 2) that ``model.project`` found for points (n, 3) of the camera's frame; NaN where the
    model's own ray at the pixel does not pass through the point.
    """
    if not (model.guarded or always):
        return pixels
    off, distance, _ = _miss(model, points, *pixels.T)
    doubtful = ~(off <= MISS_DISTANCE * MISS_DISTANCE * distance)
    if doubtful.any():
        doubtful = np.flatnonzero(doubtful & ~np.isnan(pixels[:, 0]))
        point, pixel = points[doubtful], pixels[doubtful]
        wrong = ~_is_within_rounding(model, point, *pixel.T)
        if wrong.any():
            point = point[wrong]
            better = _nearer(model, point, pixel[wrong])
            pixel[wrong] = np.where(_is_within_rounding(model, point, *better.T)[:, None], better, np.nan)
        pixels[doubtful] = pixel
    return pixels


def _miss(model: Model, points, x, y):
    """Return the squared distances of points from the points as far along the rays at pixels, their squared distances
    from the rays' origins, and the origins. NaN without a ray.
    """
    origin, direction = model.rays(x, y)
    beside = components(points) if model.central else difference(components(points), origin)
    squared = dot(beside, beside)
    along = np.maximum(-beside[2], 0.0) if model.planar else np.sqrt(squared)
    off = [b - along * d for b, d in zip(beside, direction, strict=True)]
    return dot(off, off), squared, origin


def _is_within_rounding(model: Model, points, x, y):
    """Return whether rounding makes up for the distance between the points and the rays: of the point and the origin,
    and of the pixel, which moves by it.
    """
    off, squared, origin = _miss(model, points, x, y)
    distance = np.sqrt(squared)
    roundings = zip(model.pixel_rounding(x, y), (x, y), strict=True)
    move_x, move_y = (MOVES * (rounding + EPS * np.abs(coordinate)) for rounding, coordinate in roundings)
    moves = (move_x, 0.0), (-move_x, 0.0), (0.0, move_y), (0.0, -move_y)
    beside = [np.sqrt(_miss(model, points, x + across, y + up)[0]) for across, up in moves]
    turned = np.fmax.reduce([np.abs(other - np.sqrt(off)) for other in beside])
    moved, bent = model.formula_rounding(x, y)
    turned = 2 * turned + MOVES * (moved + bent * distance)
    return np.sqrt(off) <= MISS_DISTANCE * (distance + norm(origin)) + np.fmin(turned, LARGEST_ANGLE * distance)


def _nearer(model: Model, points, pixels):
    """Return pixels whose rays pass nearer to the points, by Newton's method from ``pixels``."""
    x, y = pixels.T
    point, itself = components(points), Pose(np.zeros(3), np.eye(3))
    with np.errstate(all="ignore"):  # NaN: the rays of a line of pixels meet the point
        for _ in range(NEWTON_STEPS):
            rays = RayDerivatives(model, itself, x, y)
            beside = difference(point, rays.origin)
            off = along(beside, rays.direction, -dot(beside, rays.direction) / dot(rays.direction, rays.direction))
            x, y = (coordinate + dot(by, off) for coordinate, by in zip((x, y), rays.by_point(point), strict=True))
    return np.stack((x, y), axis=-1)
