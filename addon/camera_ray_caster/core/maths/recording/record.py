"""The record of a formula: its operations in order, each value computed once, and their evaluation.

NaN
    A pixel without a ray has no number as its value, which is NaN in numpy. In a record NaN comes from a constant NaN,
    or from an operation outside of its DOMAIN. From there it propagates: an operation on it gives NaN, a comparison
    with it is false. ``where`` takes the value of one branch, even if the other is NaN. Division by zero gives NaN by
    this rule, though numpy may return infinity: formulas rely on neither.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any

import numpy as np

from ...conventions import EPS
from ..polynomials import least_root

Arithmetic = Mapping[str, Callable]
"""Functions by the names of the operations that they perform."""

NUMERIC = frozenset((
    "add", "subtract", "multiply", "divide", "remainder", "power", "negative", "absolute", "sign", "minimum", "maximum",
    "floor", "ceil", "rint", "sqrt", "hypot", "exp", "expm1", "log", "log1p", "sin", "cos", "tan", "arcsin", "arccos",
    "arctan", "arctan2", "sinh", "cosh", "tanh",
))  # fmt: skip
"""Operations on numbers that give a number, by their numpy names."""

COMPARISONS = frozenset(("less", "less_equal", "equal"))
"""Operations on two numbers that give a truth value."""

LOGICAL = frozenset(("logical_and", "logical_or", "logical_not"))
"""Operations on truth values."""

DOMAIN: Arithmetic = {
    "divide": lambda a, b: b != 0,
    "remainder": lambda a, b: b != 0,
    "power": lambda a, b: (a > 0) | ((a == 0) & (b >= 0)) | ((a < 0) & (b % 1 == 0)),
    "sqrt": lambda a: a >= 0,
    "log": lambda a: a > 0,
    "log1p": lambda a: a > -1,
    "arcsin": lambda a: abs(a) <= 1,
    "arccos": lambda a: abs(a) <= 1,
}
"""Whether an operation on given numbers gives a number, as functions; operations that are not listed always do."""


@dataclass(frozen=True)
class Operation:
    """One operation: ``operands`` are the indices of earlier steps, whose values it takes, ``fixed`` other arguments.

    In addition to the operations above there are: ``input`` (fixed: its index among the inputs), ``constant`` (fixed: a
    float64 or a bool), ``parameter`` (fixed: a float64 and its name; only if a formula was given a ``Parameter``),
    ``varied`` (fixed: a float64 and its derivatives by parameters; only if a formula was given a ``Varied`` number),
    ``where``, ``stop_gradient`` (its operand, without derivatives), ``roundoff`` (of the arithmetic of the evaluation:
    2**-53 in float64), ``least_root`` (the least positive root of the polynomial with its operands as coefficients, inf
    without one), ``searchsorted`` (of a number in a table; fixed: the ascending table and numpy's side), ``take``
    (a table's entry at an integer; fixed: the table), ``loop`` (of its initial state; fixed: its body and the largest
    number of repetitions) and ``part`` (of a loop; fixed: the index of a value in its last state).
    """

    operation: str
    operands: tuple[int, ...] = ()
    fixed: tuple = ()
    truth: bool = False
    """Whether the value is a truth value instead of a number."""


@dataclass(frozen=True)
class Record:
    """The operations of a formula: ``steps`` in order, and the indices of the steps whose values it returns.

    The body of a loop takes the state as inputs, and returns the next state and whether it is settled.
    """

    steps: tuple[Operation, ...]
    outputs: tuple[int, ...]

    def evaluate(self, arithmetic: Arithmetic, inputs: Sequence) -> tuple:
        """Return the outputs at these inputs, numbers or arrays, computed with the functions of an arithmetic.

        The arithmetic has a function for each operation except ``input``, ``loop`` and ``part``, which takes the
        operands and then the fixed arguments; and ``all``, which tells from the last output of a loop's body whether
        the loop is settled. It may have its own ``loop``, of the body, the largest number of repetitions and the state.
        """
        values: list[Any] = []
        for k, step in enumerate(self.steps):
            operands = [values[index] for index in step.operands]
            for index in step.operands:
                if self._last[index] == k:  # so that the memory of large arrays is soon reused
                    values[index] = None
            if step.operation == "input":
                values.append(inputs[step.fixed[0]])
            elif step.operation == "part":
                values.append(operands[0][step.fixed[0]])
            elif step.operation == "loop":
                values.append(arithmetic.get("loop", partial(repeat_body, arithmetic))(*step.fixed, operands))
            else:
                values.append(arithmetic[step.operation](*operands, *step.fixed))
            del operands
        return tuple(values[index] for index in self.outputs)

    @cached_property
    def _last(self) -> dict[int, int]:
        """The index of the last step that needs each value; the number of steps for outputs."""
        last = {index: k for k, step in enumerate(self.steps) for index in step.operands}
        return last | dict.fromkeys(self.outputs, len(self.steps))

    def as_body(self, arithmetic: Arithmetic) -> Callable:
        """Return this record of a loop's body as the function that ``repeat`` takes."""

        def body(*state):
            *after, settled = self.evaluate(arithmetic, state)
            return tuple(after), settled

        return body


def needed(steps: Sequence[Operation], outputs: Sequence[int]) -> Record:
    """Return the record of these outputs, without unneeded steps."""
    kept = set(outputs)
    for index in reversed(range(len(steps))):
        if index in kept:
            kept.update(steps[index].operands)
    new = {old: index for index, old in enumerate(sorted(kept))}
    moved = (replace(steps[old], operands=tuple(new[k] for k in steps[old].operands)) for old in new)
    return Record(tuple(moved), tuple(new[index] for index in outputs))


def repeat_body(arithmetic: Arithmetic, body: Record, limit: int, state: Sequence) -> Sequence:
    """Return the last state of a loop whose body is a record; see ``repeat``."""
    return repeat(body.as_body(arithmetic), state, limit, arithmetic["all"])


def repeat(body: Callable, state: Sequence, limit: int, settled_all: Callable) -> Sequence:
    """Repeat ``state, settled = body(*state)`` until all is settled, at most ``limit`` times; return the last state."""
    for _ in range(limit):
        state, settled = body(*state)
        if settled_all(settled):
            break
    return state


def _take(places, table):
    """Return a table's entries at integers that are stored as float64; NaN at NaN."""
    known = ~np.isnan(places)
    return np.where(known, np.asarray(table)[np.where(known, places, 0.0).astype(np.intp)], np.nan)


NUMPY: Arithmetic = {
    **{name: getattr(np, name) for name in NUMERIC | COMPARISONS | LOGICAL | {"where", "all"}},
    "constant": lambda value: value,
    "parameter": lambda value, name: value,
    "varied": lambda value, slopes: value,
    "roundoff": lambda: EPS,
    "stop_gradient": lambda a: a,
    "least_root": lambda *coefficients: least_root(coefficients),
    "searchsorted": lambda number, table, side: np.searchsorted(table, number, side).astype(np.float64),
    "take": _take,
}
"""The arithmetic of float64, for arrays that broadcast. numpy also warns of invalid values in branches not taken."""
