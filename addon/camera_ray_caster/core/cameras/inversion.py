"""The inverse of a growing function, to full precision: Newton's method inside a bracket."""

from __future__ import annotations

import numpy as np

from ..conventions import EPS

KNOTS = 257
"""Points of the table in which the first guess and its bracket are looked up."""

STEPS = 80
"""Enough for bisection alone to reach the last digit; Newton takes three or four."""


def invert(function, derivative, target, low: float, high: float):
    """Return x of [low, high] with function(x) = target; NaN where the target lies outside the function's range.

    The function must not fall on the interval. The guess is interpolated in a table, each step is Newton's unless it
    leaves the bracket, then the bracket is halved. The result is right to 2 EPS of x where the derivative is not 0,
    plus the function's own rounding over the derivative. A target beyond an end by its rounding takes the end.
    """
    knots = np.linspace(low, high, KNOTS)
    values = function(knots)
    slack = 8 * EPS * np.abs(values).max()
    within = (target >= values[0] - slack) & (target <= values[-1] + slack)
    target = np.clip(np.where(within, target, values[0]), values[0], values[-1])
    cell = np.clip(np.searchsorted(values, target, side="right") - 1, 0, KNOTS - 2)
    left, right = knots[cell], knots[cell + 1]
    x = np.interp(target, values, knots)
    for _ in range(STEPS):
        error = function(x) - target
        left, right = np.where(error < 0, x, left), np.where(error > 0, x, right)
        slope = derivative(x)
        step = np.divide(error, slope, out=np.where(error == 0, 0.0, np.inf), where=slope > 0)
        guess = x - step
        guess = np.where((guess >= left) & (guess <= right), guess, (left + right) / 2)
        settled = np.abs(guess - x) <= 2 * EPS * np.abs(guess)
        x = guess
        if settled.all():
            break
    return np.where(within, x, np.nan)
