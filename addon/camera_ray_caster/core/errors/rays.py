"""What rounding does to the rays of a camera.

All lengths of error vectors are Euclidean, in the manner of gamma(n): they hold for every rounding, not on average.
"""

from __future__ import annotations

import numpy as np

from ..camera.camera import Camera
from ..conventions import gamma
from ..maths.vector import difference, matvec, norm
from ..shapes.frames import WorldRays

STEP = 2.0**-20
"""Pixels by which a ray is moved to see how fast the picture's rays turn: beside singular rims still on the picture."""


def world_rays(camera: Camera, x: np.ndarray, y: np.ndarray) -> WorldRays:
    """Return the rays at pixel coordinates with their errors: a model's rounding is that of a slightly moved pixel.

    How far a moved pixel moves the ray is measured, whatever the model: near a singular place, as the rim of a mirror
    ball, rays turn fast and errors grow.
    """
    here = camera.camera_rays(x, y)
    moves = ((STEP, 0.0), (-STEP, 0.0)), ((0.0, STEP), (0.0, -STEP))
    moved = [[camera.camera_rays(x + dx, y + dy) for dx, dy in axis] for axis in moves]
    in_pixels = camera.model.pixel_rounding(x, y)
    basis = camera.pose.basis.tolist()
    parts = []
    for part in range(2):
        length = norm(here[part])
        error = (camera.stretch * camera.model.ray_rounding + gamma(8)) * length
        for pixels, there in zip(in_pixels, moved, strict=True):
            turned = np.fmax(*(_apart(rays[part], here[part]) for rays in there))
            error = error + camera.stretch / STEP * pixels * turned
        parts.append((matvec(basis, here[part]), error))
    return WorldRays(parts[0][0], parts[1][0], parts[0][1], parts[1][1])


def _apart(there, here):
    """Return the length of the difference; of a row or a column, where the other does not move."""
    moved = difference(there, here)
    return norm([component if np.any(component) else 0.0 for component in moved])
