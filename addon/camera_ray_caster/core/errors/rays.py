"""Error bounds of the rays of a camera.

The lengths of error vectors are Euclidean. Like gamma(n) they are worst-case bounds of rounding, not averages.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..camera.camera import Camera
from ..conventions import gamma
from ..maths.vector import difference, matvec, norm
from ..shapes.frames import WorldRays

STEP = 2.0**-20
"""Move in pixels that measures how fast the rays turn; so small that it stays in the picture next to singular rims."""


def world_rays(camera: Camera, x: np.ndarray, y: np.ndarray) -> WorldRays:
    """Return the rays at pixel coordinates with error bounds: a model's rounding acts as a small move of the pixel.

    The effect of such a move on the ray is measured, for every model: near a singular place, such as the rim of a
    mirror ball, rays turn fast and errors grow.
    """
    x, y = np.asarray(x), np.asarray(y)
    here = camera.camera_rays(x, y)
    sides = STEP, -STEP
    beside = camera.camera_rays(np.add.outer(sides, x), y[None]), camera.camera_rays(x[None], np.add.outer(sides, y))
    pixels = camera.model.pixel_rounding(x, y)
    basis = camera.pose.basis.tolist()

    def moved(part: int) -> tuple[Any, Any]:
        """Return a vector in the world and its error bound."""
        error = (camera.stretch * camera.model.ray_rounding + gamma(8)) * norm(here[part])
        for there, rounding in zip(beside, pixels, strict=True):
            error = error + camera.stretch / STEP * rounding * _farthest(difference(there[part], here[part]))
        return matvec(basis, here[part]), error

    origin, origin_error = ((0.0, 0.0, 0.0), 0.0) if camera.model.central else moved(0)
    direction, direction_error = moved(1)
    return WorldRays(origin, direction, camera.length_of(here[1]), origin_error, direction_error)


def _farthest(moves) -> Any:
    """Return the greatest length along the first axis, without NaN; a row or a column stays one if possible."""
    lengths = norm([component if np.any(component) else 0.0 for component in moves])
    return np.fmax.reduce(lengths, axis=0) if np.ndim(lengths) else lengths
