"""Key points: named places in the world, and their pixels in a picture."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..camera.camera import Camera
from ..casting.visibility import Visibility, visible
from ..conventions import EPS32
from ..maths.vector import components, norm
from ..records import Shapes

PLACE_ROUNDING = 8 * EPS32
"""Relative rounding of coordinates that are stored as float32 and transformed by float32 matrices."""


@dataclass(frozen=True)
class KeyPoint:
    """A named place in the world."""

    name: str
    owner: str
    """Name of the object that the key point belongs to; "" for none."""
    position: tuple[float, float, float]
    """World coordinates."""


@dataclass(frozen=True)
class SeenKeyPoint:
    """A key point in a picture."""

    point: KeyPoint
    pixel: tuple[float, float] | None
    """Pixel coordinates in the full frame; None if the key point has none."""
    depth: float | None
    """Depth as in the depth pass; None without a pixel."""
    visibility: Visibility


def seen_key_points(camera: Camera, shapes: Shapes, points: Sequence[KeyPoint]) -> list[SeenKeyPoint]:
    """Return key points with their pixels, depths and visibility; outside of the render window they are OUTSIDE.

    A surface does not hide a point within PLACE_ROUNDING of it; a point inside of a body is hidden. See ``visible``.
    """
    places = np.array([point.position for point in points], float).reshape(-1, 3)
    pixels = camera.project(places)
    tolerance = PLACE_ROUNDING * float(np.abs(places).max(initial=0.0))
    visibility = [Visibility(code) for code in visible(camera, shapes, places, tolerance=tolerance).tolist()]
    rays, raster = camera.rays_at(*pixels.T), camera.raster
    low, high = (raster.x0, raster.y0), (raster.x1, raster.y1)
    is_inside = ((pixels >= low) & (pixels <= high)).all(axis=1)
    result = []
    for k, point in enumerate(points):
        pixel, depth = None, None
        if not np.isnan(pixels[k]).any():
            pixel = (float(pixels[k, 0]), float(pixels[k, 1]))
            depth = float(norm(components(places[k] - rays.origins[k])))
            if camera.model.planar:
                there = camera if rays.time is None else camera.at(float(rays.time[k]))
                depth /= float(there.length_of(there.camera_rays(*pixels[k])[1]))
        result.append(SeenKeyPoint(point, pixel, depth, visibility[k] if is_inside[k] else Visibility.OUTSIDE))
    return result
