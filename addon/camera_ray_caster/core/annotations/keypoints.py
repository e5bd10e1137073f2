"""Key points: named places in the world, and where a picture shows them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..camera.camera import Camera
from ..casting.visibility import Visibility, visible
from ..conventions import EPS32
from ..maths.vector import components, norm
from ..records import Shapes

ROUNDING = 8 * EPS32
"""Of coordinates that are stored as float32, and turned by matrices that are."""


@dataclass(frozen=True)
class KeyPoint:
    """A named place."""

    name: str
    owner: str
    """The name of the object that it belongs to; "" for none."""
    place: tuple[float, float, float]
    """In the world."""


@dataclass(frozen=True)
class SeenKeyPoint:
    """A key point in a picture."""

    point: KeyPoint
    pixel: tuple[float, float] | None
    """Pixel coordinates in the full frame; None where it has none."""
    depth: float | None
    """What the depth pass would show of it."""
    visibility: Visibility


def seen_key_points(camera: Camera, shapes: Shapes, points: Sequence[KeyPoint]) -> list[SeenKeyPoint]:
    """Return where key points are seen. A point within ROUNDING of a surface is not hidden by it; one inside of a body
    is. ``visible`` says more.
    """
    places = np.array([point.place for point in points], float).reshape(-1, 3)
    pixels = camera.project(places)
    tolerance = ROUNDING * float(np.abs(places).max(initial=0.0))
    found = [Visibility(code) for code in visible(camera, shapes, places, tolerance).tolist()]
    rays = camera.rays_at(*pixels.T)
    result = []
    for k, point in enumerate(points):
        pixel, depth = None, None
        if not np.isnan(pixels[k]).any():
            pixel = (float(pixels[k, 0]), float(pixels[k, 1]))
            depth = float(norm(components(places[k] - rays.origins[k])))
            if camera.model.planar:
                there = camera if rays.time is None else camera.at(float(rays.time[k]))
                depth /= float(there.length_of(there.camera_rays(*pixels[k])[1]))
        result.append(SeenKeyPoint(point, pixel, depth, found[k]))
    return result
