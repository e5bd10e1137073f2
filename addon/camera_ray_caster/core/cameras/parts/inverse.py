"""The numerical inverse of any model's rays: from a point to the pixel whose ray passes through it.

The rays of a lattice of pixels give the starting points. The Gauss-Newton method brings the angle between a ray and the
direction from its origin to the point down to rounding. Its derivatives are differences of rays, so that a model only
has to define its rays.
Reference: J. Nocedal and S. Wright, Numerical Optimization, 2nd ed. (2006), section 10.3.
"""

from collections.abc import Callable

import numpy as np

from ...conventions import EPS
from ...maths.vector import stacked

LATTICE = 33
"""Pixels per side of the lattice. No point is lost if rays of adjacent lattice pixels differ by under half a turn."""

STARTS = 3
"""Number of lattice pixels from which each point is sought: the best of the local minima of the angle."""

DIFFERENCE_STEP = 2.0**-12
"""Offset in pixels of the finite differences: derivatives are right to about EPS over it, and its square."""

GAUSS_NEWTON_STEPS = 40
"""Maximum number of Gauss-Newton steps. A smooth model takes about six."""

HALVINGS = 12
"""Maximum number of halvings of a step that does not bring the ray nearer, or leads to a pixel without a ray."""

MEETING_ANGLE = 64
"""Angle within which a ray meets a point, in units of EPS (1 + s): s is the sum of the distances of point and ray
origin from the frame's origin, over the distance between the two.
"""

AT_ONCE = 4096
"""Number of points sought together: their working arrays take some 100 MB."""


def pixels_of(rays: Callable, size: tuple[int, int], points, start=None) -> np.ndarray:
    """Return the pixel coordinates (..., 2) at which ``rays(x, y)`` pass through points (..., 3); NaN where none does.

    rays: a function like a model's, in the points' frame. size: width and height in pixels; a pixel beyond it may be
    found. If several pixels see a point, the result is the one nearest to the picture's middle, or the one to which the
    search from ``start`` (..., 2) leads. It is right to some EPS of angle over the angle from pixel to pixel.
    """
    points = np.asarray(points, np.float64)
    flat = points.reshape(-1, 3)
    starts = None if start is None else np.asarray(start, np.float64).reshape(-1, 1, 2)
    parts = [slice(first, first + AT_ONCE) for first in range(0, len(flat), AT_ONCE)]
    pixels = [_sought(rays, size, flat[block], None if starts is None else starts[block]) for block in parts]
    return np.concatenate([np.zeros((0, 2)), *pixels]).reshape(*points.shape[:-1], 2)


def _sought(rays, size, points, start) -> np.ndarray:
    """Return the pixels (n, 2) of points (n, 3), sought from ``start``: pixels (n, k, 2), or None for the lattice."""
    with np.errstate(all="ignore"):  # NaN and inf are valid results: no ray
        start = _starts(rays, size, points) if start is None else start
        targets = np.repeat(points[:, None], start.shape[1], axis=1)
        off, limit = _off(rays, start, targets)
        for _ in range(GAUSS_NEWTON_STEPS):
            step = _step(rays, start, targets, off)
            share = np.where(np.isfinite(step).all(axis=-1), 1.0, 0.0)[..., None]
            for _ in range(HALVINGS):
                near, _ = _off(rays, start - share * step, targets)
                worse = ~(_length(near) < _length(off))
                if not worse.any():
                    break
                share = np.where(worse[..., None], share / 2, share)
            better = ~worse[..., None]
            moved = np.where(better, share * step, 0.0)
            start, off = start - moved, np.where(better, near, off)
            if not (_length(moved) > 2 * EPS * _length(start)).any():
                break
        limit = _off(rays, start, targets)[1]
        middle = np.array(size) / 2
        away = np.where(_length(off) <= limit, _length(start - middle), np.inf)
        best = np.argmin(away, axis=1)[:, None]
        pixel = np.take_along_axis(start, best[..., None], axis=1)[:, 0]
        return np.where(np.isfinite(np.take_along_axis(away, best, axis=1)), pixel, np.nan)


def _starts(rays, size, points) -> np.ndarray:
    """Return pixels (n, STARTS, 2) of the lattice from which the points are sought."""
    x, y = np.meshgrid(*(np.linspace(0.5, side - 0.5, LATTICE) for side in size))
    pixels = np.stack((x, y), axis=-1)
    off = _length(_off(rays, pixels[None], points[:, None, None])[0])
    off = np.where(np.isnan(off), np.inf, off)
    padded = np.pad(off, ((0, 0), (1, 1), (1, 1)), constant_values=np.inf)
    around = [padded[:, 1 + j : 1 + j + LATTICE, 1 + i : 1 + i + LATTICE] for j in (-1, 0, 1) for i in (-1, 0, 1)]
    least = np.where(off <= np.minimum.reduce(around), off, np.inf).reshape(len(points), -1)
    order = np.argpartition(least, STARTS, axis=1)[:, :STARTS]
    return pixels.reshape(-1, 2)[order]


def _off(rays, pixels, points):
    """Return the differences (..., 3) of the rays' directions from the directions to the points, and their rounding."""
    origin, direction = rays(pixels[..., 0], pixels[..., 1])
    origin, direction = (stacked(vector, pixels.shape[:-1]) for vector in (origin, direction))
    towards = points - origin
    distance = _length(towards)[..., None]
    off = direction / _length(direction)[..., None] - towards / distance
    size = (_length(points) + _length(origin)) / distance[..., 0]
    return off, MEETING_ANGLE * EPS * (1 + size)


def _step(rays, pixels, points, off):
    """Return the Gauss-Newton step (..., 2)."""
    slopes = []
    for axis in np.eye(2):
        ahead, behind = (_off(rays, pixels + side * DIFFERENCE_STEP * axis, points)[0] for side in (1, -1))
        central = (ahead - behind) / (2 * DIFFERENCE_STEP)
        # at the rim only one side has rays
        one_sided = np.where(np.isnan(ahead), off - behind, ahead - off) / DIFFERENCE_STEP
        slopes.append(np.where(np.isnan(central), one_sided, central))
    (a, b), d = ([_dot(slope, slopes[0]) for slope in slopes]), _dot(slopes[1], slopes[1])
    right = [_dot(slope, off) for slope in slopes]
    volume = a * d - b * b
    return np.stack(((d * right[0] - b * right[1]) / volume, (a * right[1] - b * right[0]) / volume), axis=-1)


def _dot(left, right):
    return (left * right).sum(axis=-1)


def _length(vectors):
    return np.sqrt(_dot(vectors, vectors))
