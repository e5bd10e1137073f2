"""Visibility of points: whether they are in the picture, and not hidden by a shape."""

from dataclasses import dataclass
from enum import IntEnum
from typing import Any

import numpy as np

from ..arguments import keywords, number, numbers
from ..camera.camera import Camera
from ..conventions import gamma
from ..maths.vector import components, norm
from ..records import InputError, Shapes
from ..scene import Scene
from .seen_points import Picture


class Visibility(IntEnum):
    """The results of ``visible``; the numbers are those of COCO's key points."""

    OUTSIDE = 0
    """The point has no pixel in the full frame, or is nearer or farther than the clip range."""
    HIDDEN = 1
    """A shape is in front of the point."""
    SEEN = 2


@keywords
def visible(camera: Camera | Scene, shapes: Any = None, points=None, *, tolerance: float = 0.0) -> np.ndarray:
    """Return whether world points (..., 3) are seen, as numbers of ``Visibility``, (...) uint8.

    camera, shapes: as in ``cast``; also ``visible(scene, points)``.
    A ray is cast to each point. The point is HIDDEN if a hit is nearer by more than the error bounds of both, so that a
    surface does not hide a point on it. ``tolerance`` is the largest error of the given points, in world units: a
    vertex that was rounded to float32 may lie inside its surface by 1e-7 of its coordinates.
    With pixel times the points stand still, and each is tested at the time of the pixel that sees it.
    Raises InputError for an array of another shape, and for a tolerance that is not a number or is negative;
    TypeError for a camera or shapes of another type.
    """
    scene, points = Scene.given_with(camera, shapes, points, "visible")
    points, tolerance = numbers(points, "points"), number(tolerance, "tolerance", np.inf)
    if points.shape[-1:] != (3,):
        raise InputError(f"points of shape {points.shape} cannot be tested: give x, y, z, shape (..., 3)")
    if tolerance < 0:
        raise InputError(f"tolerance is {tolerance:g}: it must be a length of 0 or more")
    each = points.reshape(-1, 3)
    picture = Picture(scene.camera, scene.shapes)
    with np.errstate(over="ignore"):  # a place whose length overflows has no pixel
        still = _Still(each, tolerance + gamma(2) * norm(components(each)))
    before = picture.before(still, picture.pixels(still, len(each)))
    result = np.array([Visibility.SEEN, Visibility.HIDDEN, Visibility.OUTSIDE], np.uint8)[before]
    return result.reshape(points.shape[:-1])


@dataclass(frozen=True)
class _Still:
    """Points that stand still: see ``pictures.MovingPoints``."""

    places: np.ndarray
    errors: np.ndarray

    def at(self, shapes: Shapes, indices: np.ndarray) -> np.ndarray:
        return self.places[indices]

    def error(self, shapes: Shapes, indices: np.ndarray) -> np.ndarray:
        return self.errors[indices]
