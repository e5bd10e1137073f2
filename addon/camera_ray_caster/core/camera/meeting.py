"""The pixels that see points at the pixels' own times: where the times of a moving camera and the points' images agree.

The image of a point is approximated by a polynomial of the frame, piece by piece. It is fitted at a few nodes of each
piece; if its last coefficients have not decreased to rounding, the piece is halved.
Reference: L. Trefethen, Approximation Theory and Approximation Practice (2013), chapters 3, 8 and 18.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.polynomial.chebyshev import chebpts2, chebval, chebvander

from .times import ImageTime, LinearTime, PixelTime, SweepTime

NODES = chebpts2(12)
"""Nodes of a piece, from -1 to 1."""

FIT = np.linalg.inv(chebvander(NODES, len(NODES) - 1))

PLACES = np.linspace(-1, 1, 65)
"""Places in a piece, from -1 to 1, between which the polynomials are searched for a change of sign."""

RESOLVED = 1e-10, 1e-13
"""Bound of the last coefficients of a resolved piece: in pixels, plus a fraction of the largest coordinate."""

LONGEST_PIECE = 1 / 6
"""Fraction of the time range: longer unresolved pieces are halved even if no sign of an agreement is seen in them."""

SHORTEST = 2.0**-14
"""Fraction of the time range at which halving ends: less than a row."""

HALVINGS = 54
"""Number of halvings of an interval with a root, until no number lies within it."""

Project = Callable[[float, np.ndarray], np.ndarray]
"""Given a frame and the indices (k,) of points, the pixels (k, 2) at which the camera of that frame sees them then."""


def meeting(
    pixel_time: PixelTime,
    project: Project,
    count: int,
    cuts: Iterable[float] = (),
    around: float | None = None,
    is_still: bool = False,
) -> np.ndarray:
    """Return the pixels (count, 2) that see points at the pixels' own times: of several pixels the earliest, NaN if no
    pixel does. ``cuts``: frames at which motion may change abruptly. ``around``: a frame; the interval between the cuts
    around it is searched first, so that a pixel with a time in that interval is preferred. ``is_still``: whether
    ``project`` gives the same at all frames, so that nothing is searched.

    The error is at most RESOLVED, except near abrupt changes that are not in ``cuts``, where it is that of SHORTEST. A
    point whose image agrees with the pixels' times twice within 1/64 of a piece may be missed. For an ImageTime the
    frames of the image are tried one by one.
    """
    result, everyone = np.full((count, 2), np.nan), np.arange(count)
    with np.errstate(invalid="ignore"):  # NaN means not seen
        if isinstance(pixel_time, ImageTime):
            for frame in np.unique(pixel_time.frames).tolist():
                left = everyone[np.isnan(result[:, 0])]
                pixels = project(frame, left)
                seen = np.flatnonzero(~np.isnan(pixels).any(axis=1))
                seen = seen[pixel_time.frame_at(*pixels[seen].T) == frame]
                result[left[seen]] = pixels[seen]
            return result
        first, last = pixel_time.span
        if is_still:
            pixels = project(first, everyone)
            time = pixel_time.frame_at(*pixels.T)
            return np.where(((first <= time) & (time <= last))[:, None], pixels, np.nan)
        search = _Search(pixel_time, project, last - first)
        pieces = list(pairwise([first, *sorted({cut for cut in cuts if first < cut < last}), last]))
        if around is not None:
            pieces.sort(key=lambda ends: max(ends[0] - around, around - ends[1]))
        for a, b in pieces:
            left = everyone[np.isnan(result[:, 0])]
            if left.size:
                result[left] = search.within(a, b, left)
    return result


@dataclass(frozen=True)
class _Search:
    clock: LinearTime | SweepTime
    project: Project
    length: float
    """Length of the time range in frames."""

    def within(self, a: float, b: float, indices: np.ndarray) -> np.ndarray:
        """Return the pixels (k, 2) of points whose images agree with the clock between two frames; else NaN."""
        result = np.full((len(indices), 2), np.nan)
        middle, half = (a + b) / 2, (b - a) / 2
        pixels = np.stack([self.project(middle + half * node, indices) for node in NODES.tolist()])
        series = np.tensordot(FIT, pixels - pixels[:1], 1)
        size = np.abs(pixels).max(axis=(0, 2))
        clear = np.abs(series[-2:]).max(axis=(0, 2)) <= RESOLVED[0] + RESOLVED[1] * size
        late = self._late(pixels, middle + half * NODES[:, None])
        if clear.any():
            result[clear] = self._root(middle, half, series[:, clear], pixels[0, clear])
        if b - a <= SHORTEST * self.length:
            change = (late[:-1] * late[1:] <= 0) & ~clear
            at = np.flatnonzero(change.any(axis=0))
            k = change[:, at].argmax(axis=0)
            before, after = late[k, at], late[k + 1, at]
            share = np.where(before == after, 0.0, before / (before - after))[:, None]
            result[at] = (1 - share) * pixels[k, at] + share * pixels[k + 1, at]
            return result
        unclear = ~clear
        if b - a <= LONGEST_PIECE * self.length:
            unclear &= (np.fmin.reduce(late) <= 0) & (np.fmax.reduce(late) >= 0)
        for ends in ((a, middle), (middle, b)):
            left = np.flatnonzero(unclear & np.isnan(result[:, 0]))
            if left.size:
                result[left] = self.within(*ends, indices[left])
        return result

    def _late(self, pixels: np.ndarray, frame) -> np.ndarray:
        """Return the times of pixels (..., 2) minus ``frame``."""
        return self.clock.frame_at(pixels[..., 0], pixels[..., 1]) - frame

    def _root(self, middle: float, half: float, series: np.ndarray, start: np.ndarray) -> np.ndarray:
        """Return the first pixels (k, 2) at which polynomial images agree with the clock; NaN if none does."""
        pixels = np.full(start.shape, np.nan)
        at_places = start + np.tensordot(chebvander(PLACES, len(series) - 1), series, 1)
        late = self._late(at_places, middle + half * PLACES[:, None])
        change = late[:-1] * late[1:] <= 0
        here = np.flatnonzero(change.any(axis=0))
        k = change[:, here].argmax(axis=0)
        low, high, rises = PLACES[k], PLACES[k + 1], (late[k, here] < 0) | (late[k + 1, here] > 0)
        series, start = series[:, here], start[here]
        for _ in range(HALVINGS):
            at = (low + high) / 2
            is_after = (self._late(_values(series, start, at), middle + half * at) >= 0) == rises
            low, high = np.where(is_after, low, at), np.where(is_after, at, high)
        pixels[here] = _values(series, start, high)
        return pixels


def _values(series: np.ndarray, start: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Return the values (k, 2) of polynomials at places (k,)."""
    return start + np.stack([chebval(at, series[..., axis], tensor=False) for axis in range(2)], axis=-1)
