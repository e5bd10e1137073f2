"""A smooth function over rectangles of pixels: Chebyshev polynomials in x and y through its values at a few points.

They need some twenty products per pixel, however slow the function is. They are accurate if their last coefficients are
as small as rounding.
References: J. Boyd, Chebyshev and Fourier Spectral Methods, 2nd ed. (2001), chapters 2, 4 and 5; L. Trefethen,
Approximation Theory and Approximation Practice (2013), chapters 3 and 8.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.polynomial.chebyshev import chebvander

from ..conventions import EPS

POINTS = 16
"""Number of points along a panel's side, including its ends. With 14, rays of a strong barrel distortion took 1.5 times
as long, since more panels were quartered.
"""

PIECE = 45
"""Rows of a panel in one matrix product, whose size stays below 2^18: above, OpenBLAS starts threads of its own."""

TAIL = 2
"""Number of last coefficients that must be as small as rounding for a polynomial to be as accurate as its points."""

TERMS = POINTS - TAIL
"""Number of coefficients that are summed, along x or y."""

COEFFICIENT_ROUNDING = 4
"""Largest coefficient that counts as rounding, in EPS times a panel's largest value."""


@dataclass(frozen=True)
class Polynomials:
    """Polynomials that give a function's values in some panels of one size."""

    terms: np.ndarray
    """The coefficients, (count, panels, TERMS, TERMS), highest degrees first."""
    right: np.ndarray
    """Whether the polynomials are accurate all over the panel, (panels)."""
    empty: np.ndarray
    """Whether the function is NaN at all points of the panel, (panels)."""

    @classmethod
    def through(cls, function: Callable, x, y, size: tuple[int, int], counts: Sequence[int]) -> Polynomials:
        """Return the polynomials of panels with the corners x, y, (panels). ``counts``: number of values per vector."""
        x, y = x[:, None, None] + _places() * size[1], y[:, None, None] + _places()[:, None] * size[0]
        values = np.empty((sum(counts), len(x), POINTS, POINTS))
        for array, result in zip(values, function(x, y), strict=True):
            array[...] = result
        empty = np.isnan(values[0]).all(axis=(-2, -1))
        first = np.cumsum([0, *counts[:-1]])
        largest = np.maximum.reduceat(np.abs(values).max(axis=(-2, -1)), first)
        start = values[..., POINTS // 2, POINTS // 2].copy()
        values -= start[..., None, None]  # what is left is small, and so is the rounding of the sums
        upwards, across = _fit() @ values, values @ _fit()[:TAIL].T
        tails = (np.abs(coefficients).max(axis=(-2, -1)) for coefficients in (upwards[..., :TAIL, :], across))
        tail = np.maximum.reduceat(np.maximum(*tails), first)
        terms = upwards[..., TAIL:, :] @ _fit()[TAIL:].T
        terms[..., -1, -1] += start
        return cls(terms, (tail <= COEFFICIENT_ROUNDING * EPS * largest).all(axis=0), empty)

    def write(self, selected: slice, first: int, out: np.ndarray, pieces: slice) -> None:
        """Write values of ``selected`` panels into ``out``, (values, panels, rows, columns): of the function's values
        from index ``first`` on, in the given pieces of the panels' rows.
        """
        _, panels, rows, columns = out.shape
        sums = empty_like(out, (panels, TERMS, columns))
        for line, terms in zip(sums, self.terms[first:], strict=False):
            line[...] = terms[selected] @ _between(columns).T
        matrices = _as_matrices(out)
        matrices = matrices.reshape(*matrices.shape[:-2], rows // PIECE, PIECE, matrices.shape[-1])[..., pieces, :, :]
        parts = _between(rows).reshape(-1, PIECE, TERMS)[pieces]
        np.matmul(parts, _as_matrices(sums)[..., None, :, :], out=matrices)


def empty_like(values: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
    """Return an array (count, *shape) with the count of ``values``; its first axis is contiguous if theirs is."""
    if _are_side_by_side(values):
        return np.moveaxis(np.empty((*shape, len(values))), -1, 0)
    return np.empty((len(values), *shape))


def _are_side_by_side(values) -> bool:
    return values.strides[0] == values.itemsize


def _as_matrices(values):
    """View an array of ``empty_like`` as matrices with contiguous rows: one for each value, or one for all."""
    if not _are_side_by_side(values):
        return values
    last = np.moveaxis(values, 0, -1)
    return last.reshape(*last.shape[:-2], -1)


@cache
def _places() -> np.ndarray:
    """Return the Chebyshev points of the second kind, mapped to the range from 1 down to 0."""
    return (1 + np.cos(np.pi / (POINTS - 1) * np.arange(POINTS))) / 2


@cache
def _fit() -> np.ndarray:
    """Return the matrix that converts values at the points to coefficients, highest degrees first."""
    turns = np.outer(np.arange(POINTS), np.arange(POINTS)) % (2 * (POINTS - 1))  # full turns are removed exactly
    weight = np.where(np.arange(POINTS) % (POINTS - 1) == 0, 0.5, 1.0)
    return (np.cos(np.pi / (POINTS - 1) * turns) * weight * weight[:, None] * (2 / (POINTS - 1)))[::-1].copy()


@cache
def _between(pixels: int) -> np.ndarray:
    """Return the matrix that converts coefficients to values at a panel's pixel centers, (pixels, TERMS)."""
    return chebvander((2 * np.arange(pixels) + 1) / pixels - 1, TERMS - 1)[:, ::-1].copy()
