"""A quick test whether rays may meet bounding balls: a quarter of the time of the exact test of a sphere."""

from typing import Any

import numpy as np

from ..maths.speed import Scratch, taken
from ..maths.vector import inner, norm
from .tree import BOX_MARGIN

SAFE_LENGTHS = 1e-150, 1e150
"""Lengths of directions between which their squares are neither rounded to 0 nor infinite."""


def unit_directions(direction: np.ndarray) -> np.ndarray:
    """Return directions (3, n) with length 1; NaN for those that are too short or too long to square."""
    length = norm(direction)
    length[~((length > SAFE_LENGTHS[0]) & (length < SAFE_LENGTHS[1]))] = np.nan
    return direction / length


def may_meet(middle: Any, radius: Any, origin: Any, ahead: np.ndarray, scratch: Scratch) -> np.ndarray:
    """Return whether rays may meet balls, (n,) bool, given middles and origins as three components, numbers or (n,)
    each, and unit directions (3, n). Balls are enlarged by BOX_MARGIN of radius and distance. NaN may meet all.
    """
    shape = ahead.shape[1:]
    along, beyond, spare = (scratch(name, shape) for name in ("along", "beyond", "spare"))
    pairs = [(m, o, np.broadcast_shapes(np.shape(m), np.shape(o))) for m, o in zip(middle, origin, strict=True)]
    to = [np.subtract(m, o, out=scratch(f"to {i}", size)) for i, (m, o, size) in enumerate(pairs)]
    inner(to, ahead, along, spare)
    np.multiply(np.maximum(along, 0.0, out=along), along, out=along)
    np.multiply(inner(to, to, beyond, spare), 1 - BOX_MARGIN, out=beyond)
    np.subtract(beyond, (1 + BOX_MARGIN) * radius * radius, out=beyond)
    return ~(beyond > along)


def pairs_may_meet(
    middles: np.ndarray, radii: np.ndarray, ball: np.ndarray, origin: np.ndarray, ahead: np.ndarray, ray: np.ndarray,
    scratch: Scratch,
) -> np.ndarray:  # fmt: skip
    """Return what ``may_meet`` does of pairs of balls (3, n), (n,) and rays (3, m), each by index, (k,); ``origin`` may
    be one of all rays, (3,).
    """
    start = origin if origin.ndim == 1 else taken(origin, ray)
    return may_meet(taken(middles, ball), taken(radii, ball), start, taken(ahead, ray), scratch)
