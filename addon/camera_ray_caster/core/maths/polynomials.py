"""Polynomials: their values, and their positive roots for coefficients of any size."""

from __future__ import annotations

import numpy as np
from numpy.polynomial import Polynomial

REAL = 1e-9
"""Of a root: an imaginary part that is its rounding."""

LEAST = 1e-250
"""Of the largest coefficient: leading ones below it have roots beyond all use, and their quotients have no number."""


def horner(x, coefficients):
    """Return c0 + x (c1 + x (c2 + ...)) of numbers, arrays or recorded numbers; numpy's ``polyval`` does not record.

    Reference: N. Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed. (2002), section 5.1: it is off by at
    most gamma(2 n) times the same sum of magnitudes.
    """
    value = coefficients[-1]
    for coefficient in reversed(coefficients[:-1]):
        value = coefficient + x * value
    return value


def with_slope(x, coefficients):
    """Return a polynomial's value, as ``horner``, and its derivative; zeros at the end cost nothing."""
    there = np.trim_zeros(coefficients, "b")
    return horner(x, there), horner(x, [i * c for i, c in enumerate(there[1:], 1)] or [0.0])


def positive_roots(polynomial: Polynomial) -> np.ndarray:
    """Return the real roots above 0, (n,) float64, in order; none of a constant."""
    size = np.abs(polynomial.coef)
    last = np.flatnonzero(size > LEAST * size.max())
    roots = Polynomial(polynomial.coef[: last[-1] + 1]).roots() if last.size else np.zeros(0)
    return np.sort(roots.real[(np.abs(roots.imag) <= REAL * np.abs(roots)) & (roots.real > 0)])
