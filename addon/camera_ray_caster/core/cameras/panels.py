"""A smooth function on a grid of pixels, by Chebyshev polynomials of both variables, panel by panel.

The function is asked at few points of each panel, and the polynomials through them give the others: some ten products a
pixel, whatever the function takes. Where their coefficients have not sunk to rounding nothing is given.
References: J. Boyd, Chebyshev and Fourier Spectral Methods, 2nd ed. (2001), chapters 2, 4 and 5; L. Trefethen,
Approximation Theory and Approximation Practice (2013), chapters 3 and 8.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
from numpy.polynomial.chebyshev import chebvander

ROWS, COLUMNS = 144, 96
"""Pixels of a panel, at most: its products stay below 2^18, beyond which OpenBLAS wakes threads of its own."""

POINTS = 10, 18
"""Of a panel's side, its ends among them: more only where fewer do not suffice."""

TAIL = 2
"""Coefficients that have to be as small as rounding, for a polynomial to be as right as its points."""


def on_grid(function: Callable, x, y, noise: float) -> np.ndarray:
    """Return a function's two values, (2, rows, columns), at x (1, columns) and y (rows, 1); NaN where not known.

    function: of two arrays of one shape, gives two such arrays; where one has no value, NaN, the panel is not known.
    Right to 8 times the function's own error, the norm of the interpolation, and to ``noise``, absolute, which the last
    coefficients are smaller than.
    """
    bands = np.array_split(y[:, 0], -(-y.size // ROWS))
    values = [_band(function, x[0], band, noise) for band in bands]
    return values[0] if len(values) == 1 else np.concatenate(values, axis=1)


def _band(function, x, y, noise):
    """Return what ``on_grid`` does, for the rows of one row of panels."""
    count = -(-x.size // COLUMNS)
    wide = -(-x.size // count)
    columns = np.pad(x, (0, count * wide - x.size), mode="edge").reshape(count, wide)
    out = np.full((2, y.size, count, wide), np.nan)
    left = np.arange(count)
    for points in POINTS:
        (x_nodes, x_terms), (y_nodes, y_terms) = _terms(columns[left], points), _terms(y[None], points)
        values = np.stack(function(*np.broadcast_arrays(x_nodes.reshape(1, -1), y_nodes.reshape(-1, 1))))
        fit = _fit(points)
        series = fit @ values.reshape(2, points, len(left), points).swapaxes(1, 2) @ fit.T
        size = np.abs(series).max(axis=0)
        tail = np.maximum(size[:, -TAIL:].max(axis=(1, 2)), size[..., -TAIL:].max(axis=(1, 2)))
        right = tail <= noise
        out[:, :, left[right]] = (y_terms @ series[:, right] @ x_terms[right].swapaxes(1, 2)).swapaxes(1, 2)
        left = left[~right]
        if not left.size:
            break
    return out.reshape(2, y.size, -1)[..., : x.size]


def _terms(places, points):
    """Return the nodes of intervals that hold some places each, (n, points), and the polynomials, (n, m, points)."""
    low, high = places.min(axis=1, keepdims=True), places.max(axis=1, keepdims=True)
    middle, half = (low + high) / 2, (high - low) / 2
    nodes = middle + half * np.cos(np.pi / (points - 1) * np.arange(points))
    nodes[:, 0], nodes[:, -1] = high[:, 0], low[:, 0]
    return nodes, chebvander((places - middle) / np.where(half > 0, half, 1.0), points - 1)


@cache
def _fit(points):
    """Return the matrix that brings values at Chebyshev's points of the second kind to coefficients."""
    turns = np.outer(np.arange(points), np.arange(points)) % (2 * (points - 1))  # whole ones taken off exactly
    weight = np.where(np.arange(points) % (points - 1) == 0, 0.5, 1.0)
    return np.cos(np.pi / (points - 1) * turns) * weight * weight[:, None] * (2 / (points - 1))
