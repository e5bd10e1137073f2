"""The ranges of a record's values, by interval arithmetic: from intervals of its inputs to intervals of its outputs.

A range holds every number that an operation gives for some numbers in the ranges of its operands; it is NaN if there is
no such number. Ranges may be wider than necessary, never narrower, except for rounding, which is not tracked: add a
margin to what is made from them. Operations whose range would take more than a few products are given any number.
Reference: R. E. Moore, Interval Analysis (1966).
"""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from ...conventions import EPS
from ..intervals import Interval
from .record import NUMERIC, Arithmetic, Record


class Range(NamedTuple):
    """The numbers from low to high; of a truth value, 0 and 1."""

    low: Any
    high: Any
    has_gaps: Any = False
    """Whether some operand may have no value: a comparison with it is false."""


ANY = Range(-np.inf, np.inf, True)


def ranges(record: Record, inputs: Sequence[tuple[Any, Any]]) -> tuple[Range, ...]:
    """Return the ranges of a record's outputs, given the lowest and highest values of its inputs."""
    with np.errstate(all="ignore"):
        return record.evaluate(RANGES, [Range(low, high) for low, high in inputs])


def _made(operands: Sequence[Range], low, high, gaps=False) -> Range:
    for operand in operands:
        gaps = gaps | operand.has_gaps
    return Range(low, high, gaps)


def _unknown(*operands: Range) -> Range:
    nothing = sum(np.asarray(operand.low) for operand in operands)  # NaN where an operand is
    return Range(np.where(np.isnan(nothing), np.nan, -np.inf), np.where(np.isnan(nothing), np.nan, np.inf), True)


def _rising(function: Callable, lowest: float = -np.inf, highest: float = np.inf) -> Callable:
    """Return the ranges of a function that rises from ``lowest`` to ``highest`` and has no value beyond, nor an
    infinite one.
    """
    with np.errstate(divide="ignore"):
        ends = np.less_equal if np.isinf(function(lowest)) and np.isfinite(lowest) else np.less

    def of(a: Range) -> Range:
        nothing = np.where((a.low > highest) | (a.high < lowest), np.nan, 0.0)
        low, high = (function(np.clip(end, lowest, highest)) + nothing for end in a[:2])
        return _made((a,), low, high, ends(a.low, lowest) | (a.high > highest))

    return of


def _negative(a: Range) -> Range:
    return Range(-a.high, -a.low, a.has_gaps)


def _absolute(a: Range) -> Range:
    least = np.where((a.low < 0) & (a.high > 0), 0.0, np.minimum(np.abs(a.low), np.abs(a.high)))
    return Range(least, np.maximum(-a.low, a.high), a.has_gaps)


def _product(a: Range, b: Range) -> Range:
    if a is b:
        size = _absolute(a)
        return Range(size.low * size.low, size.high * size.high, a.has_gaps)
    product = Interval(a.low, a.high) * Interval(b.low, b.high)
    return _made((a, b), product.low, product.high)


def _quotient(a: Range, b: Range) -> Range:
    nothing = np.where(np.isnan(a.low) | np.isnan(b.low), np.nan, 0.0)
    quotient = Interval(a.low, a.high) / Interval(b.low, b.high)
    return _made((a, b), quotient.low + nothing, quotient.high + nothing, (b.low <= 0) & (b.high >= 0))


def _power(a: Range, b: Range) -> Range:
    exponent = np.asarray(b.low)
    if exponent.ndim or b.high != b.low:
        return _unknown(a, b)
    if exponent % 1:
        rising = _rising(lambda x: x ** abs(exponent), 0.0)(a)
    else:
        base = a if exponent % 2 else _absolute(a)
        rising = Range(base.low ** abs(exponent), base.high ** abs(exponent), a.has_gaps)
    return rising if exponent >= 0 else _quotient(Range(1.0, 1.0), rising)


def _cosine(a: Range) -> Range:
    ends = np.cos(a.low), np.cos(a.high)
    turns = a.low / (2 * np.pi), a.high / (2 * np.pi)
    top = np.floor(turns[1]) >= np.ceil(turns[0])
    bottom = np.floor(turns[1] - 0.5) >= np.ceil(turns[0] - 0.5)
    low, high = np.where(bottom, -1.0, np.minimum(*ends)), np.where(top, 1.0, np.maximum(*ends))
    endless, nothing = ~np.isfinite(a.high - a.low), np.where(np.isnan(a.low), np.nan, 0.0)
    return Range(np.where(endless, -1.0, low) + nothing, np.where(endless, 1.0, high) + nothing, a.has_gaps)


def _tangent(a: Range) -> Range:
    branch = np.floor(a.low / np.pi + 0.5) == np.floor(a.high / np.pi + 0.5)
    none = _unknown(a)
    return Range(np.where(branch, np.tan(a.low), none.low), np.where(branch, np.tan(a.high), none.high), a.has_gaps)


def _arctan2(y: Range, x: Range) -> Range:
    corners = [np.arctan2(up, across) for up in y[:2] for across in x[:2]]
    cut = (y.low <= 0) & (y.high >= 0) & (x.low <= 0)  # holds the origin, or crosses the line where the angle jumps
    low, high = np.minimum.reduce(corners), np.maximum.reduce(corners)
    return _made((y, x), np.where(cut, -np.pi, low), np.where(cut, np.pi, high))


def _cosh(a: Range) -> Range:
    size = _absolute(a)
    return Range(np.cosh(size.low), np.cosh(size.high), a.has_gaps)


def _hypot(a: Range, b: Range) -> Range:
    size_a, size_b = _absolute(a), _absolute(b)
    return _made((a, b), np.hypot(size_a.low, size_b.low), np.hypot(size_a.high, size_b.high))


def _compared(function: Callable, negated: Callable) -> Callable:
    """Return the ranges of a comparison: by whether it may be true, and whether it must be."""

    def of(a: Range, b: Range) -> Range:
        gaps = a.has_gaps | b.has_gaps
        return Range((negated(a, b) & ~np.asarray(gaps)) * 1.0, function(a, b) * 1.0)

    return of


def _either(condition: Range, yes: Range, no: Range) -> Range:
    may, must = condition.high > 0, condition.low > 0
    low, high = (end(np.where(may, first, np.nan), np.where(must, np.nan, second))
                 for end, first, second in ((np.fmin, yes.low, no.low), (np.fmax, yes.high, no.high)))  # fmt: skip
    absent = (may & np.isnan(yes.low)) | (~must & np.isnan(no.low))
    return Range(low, high, absent | (may & yes.has_gaps) | (~must & no.has_gaps))


def _taken(index: Range, table) -> Range:
    values = np.asarray(table, np.float64)
    nothing = np.where(np.isnan(index.low), np.nan, 0.0)
    return Range(np.nanmin(values) + nothing, np.nanmax(values) + nothing, index.has_gaps | np.isnan(values).any())


def _placed(number: Range, table, side) -> Range:
    low, high = (np.searchsorted(table, end, side).astype(np.float64) for end in number[:2])
    return Range(low, high, number.has_gaps)


def _constant(value, *_) -> Range:
    return Range(value * 1.0, value * 1.0, np.isnan(value))


RANGES: Arithmetic = {
    **dict.fromkeys(NUMERIC, _unknown),
    **{name: _rising(getattr(np, name))
       for name in ("floor", "ceil", "rint", "sign", "exp", "expm1", "arctan", "sinh", "tanh")},
    "sqrt": _rising(np.sqrt, 0.0), "log": _rising(np.log, 0.0), "log1p": _rising(np.log1p, -1.0),
    "arcsin": _rising(np.arcsin, -1.0, 1.0),
    "arccos": lambda a: _negative(_rising(lambda x: -np.arccos(x), -1.0, 1.0)(a)),
    "add": lambda a, b: _made((a, b), a.low + b.low, a.high + b.high),
    "subtract": lambda a, b: _made((a, b), a.low - b.high, a.high - b.low),
    "multiply": _product, "divide": _quotient, "power": _power, "negative": _negative, "absolute": _absolute,
    "minimum": lambda a, b: _made((a, b), np.minimum(a.low, b.low), np.minimum(a.high, b.high)),
    "maximum": lambda a, b: _made((a, b), np.maximum(a.low, b.low), np.maximum(a.high, b.high)),
    "hypot": _hypot, "cos": _cosine, "sin": lambda a: _cosine(Range(a.low - np.pi / 2, a.high - np.pi / 2, a.has_gaps)),
    "tan": _tangent, "arctan2": _arctan2, "cosh": _cosh,
    "less": _compared(lambda a, b: a.low < b.high, lambda a, b: a.high < b.low),
    "less_equal": _compared(lambda a, b: a.low <= b.high, lambda a, b: a.high <= b.low),
    "equal": _compared(
        lambda a, b: (a.low <= b.high) & (b.low <= a.high), lambda a, b: (a.low == b.high) & (a.high == b.low)
    ),
    "logical_and": lambda a, b: Range(np.minimum(a.low, b.low), np.minimum(a.high, b.high)),
    "logical_or": lambda a, b: Range(np.maximum(a.low, b.low), np.maximum(a.high, b.high)),
    "logical_not": lambda a: Range(1.0 - a.high, 1.0 - a.low),
    "where": _either,
    "constant": _constant, "parameter": _constant, "varied": _constant,
    "roundoff": lambda: Range(EPS, EPS),
    "stop_gradient": lambda a: a,
    "least_root": lambda *coefficients: Range(0.0, np.inf, True),
    "searchsorted": _placed, "take": _taken,
    "loop": lambda body, limit, state: [ANY] * len(body.outputs),
}  # fmt: skip
"""The arithmetic of ranges."""
