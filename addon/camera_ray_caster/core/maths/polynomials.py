"""Polynomials: their values, and their positive roots for coefficients of any size."""

from collections.abc import Sequence
from math import inf

import numpy as np
from numpy.polynomial import Polynomial

REAL = 1e-9
"""Largest imaginary part that counts as rounding, over the magnitude of the root."""

LEAST_LEADING = 1e-250
"""Leading coefficients up to this fraction of the largest are dropped: the roots are useless, quotients overflow."""


def horner(x, coefficients):
    """Return c0 + x (c1 + x (c2 + ...)) for numbers, arrays or recorded numbers; numpy's ``polyval`` does not record.

    The error is at most gamma(2 n) times the same sum of magnitudes.
    Reference: N. Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed. (2002), section 5.1.
    """
    value = coefficients[-1]
    for coefficient in reversed(coefficients[:-1]):
        value = coefficient + x * value
    return value


def with_slope(x, coefficients):
    """Return a polynomial's value, as ``horner`` does, and its derivative; trailing zero coefficients cost nothing."""
    there = coefficients[: max((count for count, coefficient in enumerate(coefficients, 1) if coefficient), default=0)]
    return horner(x, there), horner(x, [i * c for i, c in enumerate(there[1:], 1)] or [0.0])


def positive_roots(polynomial: Polynomial) -> np.ndarray:
    """Return the positive real roots, (n,) float64, in ascending order; a constant has none."""
    size = np.abs(polynomial.coef)
    last = np.flatnonzero(size > LEAST_LEADING * size.max())
    roots = Polynomial(polynomial.coef[: last[-1] + 1]).roots() if last.size else np.zeros(0)
    return np.sort(roots.real[(np.abs(roots.imag) <= REAL * np.abs(roots)) & (roots.real > 0)])


def least_root(coefficients: Sequence[float]) -> float:
    """Return the least positive real root of a polynomial, inf without one; coefficients from the constant up."""
    return min(positive_roots(Polynomial(coefficients)).tolist(), default=inf)
