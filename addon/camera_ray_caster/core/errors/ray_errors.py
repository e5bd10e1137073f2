"""Error bounds of the rays of a camera.

The lengths of error vectors are Euclidean. Like gamma(n) they are worst-case bounds of rounding, not averages.
"""

from __future__ import annotations

from functools import reduce
from typing import Any

import numpy as np

from ..camera.camera import Camera
from ..conventions import gamma
from ..maths.vector import difference, matvec, norm
from ..shapes.shape_frames import WorldRays

RAY_SPACING = 2.0**-20
"""Move in pixels that measures how fast the rays turn; so small that it stays in the picture next to singular rims."""


def world_rays(camera: Camera, x: np.ndarray, y: np.ndarray) -> WorldRays:
    """Return the rays at pixel coordinates with error bounds: a model's rounding acts as a small move of the pixel.

    The effect of such a move on the ray is measured, for every model: near a singular place, such as the rim of a
    mirror ball, rays turn fast and errors grow. Within RAY_SPACING of a rim the effect is taken to grow with the move's
    square root, as at the rim of an orthographic fisheye, and to be the same along the rim as across it.
    """
    x, y = np.asarray(x), np.asarray(y)
    here = camera.camera_rays(x, y)
    sides = RAY_SPACING, -RAY_SPACING
    beside = camera.camera_rays(np.add.outer(sides, x), y[None]), camera.camera_rays(x[None], np.add.outer(sides, y))
    pixels = camera.model.pixel_rounding(x, y)
    further = camera.model.formula_rounding(x, y)
    basis = camera.pose.basis.tolist()

    def moved(index: int) -> tuple[Any, Any]:
        """Return a vector in the world and its error bound."""
        length = norm(here[index])
        rounded = (camera.stretch * camera.model.ray_rounding + gamma(8)) * length
        rounded = rounded + camera.stretch * further[index] * (length if index else 1.0)
        moves = [_lengths(difference(there[index], here[index])) for there in beside]
        farthest = [np.fmax.reduce(lengths, axis=0) if np.ndim(lengths) else lengths for lengths in moves]
        shares = [rounding / RAY_SPACING for rounding in pixels]
        error = rounded + camera.stretch * sum(share * length for share, length in zip(shares, farthest, strict=True))
        at_rim = reduce(np.logical_or, (np.isnan(lengths).any(axis=0) for lengths in moves if np.ndim(lengths)), False)
        if np.any(at_rim):  # there a ray may turn with the square root of a move, and an axis may have no neighbor
            largest_share = sum(np.maximum(share, np.sqrt(share)) for share in shares)
            worst = np.fmax(*farthest)
            worst = np.where(np.isnan(worst), np.inf, worst)
            error = np.where(at_rim, rounded + camera.stretch * largest_share * worst, error)
        return matvec(basis, here[index]), error

    origin, origin_error = ((0.0, 0.0, 0.0), 0.0) if camera.model.central else moved(0)
    direction, direction_error = moved(1)
    return WorldRays(origin, direction, camera.length_of(here[1]), origin_error, direction_error)


def _lengths(moves) -> Any:
    """Return the lengths of vectors; those of a row or a column stay one if possible."""
    return norm([component if np.any(component) else 0.0 for component in moves])
