"""Error bounds, to first order, of the values that a shader computes from a record.

The error of an operation is its own rounding plus its slopes times its operands' errors. If the errors leave a
comparison undecided, the error is the difference of the two branches, and infinite if one of them is NaN. The results
of a loop count as exact: here a step of Newton's method follows each iteration and squares its remaining error.
Reference: N. Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed. (2002), section 3.3, running error bounds.
"""

from collections.abc import Callable, Sequence
from math import isnan
from typing import Any, NamedTuple

import numpy as np

from ..conventions import EPS32
from ..maths.recording import NUMPY, Record
from ..maths.recording.derivatives import SLOPES
from ..maths.recording.record import COMPARISONS, LOGICAL, NUMERIC, Arithmetic, repeat_body
from .writer import LEAST_CONSTANT


class Rounded(NamedTuple):
    """A value and the bound of its error. For a truth value, ``error`` is whether the value is undecided."""

    value: Any
    error: Any = 0.0


def rounded(record: Record, inputs: Sequence[Rounded]) -> tuple[Rounded, ...]:
    """Return the outputs of a record at these inputs, arrays that broadcast, each with the bound of its error.

    The values are computed in float64, and are NaN where undefined. An error is infinite where float32 leaves open
    whether the value is defined, and where the first order gives no bound, as at a division by a number that may be 0.
    """
    with np.errstate(all="ignore"):  # NaN and infinite bounds are valid results here
        return record.evaluate(ARITHMETIC, inputs)


def _some(relative: float, absolute: float = 0.0) -> Callable:
    """Return the rounding function ``relative`` EPS32 times the result plus ``absolute`` EPS32."""
    return lambda value, *_: EPS32 * (relative * np.abs(value) + absolute)


def _sine(value, angle):
    """Return the rounding of a sine: half turns are subtracted in parts that are accurate to 1e-9 of a turn."""
    return EPS32 * (4 * np.abs(value) + np.abs(angle) / 16)


def _cosine(value, angle):
    """Return the rounding of a cosine: the angle is rounded when it is subtracted from a quarter turn."""
    return EPS32 * (4 * np.abs(value) + 2 + 2 * np.abs(angle))


ROUNDING: dict[str, Callable] = {
    "sin": _sine, "cos": _cosine, "tan": _some(12, 1), "hypot": _some(3), "divide": _some(2), "sqrt": _some(2),
    "remainder": lambda value, a, b: 2 * EPS32 * np.abs(a), "exp": _some(600), "expm1": _some(5000, 2),
    "log": _some(4, 6), "log1p": _some(4, 6), "power": _some(600), "sinh": _some(300), "cosh": _some(300),
    "tanh": _some(600, 4), "arcsin": _some(0, 1600), "arccos": _some(0, 1600), "arctan": _some(0, 320),
    "arctan2": _some(0, 320),
}  # fmt: skip
"""Rounding of each operation as a function of its result and operands; 1 EPS32 of the result for others. About twice
the rounding of Cycles 4.5, 5.0 and 5.2 on a CPU, whose functions are fast approximations: a test measures each.
"""


def _bounded(value, error, *operands: Rounded, lost=False) -> Rounded:
    """Return a value with its bound.

    The bound is infinite if that of an operand is, if ``error`` is NaN, and where ``lost`` is true; 0 if the value is
    certainly undefined.
    """
    error = np.where(np.isnan(value), 0.0, np.where(np.isnan(error), np.inf, error))
    for operand in operands:
        lost = lost | np.isinf(operand.error)
    return Rounded(value, np.where(lost, np.inf, error))


def _operation(name: str) -> Callable[..., Rounded]:
    """Return a smooth operation with its error bound."""
    function, rounding, slopes = NUMPY[name], ROUNDING.get(name, _some(1)), SLOPES.get(name, ())

    def apply(*operands: Rounded) -> Rounded:
        values = [operand.value for operand in operands]
        value = function(*values)
        error = np.maximum(rounding(value, *values), LEAST_CONSTANT)
        for operand, slope in zip(operands, slopes, strict=False):
            moved = np.abs(slope(value, *values)) * operand.error
            error = error + np.where(np.equal(operand.error, 0), 0.0, moved)
        return _bounded(value, error, *operands)

    return apply


def _product(a: Rounded, b: Rounded) -> Rounded:
    """Return a product; its bound includes the second order, the only term for a square at 0."""
    value = a.value * b.value
    error = np.abs(a.value) * b.error + (np.abs(b.value) + b.error) * a.error + EPS32 * np.abs(value)
    return _bounded(value, error, a, b)


def _quotient(a: Rounded, b: Rounded) -> Rounded:
    value, error = _operation("divide")(a, b)
    return _bounded(value, error, a, b, lost=(b.error > 0) & (np.abs(b.value) <= b.error))


def _root(a: Rounded) -> Rounded:
    """Return a root. It changes by at most the root of the error, and is lost if the operand may be negative."""
    value, largest = np.sqrt(a.value), np.sqrt(a.error)
    error = np.fmin(0.5 * a.error / value, largest) + 2 * EPS32 * value
    return _bounded(value, error, a, lost=(a.value != 0) & (np.abs(a.value) <= a.error))


def _longer(a: Rounded, b: Rounded) -> Rounded:
    value = np.hypot(a.value, b.value)
    return _bounded(value, a.error + b.error + 4 * EPS32 * value, a, b)


def _stepped(name: str) -> Callable[..., Rounded]:
    """Return an operation that is constant between jumps, with its error bound."""
    function = NUMPY[name]

    def apply(a: Rounded) -> Rounded:
        return _bounded(function(a.value), 0.0, a, lost=function(a.value - a.error) != function(a.value + a.error))

    return apply


def _remainder(a: Rounded, b: Rounded) -> Rounded:
    value, error = _operation("remainder")(a, b)
    times = a.value / b.value
    near = (a.error + np.abs(times) * b.error) / np.abs(b.value) + 2 * EPS32 * np.abs(times)
    return _bounded(value, error, a, b, lost=np.floor(times - near) != np.floor(times + near))


def _compared(name: str) -> Callable[..., Rounded]:
    def compare(a: Rounded, b: Rounded) -> Rounded:
        error = a.error + b.error
        near = (np.abs(a.value - b.value) <= error) & np.greater(error, 0)
        return Rounded(NUMPY[name](a.value, b.value), near | np.isinf(error))

    return compare


def _logical(name: str) -> Callable[..., Rounded]:
    return lambda *operands: Rounded(
        NUMPY[name](*(operand.value for operand in operands)),
        np.logical_or.reduce(np.broadcast_arrays(*(o.error for o in operands))),
    )


def _extreme(name: str) -> Callable[..., Rounded]:
    """Return the minimum or maximum, with the error of the operand that it is; the larger one if that is undecided."""

    def apply(a: Rounded, b: Rounded) -> Rounded:
        least = _compared("less")(a, b)
        of_first = least.value if name == "minimum" else np.logical_not(least.value)
        error = np.where(least.error, np.maximum(a.error, b.error), np.where(of_first, a.error, b.error))
        return _bounded(NUMPY[name](a.value, b.value), error, a, b)

    return apply


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
    "absolute": lambda a: _bounded(np.abs(a.value), a.error, a),
    **{name: _extreme(name) for name in ("minimum", "maximum")},
    "where": _chosen,
    "constant": lambda value: Rounded(value, 0.0 if isinstance(value, bool) or isnan(value) else EPS32 * abs(value)),
    "parameter": lambda value, name: Rounded(value, EPS32 * abs(value)),
    "roundoff": lambda: Rounded(NUMPY["roundoff"]()),
    "stop_gradient": lambda a: a,
    "searchsorted": lambda a, table, side: Rounded(NUMPY["searchsorted"](a.value, table, side)),
    "take": lambda index, table: Rounded(value := NUMPY["take"](index.value, table), EPS32 * np.abs(value)),
    "loop": lambda body, limit, state: [
        Rounded(value) for value in repeat_body(NUMPY, body, limit, [start.value for start in state])
    ],
}
