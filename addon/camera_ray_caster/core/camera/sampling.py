"""Sample positions: the same in every run, and evenly spread for any number of samples.

They form the additive sequence of M. Roberts, The Unreasonable Effectiveness of Quasirandom Sequences (2018), whose
steps are powers of the plastic number. In the opening they are shifted by a hash of the pixel (Cranley and Patterson,
1976), so that the remaining error looks like fine noise and not like ghost images.
"""

from typing import Any

import numpy as np

STEP_2D = (0.7548776662466927, 0.5698402909980532)


def sub_pixel(sample: int) -> tuple[float, float]:
    """Return the offset of a sample from the pixel's center, in pixels, -1/2 .. 1/2 on both axes."""
    across, up = ((0.5 + step * sample) % 1.0 - 0.5 for step in STEP_2D)
    return across, up


def sampled(aperture: Any, x, y, sample: int) -> tuple[tuple[Any, Any], Any]:
    """Return the places of a sample in the pixels with the centers x, y, and its points of an ``Aperture``: None if
    there is no aperture.
    """
    off_x, off_y = sub_pixel(sample)
    return (x + off_x, y + off_y), None if aperture is None else aperture.points(*in_opening(sample, x, y))


def in_opening(sample: int, x, y):
    """Return u, v in [0, 1) for a sample of the pixels that hold the points x, y (broadcastable pixel coordinates)."""
    column, row = np.floor(x).astype(np.uint64), np.floor(y).astype(np.uint64)
    state = _scramble(column + (row << np.uint64(32)))
    shift_u = (state >> np.uint64(11)).astype(np.float64) * 2.0**-53
    shift_v = (_scramble(state) >> np.uint64(11)).astype(np.float64) * 2.0**-53
    return (shift_u + STEP_2D[0] * sample) % 1.0, (shift_v + STEP_2D[1] * sample) % 1.0


def _scramble(state):
    """Return the finalizer of SplitMix64 (Steele, Lea, Flood 2014): every bit depends on all bits."""
    with np.errstate(over="ignore"):
        state = state + np.uint64(0x9E3779B97F4A7C15)
        state = (state ^ (state >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
        state = (state ^ (state >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
        return state ^ (state >> np.uint64(31))
