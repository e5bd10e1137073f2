"""How far a shader's arithmetic may move what a record computes: values with bounds of their errors, to first order.

Each operation adds its own rounding to what its slopes make of its operands' errors. Where a comparison is undecided
the error is how far both branches are apart; infinite where one of them is no number. What a loop gives counts as
exact: loops here are iterations that a step of Newton's method follows, which squares what they leave.
Reference: N. Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed. (2002), section 3.3, running error bounds.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import isnan
from typing import Any, NamedTuple

import numpy as np

from ..conventions import EPS32
from ..maths.recording import NUMPY, Record
from ..maths.recording.derivatives import SLOPES
from ..maths.recording.record import COMPARISONS, LOGICAL, NUMERIC, Arithmetic, repeat_body
from .osl import LEAST


class Rounded(NamedTuple):
    """A value and the most that it is off; of what is true or false, whether it is undecided."""

    value: Any
    error: Any = 0.0


def rounded(record: Record, inputs: Sequence[Rounded]) -> tuple[Rounded, ...]:
    """Return the outputs of a record at these inputs, arrays that broadcast, each with the bound of its error.

    The values are those of float64; NaN where there is no number. An error is infinite where float32 does not tell
    whether there is a number, and where the first order says nothing, as at a division by what may be 0.
    """
    with np.errstate(all="ignore"):  # no number, or an infinite bound, is an answer here
        return record.evaluate(ARITHMETIC, inputs)


def _some(relative: float, absolute: float = 0.0) -> Callable:
    """So many EPS32 of the result, and of 1."""
    return lambda value, *_: EPS32 * (relative * np.abs(value) + absolute)


def _sine(value, angle):
    """Half turns are taken away in parts that are right to 1e-9 of a turn."""
    return EPS32 * (4 * np.abs(value) + np.abs(angle) / 16)


def _cosine(value, angle):
    """The angle is rounded where it is taken from a quarter turn."""
    return EPS32 * (4 * np.abs(value) + 2 + 2 * np.abs(angle))


ROUNDING: dict[str, Callable] = {
    "sin": _sine, "cos": _cosine, "tan": _some(12, 1), "hypot": _some(3), "divide": _some(2), "sqrt": _some(2),
    "remainder": lambda value, a, b: 2 * EPS32 * np.abs(a), "exp": _some(600), "expm1": _some(5000, 2),
    "log": _some(4, 6), "log1p": _some(4, 6), "power": _some(600), "sinh": _some(300), "cosh": _some(300),
    "tanh": _some(600, 4), "arcsin": _some(0, 1600), "arccos": _some(0, 1600), "arctan": _some(0, 320),
    "arctan2": _some(0, 320),
}  # fmt: skip
"""What an operation itself rounds, from its result and its operands; 1 EPS32 of the result where it is not listed.
About twice what Cycles 4.5, 5.0 and 5.2 round on a CPU, whose functions are fast ones: a test measures each.
"""


def _bounded(value, error, *operands: Rounded, lost=False) -> Rounded:
    """Return a value with its bound: infinite where it was for an operand, where there is none, and where it is lost;
    0 where there is no number for sure.
    """
    error = np.where(np.isnan(value), 0.0, np.where(np.isnan(error), np.inf, error))
    for operand in operands:
        lost = lost | np.isinf(operand.error)
    return Rounded(value, np.where(lost, np.inf, error))


def _operation(name: str) -> Callable[..., Rounded]:
    """Return an operation that is smooth."""
    function, rounding, slopes = NUMPY[name], ROUNDING.get(name, _some(1)), SLOPES.get(name, ())

    def apply(*operands: Rounded) -> Rounded:
        given = [operand.value for operand in operands]
        value = function(*given)
        error = np.maximum(rounding(value, *given), LEAST)
        for operand, slope in zip(operands, slopes, strict=False):
            moved = np.abs(slope(value, *given)) * operand.error
            error = error + np.where(np.equal(operand.error, 0), 0.0, moved)
        return _bounded(value, error, *operands)

    return apply


def _product(a: Rounded, b: Rounded) -> Rounded:
    """The second order counts: it is all that there is of a square at 0."""
    value = a.value * b.value
    error = np.abs(a.value) * b.error + (np.abs(b.value) + b.error) * a.error + EPS32 * np.abs(value)
    return _bounded(value, error, a, b)


def _quotient(a: Rounded, b: Rounded) -> Rounded:
    value, error = _operation("divide")(a, b)
    return _bounded(value, error, a, b, lost=(b.error > 0) & (np.abs(b.value) <= b.error))


def _root(a: Rounded) -> Rounded:
    """It moves by the root of the error at most, and may be none where float32 gives less than 0."""
    value, most = np.sqrt(a.value), np.sqrt(a.error)
    error = np.fmin(0.5 * a.error / value, most) + 2 * EPS32 * value
    return _bounded(value, error, a, lost=(a.value != 0) & (np.abs(a.value) <= a.error))


def _longer(a: Rounded, b: Rounded) -> Rounded:
    value = np.hypot(a.value, b.value)
    return _bounded(value, a.error + b.error + 4 * EPS32 * value, a, b)


def _stepped(name: str) -> Callable[..., Rounded]:
    """Return an operation that is constant between jumps."""
    function = NUMPY[name]

    def apply(a: Rounded) -> Rounded:
        return _bounded(function(a.value), 0.0, a, lost=function(a.value - a.error) != function(a.value + a.error))

    return apply


def _remainder(a: Rounded, b: Rounded) -> Rounded:
    value, error = _operation("remainder")(a, b)
    times = a.value / b.value
    near = (a.error + np.abs(times) * b.error) / np.abs(b.value) + 2 * EPS32 * np.abs(times)
    return _bounded(value, error, a, b, lost=np.floor(times - near) != np.floor(times + near))


def _larger_error(name: str) -> Callable[..., Rounded]:
    return lambda *given: _bounded(
        NUMPY[name](*(one.value for one in given)),
        np.maximum.reduce(np.broadcast_arrays(*(one.error for one in given))),
        *given,
    )


def _compared(name: str) -> Callable[..., Rounded]:
    def compare(a: Rounded, b: Rounded) -> Rounded:
        error = a.error + b.error
        near = (np.abs(a.value - b.value) <= error) & np.greater(error, 0)
        return Rounded(NUMPY[name](a.value, b.value), near | np.isinf(error))

    return compare


def _logical(name: str) -> Callable[..., Rounded]:
    return lambda *given: Rounded(
        NUMPY[name](*(one.value for one in given)), np.logical_or.reduce(np.broadcast_arrays(*(o.error for o in given)))
    )


def _chosen(condition: Rounded, yes: Rounded, no: Rounded) -> Rounded:
    apart = np.abs(np.subtract(yes.value, no.value))
    either = np.maximum(np.maximum(yes.error, no.error), np.where(np.isnan(apart), np.inf, apart))
    error = np.where(condition.error, either, np.where(condition.value, yes.error, no.error))
    return Rounded(np.where(condition.value, yes.value, no.value), error)


ARITHMETIC: Arithmetic = {
    **{name: _operation(name) for name in NUMERIC},
    **{name: _compared(name) for name in COMPARISONS},
    **{name: _logical(name) for name in LOGICAL},
    "multiply": _product,
    "divide": _quotient,
    "sqrt": _root,
    "hypot": _longer,
    "remainder": _remainder,
    **{name: _stepped(name) for name in ("floor", "ceil", "rint", "sign")},
    **{name: _larger_error(name) for name in ("absolute", "minimum", "maximum")},
    "where": _chosen,
    "constant": lambda value: Rounded(value, 0.0 if isinstance(value, bool) or isnan(value) else EPS32 * abs(value)),
    "parameter": lambda value, name: Rounded(value, EPS32 * abs(value)),
    "roundoff": lambda: Rounded(NUMPY["roundoff"]()),
    "stop_gradient": lambda a: a,
    "searchsorted": lambda a, table, side: Rounded(NUMPY["searchsorted"](a.value, table, side)),
    "take": lambda place, table: Rounded(value := NUMPY["take"](place.value, table), EPS32 * np.abs(value)),
    "loop": lambda body, most, state: [
        Rounded(found) for found in repeat_body(NUMPY, body, most, [start.value for start in state])
    ],
}
