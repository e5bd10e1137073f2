"""The derivatives of a record with respect to its inputs, by dual numbers: values with their partial derivatives.

They are exact except for rounding: each operation adds its slopes times the partial derivatives of its operands. A
partial derivative known to be 0 is None, and costs nothing. ``where``, minimum and maximum have the derivatives of the
operand that they select (the first of two equal operands). Tables and roundings have those of constants. Loops carry
derivatives from step to step. An iteration to a root needs to carry none if one more step of Newton's method follows
it, whose derivatives are those of the root: see ``stop_gradient``. Where a formula has a kink or no finite slope, such
as sqrt at 0, no derivative exists; the result there is the derivative of one side, or not finite.
Reference: A. Griewank and A. Walther, Evaluating Derivatives, 2nd ed. (2008), chapters 3 (forward mode) and 15
(fixed points).
"""

from collections.abc import Callable, Sequence
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from .record import NUMPY, Arithmetic, Record


class Dual(NamedTuple):
    """A number or a truth value, and its partial derivatives with respect to each input; None for 0."""

    value: Any
    partials: tuple[Any, ...]


def differentiate(record: Record, inputs: Sequence, parameters: int = 0) -> tuple[Dual, ...]:
    """Return the outputs of a record at these inputs, numbers or arrays that broadcast, with their partial derivatives:
    by the inputs, and then by the parameters of the varied numbers of the formula, of which there are ``parameters``.

    The values are the same as with NUMPY. A partial derivative broadcasts with its value, and may have fewer axes.
    """
    count = range(len(inputs) + parameters)
    duals = [Dual(value, tuple(1.0 if k == index else None for k in count)) for index, value in enumerate(inputs)]
    return record.evaluate(dual_arithmetic(len(count)), duals)


@cache
def dual_arithmetic(count: int) -> Arithmetic:
    """Return the arithmetic of duals with ``count`` partial derivatives; the last are those of varied numbers."""
    zero = (None,) * count
    special: dict[str, Callable] = {
        "where": lambda condition, yes, no: Dual(
            np.where(condition.value, yes.value, no.value), _select(condition.value, yes, no)
        ),
        "minimum": lambda a, b: Dual(np.minimum(a.value, b.value), _select(a.value <= b.value, a, b)),
        "maximum": lambda a, b: Dual(np.maximum(a.value, b.value), _select(a.value >= b.value, a, b)),
        "all": lambda settled: NUMPY["all"](settled.value),
        "varied": lambda value, slopes: Dual(value, zero[len(slopes) :] + slopes),
    }

    def flat(function: Callable) -> Callable:
        plain = lambda operand: operand.value if isinstance(operand, Dual) else operand  # noqa: E731
        return lambda *operands: Dual(function(*map(plain, operands)), zero)

    others = {name: flat(function) for name, function in NUMPY.items()}
    return others | {name: _with_slopes(name) for name in SLOPES} | special


def _select(condition, yes: Dual, no: Dual) -> tuple[Any, ...]:
    """Return the partial derivatives of ``yes`` where the condition holds, and of ``no`` elsewhere."""
    return tuple(
        None if a is b is None else np.where(condition, 0.0 if a is None else a, 0.0 if b is None else b)
        for a, b in zip(yes.partials, no.partials, strict=True)
    )


def _with_slopes(name: str) -> Callable:
    """Return an operation on duals, by the chain rule."""
    function, slopes = getattr(np, name), SLOPES[name]

    def apply(*operands: Dual) -> Dual:
        values = [operand.value for operand in operands]
        result = function(*values)
        partials: list[Any] = [None] * len(operands[0].partials)
        for operand, slope in zip(operands, slopes, strict=True):
            gain = None
            for k, partial in enumerate(operand.partials):
                if partial is None:
                    continue
                if gain is None:
                    gain = slope(result, *values)
                term = partial * gain
                partials[k] = term if partials[k] is None else partials[k] + term
        return Dual(result, tuple(partials))

    return apply


SLOPES: dict[str, tuple[Callable, ...]] = {
    "add": (lambda f, a, b: 1.0, lambda f, a, b: 1.0),
    "subtract": (lambda f, a, b: 1.0, lambda f, a, b: -1.0),
    "multiply": (lambda f, a, b: b, lambda f, a, b: a),
    "divide": (lambda f, a, b: 1 / b, lambda f, a, b: -f / b),
    "remainder": (lambda f, a, b: 1.0, lambda f, a, b: -np.floor(a / b)),
    "power": (lambda f, a, b: b * np.power(a, b - 1), lambda f, a, b: f * np.log(a)),
    "negative": (lambda f, a: -1.0,),
    "absolute": (lambda f, a: np.sign(a),),
    "sqrt": (lambda f, a: 0.5 / f,),
    "hypot": (lambda f, a, b: a / f, lambda f, a, b: b / f),
    "exp": (lambda f, a: f,),
    "expm1": (lambda f, a: np.exp(a),),
    "log": (lambda f, a: 1 / a,),
    "log1p": (lambda f, a: 1 / (1 + a),),
    "sin": (lambda f, a: np.cos(a),),
    "cos": (lambda f, a: -np.sin(a),),
    "tan": (lambda f, a: 1 + f * f,),
    "arcsin": (lambda f, a: 1 / np.sqrt((1 - a) * (1 + a)),),
    "arccos": (lambda f, a: -1 / np.sqrt((1 - a) * (1 + a)),),
    "arctan": (lambda f, a: 1 / (1 + a * a),),
    "arctan2": (lambda f, a, b: b / (a * a + b * b), lambda f, a, b: -a / (a * a + b * b)),
    "sinh": (lambda f, a: np.cosh(a),),
    "cosh": (lambda f, a: np.sinh(a),),
    "tanh": (lambda f, a: 1 / np.cosh(a) ** 2,),
    "arcsinh": (lambda f, a: 1 / np.hypot(1, a),),
    "arccosh": (lambda f, a: 1 / np.sqrt((a - 1) * (a + 1)),),
    "arctanh": (lambda f, a: 1 / ((1 - a) * (1 + a)),),
    "cbrt": (lambda f, a: f / (3 * a),),
}
"""Partial derivatives with respect to each operand, from the result and the operands. Operations that are not listed
are constant between jumps, or select one of their operands. The last four are those of varied numbers alone.
"""
