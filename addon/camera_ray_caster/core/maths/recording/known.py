"""Recorded numbers whose values are known: a camera's settings, and what is computed from them.

A formula that begins with settings branches on them: on the lens's own limits, on the longer side of the frame. Such
numbers have a value beside their step, by which branches are taken. The record has the conditions of these branches as
further outputs: where they hold, the record is that of the formula. Two numbers count as different unless they are the
same step, and a number as neither 0 nor infinite: formulas leave out terms that are 0 and limits that are infinite, and
are the same with these.
"""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np

from .number import Parameter, Recorded, Tape
from .record import NUMERIC, NUMPY, Record


def record_known(function: Callable, settings: Mapping[str, float], count: int) -> Record:
    """Return the record of ``function(settings, *inputs)``, which returns a flat sequence of numbers.

    settings: numbers by name, which become steps ``parameter``; the function gets them as recorded numbers. count:
    number of inputs. The outputs are those of the function, then the conditions of the branches that it took, truth
    values that are true at these settings. Raises NotRecordable.
    """
    tape = KnownTape()
    numbers = {name: tape.own(Parameter(value, name), "a setting") for name, value in settings.items()}
    values = list(function(numbers, *(tape.add("input", fixed=(index,)) for index in range(count))))
    return tape.record([*values, *tape.conditions.values()])


class KnownTape(Tape):
    """A tape that knows the values of the steps that depend on no input."""

    def __init__(self):
        super().__init__()
        self.values: dict[int, Any] = {}
        self.varying: set[int] = set()
        """Places of the steps that depend on parameters."""
        self.conditions: dict[int, Recorded] = {}
        """What held where a branch was taken, by place."""

    def add(self, operation, operands=(), fixed=(), truth=False):
        """See Tape; the number is a Known one if its operands are."""
        if operation == "multiply":
            for operand, factor_of in (operands, operands[::-1]):
                factor = self._constant(operand)
                if factor in (0.0, 1.0) and factor_of.is_known:
                    return operand if factor == 0 else factor_of
        if operation in ("add", "subtract") and self._constant(operands[1]) == 0:
            return operands[0]
        if operation == "add" and self._constant(operands[0]) == 0:
            return operands[1]
        made = super().add(operation, operands, fixed, truth)
        index = made.index
        if operation in ("input", "loop", "part") or not all(operand.index in self.values for operand in operands):
            return made
        if index not in self.values:
            with np.errstate(all="ignore"):  # NaN is a value of branches that are not taken
                self.values[index] = NUMPY[operation](*(self.values[operand.index] for operand in operands), *fixed)
            if operation == "parameter" or any(operand.index in self.varying for operand in operands):
                self.varying.add(index)
        return Known(self, index)

    def _constant(self, number: Recorded) -> float | None:
        step = self.steps[number.index]
        return step.fixed[0] if step.operation == "constant" else None

    def decide(self, index: int) -> bool:
        """Return whether a value is true, and keep the condition."""
        step, value = self.steps[index], self.values[index]
        if index not in self.varying:
            return bool(value)
        if not step.truth:
            return True
        if step.operation == "less" and self._constant(Known(self, step.operands[1])) == np.inf:
            return True
        if step.operation == "equal":
            return step.operands[0] == step.operands[1]
        if step.operation == "logical_not":
            return not self.decide(step.operands[0])
        if step.operation in ("logical_and", "logical_or"):
            first, second = map(self.decide, step.operands)
            return first and second if step.operation == "logical_and" else first or second
        holds = Known(self, index) if value else ~Known(self, index)
        self.conditions[holds.index] = holds
        return bool(value)


class Known(Recorded):
    """A recorded number whose value is known."""

    tape: KnownTape
    is_known = True

    def __bool__(self) -> bool:
        return self.tape.decide(self.index)

    @property
    def __array__(self):
        """numpy makes arrays of objects of such numbers."""
        raise AttributeError

    def __array_ufunc__(self, ufunc, method, *operands, **options):
        if method == "__call__" and not options and any(np.ndim(operand) for operand in operands):
            each = np.frompyfunc(lambda *numbers: ufunc(*numbers), len(operands), 1)
            return each(*map(_as_objects, operands))
        return super().__array_ufunc__(ufunc, method, *operands, **options)

    def __getattr__(self, name: str):
        if name in NUMERIC:  # numpy calls such methods of the objects in an array
            return partial(getattr(np, name), self)
        return super().__getattr__(name)


def _as_objects(operand) -> np.ndarray:
    array = np.empty(np.shape(operand), object)
    array[...] = operand
    return array
