"""What rounding does to the rays of a camera.

All lengths of error vectors are Euclidean, in the manner of gamma(n): they hold for every rounding, not on average.
"""

from __future__ import annotations

import numpy as np

from ..camera.camera import Camera
from ..conventions import gamma
from ..maths.vector import matvec, norm
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
    basis = camera.pose.basis.tolist()
    stretch = np.linalg.norm(camera.pose.basis, 2)
    in_pixels = camera.model.pixel_rounding(x, y)
    parts = []
    for part in range(2):
        error = camera.model.ray_rounding * norm(here[part])
        for axis in range(2):
            turned = [_moved(camera.camera_rays(x + dx, y + dy)[part], here[part]) for dx, dy in moves[axis]]
            error = error + in_pixels[axis] / STEP * np.fmax(*turned)
        parts.append((matvec(basis, here[part]), stretch * error + gamma(8) * norm(here[part])))
    return WorldRays(parts[0][0], parts[1][0], parts[0][1], parts[1][1])


def _moved(there, here):
    return norm(tuple(a - b for a, b in zip(there, here, strict=True)))
