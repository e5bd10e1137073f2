"""Numbers that record: they support Python's operators and numpy's functions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from inspect import signature
from numbers import Real
from typing import Any, NoReturn

import numpy as np

from ...conventions import EPS
from .. import polynomials
from .entries import Entries
from .record import COMPARISONS, LOGICAL, NUMERIC, Operation, Record, needed, repeat
from .varied import Varied


class Parameter(float):
    """A constant with a name in records: it becomes a step ``parameter``, which no other constant shares."""

    def __new__(cls, value: float, name: str):
        """Return the number with this name."""
        number = super().__new__(cls, value)
        number.name = name
        return number

    name: str


class NotRecordable(TypeError):
    """Raised for an operation on a recorded number that a record does not have; the message names it."""


def record(function: Callable, count: int) -> Record:
    """Return the record of a function of ``count`` numbers that returns a flat sequence of numbers.

    Numbers that do not depend on the input are recorded as exact constants. Raises NotRecordable.
    """
    tape = Tape()
    return tape.record(function(*(tape.add("input", fixed=(index,)) for index in range(count))))


def is_recorded(*values) -> bool:
    """Return whether one of the values is a recorded number."""
    return any(isinstance(value, Recorded) for value in values)


def tape_of(*values) -> Tape:
    """Return the tape that records an operation on values, one of which is recorded: in a loop's body that of the
    loop, unless all recorded values are known.
    """
    recorded = [value for value in values if is_recorded(value)]
    return next((value for value in recorded if not value.is_known), recorded[0]).tape


def loop(body: Callable, state: Sequence, limit: int) -> Sequence:
    """Repeat ``state, settled = body(*state)`` until all is settled, at most ``limit`` times; return the last state.

    state: numbers, arrays or recorded numbers; all entries of arrays continue until the last is settled. For recorded
    numbers the body is called once, and must take everything that it needs from its state, except constants and what
    depends on parameters alone.
    """
    if not is_recorded(*state):
        return repeat(body, state, limit, np.all)
    tape = tape_of(*state)
    start = [tape.own(value, "a loop") for value in state]
    inner = Tape(varies=False, outer=tape, state=len(start))
    after, settled = body(*(inner.add("input", fixed=(i,), truth=value.truth) for i, value in enumerate(start)))
    after = [inner.own(value, "a loop") for value in after]
    if [value.truth for value in after] != [value.truth for value in start]:
        raise NotRecordable("a loop whose state is a number once, and true or false once, cannot be recorded")
    settled = inner.truth(settled, "a loop")
    taken = [Recorded(tape, index) for index in inner.taken]
    made = tape.add("loop", [*start, *taken], (inner.record([*after, *inner.taken.values(), settled]), limit))
    return tuple(tape.add("part", [made], (i,), value.truth) for i, value in enumerate(start))


def look_up(table, index):
    """Return the entry of a table, (n,) float64, at an integer or an array of integers: ``table[place]``."""
    return index.tape.add("take", [index], (_entries(table),)) if is_recorded(index) else table[index]


def may_hold(condition) -> bool:
    """Return whether a condition holds for any entry of an array; True for a recorded condition. A formula may skip
    work that no entry needs, if the work would leave all numbers as they are.
    """
    return is_recorded(condition) or bool(np.any(condition))


def stop_gradient(number):
    """Return a number without its derivatives, to start an iteration to a root: one more step of Newton's method after
    the iteration then gives the derivatives of the root.
    """
    return number.tape.add("stop_gradient", [number]) if is_recorded(number) else number


def least_root(coefficients: Sequence):
    """Return the least positive root of a polynomial, inf without one; coefficients, recorded or not, ascend."""
    if not is_recorded(*coefficients):
        return polynomials.least_root(coefficients)
    tape = tape_of(*coefficients)
    return tape.add("least_root", [tape.own(value, "least_root") for value in coefficients])


def roundoff(number):
    """Return the unit roundoff of the arithmetic in which a number is computed: EPS, or a recorded number."""
    return number.tape.add("roundoff") if is_recorded(number) else EPS


class Tape:
    """The steps of a record under construction."""

    def __init__(self, varies: bool = True, outer: Tape | None = None, state: int = 0):
        self._varies = varies  # whether varied numbers keep their derivatives
        self.outer, self.state = outer, state
        self.taken: dict[int, Recorded] = {}
        """Inputs beyond the state of a loop's body, by the places of these numbers in the outer tape."""
        self.steps: list[Operation] = []
        self._known: dict[tuple, int] = {}

    def add(self, operation: str, operands: Sequence[Recorded] = (), fixed: tuple = (), truth: bool = False):
        """Return the value of an operation; if the tape has the same step already, that step is used again."""
        places = tuple(operand.index for operand in operands)
        index = self._known.setdefault((operation, places, repr(fixed)), len(self.steps))  # 0.0 and -0.0 differ
        if index == len(self.steps):
            self.steps.append(Operation(operation, places, fixed, truth))
        return Recorded(self, index)

    def own(self, value, operation: str) -> Recorded:
        """Return an operand of an operation: a number that this tape has recorded, or a constant."""
        if is_recorded(value):
            if value.tape is not self and self.outer is not None and value.is_known:
                index = self.outer.own(value, operation).index
                if index not in self.taken:
                    self.taken[index] = self.add("input", (), (self.state + len(self.taken),), value.truth)
                return self.taken[index]
            if value.tape is not self:
                raise NotRecordable(f"{operation} of a number that is not in the loop's state cannot be recorded")
            return value
        if isinstance(value, Parameter):
            return self.add("parameter", fixed=(float(value), value.name))
        if isinstance(value, Varied) and self._varies:
            return self.add("varied", fixed=(float(value), value.slopes))
        if isinstance(value, bool | np.bool_):
            return self.add("constant", fixed=(bool(value),), truth=True)
        if np.ndim(value) or not isinstance(np.asarray(value).item(), Real):
            raise NotRecordable(f"{operation} of a recorded number and {type(value).__name__} cannot be recorded")
        return self.add("constant", fixed=(float(value),))

    def number(self, value, operation: str) -> Recorded:
        """Return an operand as a number: 1 for true, 0 for false."""
        value = self.own(value, operation)
        return _where(value, 1.0, 0.0) if value.truth else value

    def truth(self, value, operation: str) -> Recorded:
        """Return an operand as a truth value: a number is true unless it is 0."""
        value = self.own(value, operation)
        return value if value.truth else value != 0

    def record(self, values) -> Record:
        """Return the record of values, without unneeded steps."""
        return needed(self.steps, [self.own(value, "an output").index for value in values])


def _operator(ufunc) -> Any:
    return lambda self, *other: ufunc(self, *other)


def _swapped(ufunc) -> Any:
    return lambda self, other: ufunc(other, self)


def _refused(operation: str, instead: str) -> Any:
    def refuse(self, *_) -> NoReturn:
        raise NotRecordable(f"{operation} of a recorded number cannot be recorded: {instead}")

    return refuse


class Recorded:
    """A number whose value is known only when its record is evaluated; a scalar for numpy."""

    ndim, shape, size = 0, (), 1
    is_known = False
    """Whether the value is known, since it depends on parameters alone: see ``known``."""

    def __init__(self, tape: Tape, index: int):
        self.tape, self.index = tape, index

    @property
    def truth(self) -> bool:
        """Whether the value is a truth value instead of a number."""
        return self.tape.steps[self.index].truth

    def __array_ufunc__(self, ufunc, method, *operands, **options):
        name = ufunc.__name__
        if method != "__call__" or options:
            raise NotRecordable(f"{name}{_more(method, options)} of a recorded number cannot be recorded")
        name, tape = SAME.get(name, name), tape_of(*operands)
        operands = tuple(tape.own(operand, name) for operand in operands)
        if name in DERIVED:
            return DERIVED[name](*operands)
        if name in LOGICAL:
            return tape.add(name, [tape.truth(operand, name) for operand in operands], truth=True)
        if name in NUMERIC or name in COMPARISONS:
            numbers = [tape.number(operand, name) for operand in operands]
            return tape.add(name, numbers, truth=name in COMPARISONS)
        raise NotRecordable(f"{name} of a recorded number cannot be recorded")

    def __array_function__(self, function, types, operands, options):
        handler = FUNCTIONS.get(function)
        if handler is None:
            raise NotRecordable(f"{function.__name__} of a recorded number cannot be recorded")
        try:
            signature(handler).bind(*operands, **options)
        except TypeError as error:
            raise NotRecordable(f"{function.__name__} with such arguments cannot be recorded: {error}") from error
        return handler(*operands, **options)

    __add__, __radd__ = _operator(np.add), _swapped(np.add)
    __sub__, __rsub__ = _operator(np.subtract), _swapped(np.subtract)
    __mul__, __rmul__ = _operator(np.multiply), _swapped(np.multiply)
    __truediv__, __rtruediv__ = _operator(np.divide), _swapped(np.divide)
    __mod__, __rmod__ = _operator(np.remainder), _swapped(np.remainder)
    __floordiv__, __rfloordiv__ = _operator(np.floor_divide), _swapped(np.floor_divide)
    __rpow__, __matmul__ = _swapped(np.power), _operator(np.matmul)
    __and__, __rand__ = _operator(np.logical_and), _swapped(np.logical_and)
    __or__, __ror__ = _operator(np.logical_or), _swapped(np.logical_or)
    __lt__, __le__, __gt__ = _operator(np.less), _operator(np.less_equal), _operator(np.greater)
    __ge__, __eq__, __ne__ = _operator(np.greater_equal), _operator(np.equal), _operator(np.not_equal)
    __neg__, __pos__, __abs__ = _operator(np.negative), _operator(np.positive), _operator(np.absolute)
    __invert__ = _operator(np.logical_not)
    __hash__ = None  # type: ignore[assignment]

    __bool__ = _refused("truth (if, and, or, not, min, max)", "write np.where, &, |, ~, np.minimum, np.maximum")
    __float__ = __int__ = __index__ = _refused("float or int", "use numpy's functions; read a table with look_up")
    __array__ = _refused("asarray", "it is one number; read a table with look_up")
    __iter__ = __len__ = __getitem__ = _refused("a part", "it is one number")

    def __pow__(self, exponent):
        """Return a product for the exponent 2, as numpy does for arrays."""
        return self * self if not is_recorded(exponent) and exponent == 2 else np.power(self, exponent)

    def __getattr__(self, name: str):
        if name.startswith("_"):  # numpy looks for such attributes
            raise AttributeError(name)
        raise NotRecordable(f".{name} of a recorded number cannot be recorded: use numpy's functions")


SAME = {"bitwise_and": "logical_and", "bitwise_or": "logical_or", "invert": "logical_not", "true_divide": "divide"}
"""Alternative names of operations."""

DERIVED: dict[str, Callable] = {
    "greater": lambda a, b: np.less(b, a),
    "greater_equal": lambda a, b: np.less_equal(b, a),
    "not_equal": lambda a, b: ~np.equal(a, b),
    "isnan": lambda a: ~np.equal(a, a),
    "isfinite": lambda a: np.absolute(a) < np.inf,
    "square": lambda a: a * a,
    "reciprocal": lambda a: 1.0 / a,
    "positive": lambda a: a,
}
"""Operations that are recorded by means of others."""


def _where(condition, yes, no):
    tape = tape_of(condition, yes, no)
    condition, yes, no = tape.truth(condition, "where"), tape.own(yes, "where"), tape.own(no, "where")
    truth = yes.truth and no.truth
    if not truth:
        yes, no = tape.number(yes, "where"), tape.number(no, "where")
    return tape.add("where", [condition, yes, no], truth=truth)


def _searchsorted(table, number, side="left"):
    if not is_recorded(number):
        raise NotRecordable("searchsorted in a table of recorded numbers cannot be recorded")
    return number.tape.add("searchsorted", [number], (_entries(table), side))


def _entries(table) -> Sequence[float]:
    return table if isinstance(table, Entries) else tuple(np.asarray(table, np.float64).tolist())


def _more(method: str, options) -> str:
    return f".{method}" if method != "__call__" else f" with {', '.join(options)}"


FUNCTIONS: dict[Any, Callable] = {
    np.where: _where,
    np.clip: lambda number, low, high: np.minimum(np.maximum(number, low), high),
    np.searchsorted: _searchsorted,
    np.broadcast_arrays: lambda *numbers: list(numbers),
    np.ndim: lambda number: 0,
    np.shape: lambda number: (),
    np.zeros_like: lambda number: 0.0,
    np.ones_like: lambda number: 1.0,
}
"""Supported functions of numpy that are not ufuncs."""
