"""The inverse of an increasing function, to full precision: Newton's method from a table, in a bracket if necessary.

Reference: W. Press et al., Numerical Recipes, 3rd ed. (2007), section 9.4 (rtsafe) for the bracket.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..conventions import EPS
from .recording import is_recorded, loop, roundoff, stop_gradient

KNOTS = 16385
"""Number of points of the table: a guess from it has an error of about 1e-9, which one Newton step squares."""

SPARSE, ORDINARY = 64, 0.9
"""With every 64th entry alone, lookups take a quarter of the time. That is enough for the first 0.9 of the table; near
its end entries may be far apart.
"""

LAST_STEP = 1e-8
"""Square root of rounding: after a step below this fraction of x, the error is less than the function's rounding."""

MOST_STEPS = 400
"""Largest number of steps, enough for bisection alone to reach the last of a hundred digits."""


@dataclass(frozen=True)
class Inverse:
    """x in [low, high] with function(x) = target, for a function that does not decrease there; NaN for other targets.

    The error is at most 2 EPS of x plus the function's rounding over its derivative; if the derivative is 0, it is the
    square root of that. A target that is beyond an end by no more than rounding gives the end.
    """

    function: Callable
    derivative: Callable
    low: float
    high: float
    spacing: Callable = np.linspace
    """Function that returns the table's points, from low, high and their number."""

    @cached_property
    def _table(self):
        knots = self.spacing(self.low, self.high, KNOTS)
        return knots, self.function(knots)

    def guess(self, target):
        """Return a guess from the table, a start for Newton's method; NaN for a target outside."""
        knots, values = self._table
        if not (target > values[int(ORDINARY * KNOTS)]).any():
            knots, values = knots[::SPARSE], values[::SPARSE]
        return np.interp(target, values, knots, np.nan, np.nan)

    def __call__(self, target):
        """Return the inverse of an array of targets, or of a recorded number."""
        if is_recorded(target):  # without the table, which only has the digits of float64
            values = [self.function(end) for end in (self.low, self.high)]
            goal = np.where(self._is_within(target, values), np.clip(target, *values), np.nan)
            x = self._bracketed(stop_gradient(goal), self.low, self.low, self.high)
            return x - (self.function(x) - goal) / self.derivative(x)  # whose derivative is the inverse's own
        knots, values = self._table
        target = np.asarray(target, np.float64)
        within = self._is_within(target, values)
        x = np.interp(target, values, knots)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = (self.function(x) - target) / self.derivative(x)
        x -= step
        slow = within & np.logical_not(np.abs(step) <= LAST_STEP * x)
        x = np.where(within, np.clip(x, self.low, self.high), np.nan)
        if slow.any():
            goal = np.clip(target[slow], values[0], values[-1])
            cell = np.clip(np.searchsorted(values, goal, side="right") - 1, 0, KNOTS - 2)
            x[slow] = self._bracketed(goal, np.interp(goal, values, knots), knots[cell], knots[cell + 1])
        return x

    def _is_within(self, target, values):
        slack = 8 * EPS * np.maximum(np.abs(values[0]), np.abs(values[-1]))
        return (target >= values[0] - slack) & (target <= values[-1] + slack)

    def _bracketed(self, target, x, left, right):
        """Return x by Newton's steps, or by halving the bracket if a step leaves it."""

        def step(target, x, left, right):
            error = self.function(x) - target
            left, right = np.where(error < 0, x, left), np.where(error > 0, x, right)
            slope = self.derivative(x)
            guess = x - error / np.where(slope > 0, slope, 1.0)
            is_good = (error == 0) | ((slope > 0) & (guess > left) & (guess < right))  # an end was tried before
            guess = np.where(is_good, guess, (left + right) / 2)
            close = 2 * roundoff(x)
            goes_on = (np.abs(guess - x) > close * np.abs(guess)) & (right - left > close * right)
            return (target, guess, left, right), ~goes_on

        return loop(step, (target, x, left, right), MOST_STEPS)[1]
