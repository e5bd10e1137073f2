"""Accuracy of the rays of a camera's shader in Cycles' float32, compared with the camera's own rays."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ..camera.camera import Camera
from ..conventions import EPS32
from ..maths.vector import norm
from .camera_shader import ray_record
from .rounding import Rounded, rounded

RASTER = 4 * EPS32
"""Cycles' rounding of a place on the frame, 0 .. 1 with the shift added, as a fraction of the frame."""
WORLD = 16 * EPS32
"""Cycles' relative rounding when it normalizes a direction and transforms a ray to the world by a float32 matrix."""


class RayBounds(NamedTuple):
    """Error bounds for the chief rays of a shader, arrays in the shape of the pixels."""

    origin: np.ndarray
    """Largest error of the origin, Blender units in the world."""
    direction: np.ndarray
    """Largest error of the unit direction, radians; infinite where float32 leaves open whether there is a ray, NaN
    where there is certainly none.
    """


def ray_bounds(camera: Camera, x, y, shift: tuple[float, float]) -> RayBounds:
    """Return bounds of the differences between Cycles' rays through pixel coordinates and those of ``camera.rays_at``.

    shift: Cycles' shift of the raster; see ``camera_shader``. The bounds are of first order, for Cycles on a CPU.
    """
    x, y = np.broadcast_arrays(x, y)
    places = [
        Rounded(pixel, side * RASTER * (1 + np.abs(pixel / side + moved)) + 2 * EPS32 * np.abs(pixel))
        for pixel, side, moved in zip((x, y), camera.model.size, shift, strict=True)
    ]
    numbers = rounded(ray_record(replace(camera, aperture=None)), (*places, Rounded(0.0), Rounded(0.0)))
    origin, direction = numbers[:3], numbers[3:]
    errors = ([np.broadcast_to(component.error, x.shape) for component in vector] for vector in (origin, direction))
    off, turn = map(norm, errors)
    length = norm([component.value for component in direction])
    reach = norm([component.value for component in origin]) + np.abs(camera.pose.eye).sum()
    return RayBounds(off + WORLD * reach, np.where(np.isinf(off + turn), np.inf, turn / length + WORLD))
