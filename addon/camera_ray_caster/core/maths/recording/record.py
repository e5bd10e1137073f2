"""The record of a formula: its operations in order, each value computed once, and their evaluation.

What is no number
    A pixel without a ray has none: NaN in numpy. In a record it comes from a constant NaN, or from an operation outside
    of its DOMAIN. From there it spreads: an operation on it gives no number, a comparison with it is false. ``where``
    takes the value of one branch alone, whatever the other is. Division by zero gives no number here, though numpy may
    say infinity: formulas do not rely on it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any

import numpy as np

from ...conventions import EPS

Arithmetic = Mapping[str, Callable]
"""Functions by the names of operations."""

NUMERIC = frozenset((
    "add", "subtract", "multiply", "divide", "remainder", "power", "negative", "absolute", "sign", "minimum", "maximum",
    "floor", "ceil", "rint", "sqrt", "hypot", "exp", "expm1", "log", "log1p", "sin", "cos", "tan", "arcsin", "arccos",
    "arctan", "arctan2", "sinh", "cosh", "tanh",
))  # fmt: skip
"""Operations on numbers that give a number, by their numpy names."""

COMPARISONS = frozenset(("less", "less_equal", "equal"))
"""Of two numbers: true or false."""

LOGICAL = frozenset(("logical_and", "logical_or", "logical_not"))
"""Of what is true or false."""

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
"""Whether an operation on these numbers gives a number; operations that are not listed always do."""


@dataclass(frozen=True)
class Step:
    """One operation. Its operands are the values of earlier steps, by their places; ``fixed`` is what else it takes.

    Beside the operations above: ``input`` (fixed: its place among the inputs), ``constant`` (a float64, or a bool),
    ``parameter`` (a float64 and its name; only where a formula was given a ``Parameter``), ``where``,
    ``stop_gradient`` (its operand, without derivatives), ``roundoff`` (of the arithmetic it is evaluated with: 2**-53
    in float64), ``searchsorted`` (of a number in a table; fixed: the table, ascending, and numpy's side), ``take`` (a
    table's entry at a whole number; fixed: the table), ``loop`` (of the values it starts from; fixed: its body and the
    most repetitions) and ``part`` (of a loop: the value of its state that stands at the fixed place).
    """

    operation: str
    operands: tuple[int, ...] = ()
    fixed: tuple = ()
    truth: bool = False
    """Whether the value is true or false, and not a number."""


@dataclass(frozen=True)
class Record:
    """What a formula does: ``steps`` in order, and the places of those whose values it returns.

    The body of a loop has the state for inputs, and returns the next one and whether it is settled.
    """

    steps: tuple[Step, ...]
    outputs: tuple[int, ...]

    def evaluate(self, arithmetic: Arithmetic, inputs: Sequence) -> tuple:
        """Return the outputs at these inputs, numbers or arrays, as the functions of an arithmetic give them.

        The arithmetic has a function for each operation but ``input``, ``loop`` and ``part``, which takes the operands
        and then what is fixed; and ``all``, which says of a loop's last truth whether it is settled. It may have a
        ``loop`` of its own, which takes the body, the most repetitions and the state.
        """
        values: list[Any] = []
        for k, step in enumerate(self.steps):
            operands = [values[place] for place in step.operands]
            for place in step.operands:
                if self._last[place] == k:  # large arrays are soon used again
                    values[place] = None
            if step.operation == "input":
                values.append(inputs[step.fixed[0]])
            elif step.operation == "part":
                values.append(operands[0][step.fixed[0]])
            elif step.operation == "loop":
                values.append(arithmetic.get("loop", partial(repeat_body, arithmetic))(*step.fixed, operands))
            else:
                values.append(arithmetic[step.operation](*operands, *step.fixed))
            del operands
        return tuple(values[place] for place in self.outputs)

    @cached_property
    def _last(self) -> dict[int, int]:
        """The last step that needs each value; none does an output's."""
        last = {place: k for k, step in enumerate(self.steps) for place in step.operands}
        return last | dict.fromkeys(self.outputs, len(self.steps))

    def as_body(self, arithmetic: Arithmetic) -> Callable:
        """Return the function that ``repeat`` takes, of a loop's body."""

        def body(*state):
            *after, settled = self.evaluate(arithmetic, state)
            return tuple(after), settled

        return body


def repeat_body(arithmetic: Arithmetic, body: Record, most: int, state: Sequence) -> Sequence:
    """Return what a loop gives, whose body is a record; see ``repeat``."""
    return repeat(body.as_body(arithmetic), state, most, arithmetic["all"])


def repeat(body: Callable, state: Sequence, most: int, settled_all: Callable) -> Sequence:
    """Repeat ``state, settled = body(*state)`` until all is settled, or as often as ``most``; return the last state."""
    for _ in range(most):
        state, settled = body(*state)
        if settled_all(settled):
            break
    return state


def _take(places, table):
    """Return entries at whole numbers that are stored as float64; no number has none."""
    known = ~np.isnan(places)
    return np.where(known, np.asarray(table)[np.where(known, places, 0.0).astype(np.intp)], np.nan)


NUMPY: Arithmetic = {
    **{name: getattr(np, name) for name in NUMERIC | COMPARISONS | LOGICAL | {"where", "all"}},
    "constant": lambda value: value,
    "parameter": lambda value, name: value,
    "roundoff": lambda: EPS,
    "stop_gradient": lambda a: a,
    "searchsorted": lambda number, table, side: np.searchsorted(table, number, side).astype(np.float64),
    "take": _take,
}
"""Float64, in arrays of any shapes that broadcast. numpy warns where a branch that is not taken is no number."""
