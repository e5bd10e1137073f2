"""Numbers that vary: plain numbers with their derivatives by some parameters, such as the settings of a camera.

A formula from parameters to constants runs on them as on any float, branches and refusals included; where the constants
meet recorded numbers they become steps ``varied`` of the record, and ``differentiate`` gives the derivatives by the
parameters beside those by the inputs. A varied number is true, even if it is 0: truth asks whether a term may be left
out, and its derivative may not. Comparisons are those of its value.
Arrays of float64, loops and tables take the value alone: what they compute (limits, guesses, iterations to a root that
are followed by a step of Newton's method) is constant, or has the derivatives of that step. ``array`` makes an array
that keeps them.
Reference: A. Griewank and A. Walther, Evaluating Derivatives, 2nd ed. (2008), chapter 3 (forward mode).
"""

import math
from collections.abc import Callable
from numbers import Real
from typing import Any

import numpy as np

from .derivatives import Dual, dual_arithmetic
from .record import COMPARISONS, LOGICAL

FLAT = COMPARISONS | LOGICAL | {
    "sign", "floor", "ceil", "rint", "greater", "greater_equal", "not_equal", "isfinite", "isnan",
}  # fmt: skip
"""Operations that have no derivative but 0."""


class Varied(float):
    """A number with ``slopes``: its derivative by each parameter, None for 0."""

    slopes: tuple[float | None, ...]

    def __new__(cls, value: float, slopes: tuple[float | None, ...]):
        """Return the number with these derivatives."""
        number = super().__new__(cls, value)
        number.slopes = slopes
        return number

    def __bool__(self) -> bool:
        return True

    def __array_ufunc__(self, ufunc, method, *operands, **options):
        if all(isinstance(operand, Real) for operand in operands) and ufunc.__name__ not in FLAT:
            return _apply(ufunc.__name__, *operands)
        if not all(isinstance(operand, Real | np.ndarray) for operand in operands):
            return NotImplemented
        kept = any(getattr(operand, "dtype", None) == np.dtype(object) for operand in operands)
        put = (lambda operand: np.asarray(operand, object)) if kept else float
        values = [put(operand) if isinstance(operand, Varied) else operand for operand in operands]
        return getattr(ufunc, method)(*values, **options)


def array(parts: Any) -> np.ndarray:
    """Return an array of float64, or of objects if one of the parts is a varied or a recorded number."""
    if isinstance(parts, np.ndarray) and parts.dtype != object:
        return np.asarray(parts, np.float64)
    numbers = np.array(parts, object)
    kept = any(isinstance(number, Varied) or not isinstance(number, Real) for number in numbers.flat)
    return numbers if kept else numbers.astype(np.float64)


def vector(*parts: Any) -> np.ndarray:
    """Return an array of numbers, some of which may be recorded numbers that depend on the inputs."""
    numbers = np.empty(len(parts), object)
    for index, number in enumerate(parts):
        numbers[index] = number
    return array(numbers)


def _apply(name: str, *operands: Any) -> Any:
    count = next(len(operand.slopes) for operand in operands if isinstance(operand, Varied))
    zero = (None,) * count
    duals = [Dual(float(operand), operand.slopes if isinstance(operand, Varied) else zero) for operand in operands]
    known = dual_arithmetic(count)
    if name not in known:
        raise TypeError(f"np.{name} of a setting has no derivative: use other functions of numpy")
    result = known[name](*duals)
    return Varied(result.value, tuple(None if partial is None else float(partial) for partial in result.partials))


def _operator(name: str, swapped: bool = False) -> Callable:
    def apply(self, *other):
        if not all(isinstance(operand, Real) for operand in other):
            return NotImplemented
        return _apply(name, *other, self) if swapped else _apply(name, self, *other)

    return apply


for _word, _name in {"add": "add", "sub": "subtract", "mul": "multiply", "truediv": "divide", "pow": "power"}.items():
    setattr(Varied, f"__{_word}__", _operator(_name))
    setattr(Varied, f"__r{_word}__", _operator(_name, swapped=True))
for _word, _name in {"neg": "negative", "abs": "absolute"}.items():
    setattr(Varied, f"__{_word}__", _operator(_name))


def _function(name: str) -> Callable[[float], float]:
    plain, recorded = getattr(math, name), getattr(np, name)

    def apply(number):
        if isinstance(number, Varied):
            return _apply(name, number)
        return plain(number) if isinstance(number, Real) else recorded(number)

    return apply


sin, cos, tan = _function("sin"), _function("cos"), _function("tan")
"""Those of the module math, also for varied and for recorded numbers."""
