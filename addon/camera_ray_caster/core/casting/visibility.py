"""Whether points are seen: in the picture, and with nothing before them."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from ..arguments import number, numbers
from ..camera.camera import Camera
from ..conventions import gamma
from ..maths.vector import components, norm
from ..records import InputError, Shapes
from .pictures import Picture


class Visibility(IntEnum):
    """What ``visible`` says of a point; COCO's numbers for key points."""

    OUTSIDE = 0
    """It has no pixel in the full frame, or is nearer or farther than the clip range."""
    HIDDEN = 1
    """A shape is before it."""
    SEEN = 2


def visible(camera: Camera, shapes: Shapes, points, tolerance: float = 0.0) -> np.ndarray:
    """Return whether world points (..., 3) are seen, as numbers of ``Visibility``, (...) uint8.

    A ray is cast to each point: it is HIDDEN where a hit is nearer by more than the error bounds of both, so that a
    point on a surface is not hidden by it. ``tolerance``: how far points may be from where they are meant, in world
    units: a vertex that was rounded to float32 may be 1e-7 of its coordinates inside of its surface.
    With pixel times points stand still, and are asked of at the time of the pixel that sees them.
    Raises InputError for an array of another shape, and for a tolerance that is no number from 0.
    """
    points, tolerance = numbers(points, "points"), number(tolerance, "tolerance", np.inf)
    if points.shape[-1:] != (3,):
        raise InputError(f"points of shape {points.shape} cannot be looked for: give x, y, z, shape (..., 3)")
    if tolerance < 0:
        raise InputError(f"tolerance is {tolerance:g}: it must be a length from 0")
    each = points.reshape(-1, 3)
    still, picture = _Still(each, tolerance + gamma(2) * norm(components(each))), Picture(camera, shapes)
    before = picture.before(still, picture.pixels(still, len(each)))
    found = np.array([Visibility.SEEN, Visibility.HIDDEN, Visibility.OUTSIDE], np.uint8)[before]
    return found.reshape(points.shape[:-1])


@dataclass(frozen=True)
class _Still:
    """Points that stand still: see ``pictures.Points``."""

    places: np.ndarray
    errors: np.ndarray

    def at(self, shapes: Shapes, some: np.ndarray) -> np.ndarray:
        return self.places[some]

    def error(self, shapes: Shapes, some: np.ndarray) -> np.ndarray:
        return self.errors[some]
