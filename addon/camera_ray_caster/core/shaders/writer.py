"""A record of a formula, written as statements of a programming language: what all such languages share.

A language is a subclass of ``Writer``: its names of types, the text of each operation, and the functions that it lacks.
If it has no NaN, each value is accompanied by a truth value that tells whether the value is undefined.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar, NamedTuple, Protocol

from ..maths.recording import Operation, Record

C_FUNCTIONS = {
    "add": "{} + {}", "subtract": "{} - {}", "multiply": "{} * {}", "divide": "{} / {}", "negative": "-{}",
    "remainder": "{0} - {1} * floor({0} / {1})", "power": "pow({}, {})", "absolute": "abs({})", "sign": "sign({})",
    "minimum": "min({}, {})", "maximum": "max({}, {})", "floor": "floor({})", "ceil": "ceil({})",
    "rint": "rint({})", "sqrt": "sqrt({})", "hypot": "hypot({}, {})", "exp": "exp({})", "expm1": "expm1({})",
    "log": "log({})", "log1p": "log1p({})", "sin": "sine({})", "cos": "cosine({})", "tan": "tan({})",
    "arcsin": "asin({})", "arccos": "acos({})", "arctan": "atan({})", "arctan2": "atan2({}, {})",
    "sinh": "sinh({})", "cosh": "cosh({})", "tanh": "tanh({})", "less": "{} < {}", "less_equal": "{} <= {}",
    "equal": "{} == {}", "logical_and": "{} && {}", "logical_or": "{} || {}", "logical_not": "!{}",
    "where": "{} ? {} : {}",
}  # fmt: skip
"""Text of each operation in languages like C."""

C_ABSENT = {
    "divide": "{1} == 0.0", "remainder": "{1} == 0.0", "sqrt": "{0} < 0.0", "log": "{0} <= 0.0",
    "log1p": "{0} <= -1.0", "arcsin": "abs({0}) > 1.0", "arccos": "abs({0}) > 1.0",
    "power": "({0} < 0.0 && {1} != floor({1})) || ({0} == 0.0 && {1} < 0.0)",
}  # fmt: skip
"""Conditions under which an operation is undefined, in languages without NaN: the opposite of ``recording.DOMAIN``."""

C_HELPERS = {
    "sin": """\
float sine(float x)
{
    float turns = floor(x * 0.318309886 + 0.5);
    float r = (x - turns * 3.140625) - turns * 0.000967653590, s = r * r;
    float sum = -1.66666667e-1 + s * (8.33333333e-3 + s * (-1.98412698e-4 + s * (2.75573192e-6 - s * 2.50521084e-8)));
    return (turns - 2.0 * floor(0.5 * turns) == 1.0 ? -1.0 : 1.0) * (r + r * (s * sum));
}
""",
    "cos": """\
float cosine(float x)
{
    return sine(1.57079633 - abs(x));
}
""",
    "rint": """\
float rint(float x)
{
    float low = floor(x), part = x - low;
    return part > 0.5 || (part == 0.5 && low - 2.0 * floor(0.5 * low) == 1.0) ? low + 1.0 : low;
}
""",
    "log1p": """\
float log1p(float x)
{
    float y = 1.0 + x;
    return y == 1.0 ? x : log(y) * (x / (y - 1.0));
}
""",
}
"""Functions that languages like C lack in float32, or do not compute to its last digits: OSL's sine is off by up to
1e-6. ``sine`` subtracts half turns in two parts, the first of which times a small whole number is exact; its sum is
Taylor's, to 6e-8. ``log1p`` is W. Kahan's: it compensates the rounding of 1 + x.
"""

LEAST_CONSTANT, LARGEST_CONSTANT = 1e-30, 3e38
"""Range of the magnitudes of float32 constants, within its full precision; others are clipped to it."""


class Term(NamedTuple):
    """A value in the text: an expression, and the condition under which it is undefined, "" for never."""

    text: str
    none: str = ""


class Constants(Protocol):
    """What gives the constants of a record their text."""

    def named(self, name: str, value: float) -> str:
        """Return the text of a parameter."""

    def number(self, value: float) -> str:
        """Return the text of a constant."""


@dataclass
class Writer(ABC):
    """Writer of the statements of one function."""

    constants: Constants
    lines: list[str] = field(default_factory=list)
    tables: list[str] = field(default_factory=list)
    """Statements that precede the others."""
    helpers: set[str] = field(default_factory=set)
    """Operations whose HELPERS the text needs."""
    _tables: dict[Sequence[float], str] = field(default_factory=dict)
    _count: int = 0
    _indent: str = "    "

    NUMBER: ClassVar[str] = "float"
    TRUTH: ClassVar[str] = "bool"
    INDEX: ClassVar[str] = "int"
    """Names of the types of numbers, truth values and places in tables."""
    NO: ClassVar[str] = "false"
    YES: ClassVar[str] = "true"
    TO_NUMBER: ClassVar[str] = "float({})"
    TO_INDEX: ClassVar[str] = "int({})"
    FUNCTIONS: ClassVar[Mapping[str, str]] = C_FUNCTIONS
    """Text of each operation."""
    ABSENT: ClassVar[Mapping[str, str]] = C_ABSENT
    """Conditions under which an operation is undefined; empty for a language with NaN."""
    HELPERS: ClassVar[Mapping[str, str]] = C_HELPERS
    """Functions for operations that the language lacks, in an order in which they may call those before."""
    NEEDED_BY: ClassVar[Mapping[str, tuple[str, ...]]] = {"cos": ("sin",)}
    """Helpers that are called by other helpers."""
    EPS: ClassVar[float] = 2.0**-24
    """Unit roundoff of the language's numbers."""

    def put(self, kind: str, text: str) -> str:
        """Write a statement that gives a new name a value; return the name."""
        self._count += 1
        name = f"{'v' if kind == self.NUMBER else 'is'}{self._count}"
        self.line(f"{kind} {name} = {text};")
        return name

    def line(self, text: str) -> None:
        """Write a line."""
        self.lines.append(self._indent + text)

    def write(self, record: Record, inputs: Sequence[Term]) -> list[Term]:
        """Write the steps of a record, applied to these inputs; return its outputs."""
        values: list[Any] = []
        for step in record.steps:
            operands = [values[index] for index in step.operands]
            values.append(getattr(self, METHODS.get(step.operation, "_function"))(step, operands, inputs))
        return [values[index] for index in record.outputs]

    def helper_texts(self) -> list[str]:
        """Return the text of the helpers that are needed."""
        return [text for name, text in self.HELPERS.items() if name in self.helpers]

    @staticmethod
    def literal(value: float) -> str:
        """Return the text of a finite number, to float32's last digit, or of an infinite one."""
        text = f"{in_range(value):.9g}"
        text += "" if set(text) & set(".e") else ".0"
        return f"({text})" if value < 0 else text

    def table(self, entries: Sequence[float]) -> str:
        """Write a table unless it exists; return its name."""
        if entries not in self._tables:
            self._count += 1
            name = self._tables[entries] = f"table{self._count}"
            self.tables.append(self.table_text(name, entries))
        return self._tables[entries]

    @abstractmethod
    def table_text(self, name: str, entries: Sequence[float]) -> str:
        """Return the statement that defines a table."""

    def either(self, *conditions: str) -> str:
        """Return the condition that at least one of these conditions holds."""
        distinct = sorted({condition for condition in conditions if condition})
        if self.YES in distinct:
            return self.YES
        return self.put(self.TRUTH, " || ".join(distinct)) if len(distinct) > 1 else distinct[0] if distinct else ""

    def _function(self, step: Operation, operands: list[Term], _) -> Term:
        texts, none = [operand.text for operand in operands], self.either(*(operand.none for operand in operands))
        operation = step.operation
        self.helpers |= {operation, *self.NEEDED_BY.get(operation, ())} & self.HELPERS.keys()
        if step.truth:
            value = self.put(self.TRUTH, self.FUNCTIONS[operation].format(*texts))
            if none and none != self.YES:
                value = self.put(self.TRUTH, f"!{none} && {value}")
            return Term(self.NO if none == self.YES else value)
        if operation in self.ABSENT and not (operation == "divide" and texts[1][0] in "(123456789"):
            none = self.either(none, self.put(self.TRUTH, self.ABSENT[operation].format(*texts)))
        return Term(self.put(self.NUMBER, self.FUNCTIONS[operation].format(*texts)), none)

    def _input(self, step: Operation, _, inputs: Sequence[Term]) -> Term:
        return inputs[step.fixed[0]]

    def _constant(self, step: Operation, *_) -> Term:
        (value,) = step.fixed
        if step.truth:
            return Term(self.YES if value else self.NO)
        return self.undefined() if math.isnan(value) else Term(self.constants.number(value))

    def undefined(self) -> Term:
        """Return the value that is undefined."""
        return Term("0.0", self.YES)

    def _parameter(self, step: Operation, *_) -> Term:
        value, name = step.fixed
        return Term(self.constants.named(name, value))

    def _roundoff(self, *_) -> Term:
        return Term(self.literal(self.EPS))

    def _where(self, step: Operation, operands: list[Term], _) -> Term:
        condition, yes, no = operands
        kind = self.TRUTH if step.truth else self.NUMBER
        value = self.put(kind, self.FUNCTIONS["where"].format(condition.text, yes.text, no.text))
        if yes.none == no.none:
            return Term(value, yes.none)
        nones = yes.none or self.NO, no.none or self.NO
        return Term(value, self.put(self.TRUTH, self.FUNCTIONS["where"].format(condition.text, *nones)))

    def _searchsorted(self, step: Operation, operands: list[Term], _) -> Term:
        """Write a binary search for the number of entries below a value (left), or not above it (right)."""
        (value,), (entries, side) = operands, step.fixed
        table, comparison = self.table(entries), "<" if side == "left" else "<="
        low = self.put(self.INDEX, "0")
        high, middle = self.put(self.INDEX, str(len(entries))), f"middle{self._count}"
        self.line(f"while ({low} < {high}) {{")
        self.line(f"    int {middle} = ({low} + {high}) / 2;")
        self.line(f"    if ({table}[{middle}] {comparison} {value.text}) {low} = {middle} + 1;")
        self.line(f"    else {high} = {middle};")
        self.line("}")
        return Term(self.put(self.NUMBER, self.TO_NUMBER.format(low)), value.none)

    def _take(self, step: Operation, operands: list[Term], _) -> Term:
        (index,), (entries,) = operands, step.fixed
        return Term(self.put(self.NUMBER, f"{self.table(entries)}[{self.TO_INDEX.format(index.text)}]"), index.none)

    def _loop(self, step: Operation, operands: list[Term], _) -> list[Term]:
        body, limit = step.fixed
        kinds = [self.TRUTH if inner.truth else self.NUMBER for inner in _inputs_of(body, len(operands))]
        state = [
            Term(self.put(kind, start.text), self.put(self.TRUTH, start.none or self.NO) if self.ABSENT else "")
            for kind, start in zip(kinds, operands, strict=True)
        ]
        count = f"i{self._count}"
        self.line(f"for ({self.INDEX} {count} = 0; {count} < {limit}; {count}++) {{")
        before, self._indent = self._indent, self._indent + "    "
        *after, settled = self.write(body, state)
        kept = [self.put(kind, value.text) for kind, value in zip(kinds, after, strict=True)]
        for variable, value, name in zip(state, after, kept, strict=True):
            self.line(f"{variable.text} = {name};")
            if variable.none:
                self.line(f"{variable.none} = {value.none or self.NO};")
        self.line(f"if ({settled.text}) break;")
        self._indent = before
        self.line("}")
        return state

    def _part(self, step: Operation, operands, _) -> Term:
        return operands[0][step.fixed[0]]

    def _stop_gradient(self, step: Operation, operands: list[Term], _) -> Term:
        return operands[0]


METHODS = {
    name: f"_{name}" for name in (
        "input", "constant", "parameter", "where", "roundoff", "searchsorted", "take", "loop", "part", "stop_gradient",
        "least_root",
    )
}  # fmt: skip
"""Names of the methods that write the steps that are not plain functions."""


def _inputs_of(body: Record, count: int) -> list[Operation]:
    """Return the input step of each input of a loop's body; a numeric one if the body does not use the input."""
    inputs = {step.fixed[0]: step for step in body.steps if step.operation == "input"}
    return [inputs.get(index, Operation("input", fixed=(index,))) for index in range(count)]


def in_range(value: float) -> float:
    """Return a number clipped to a magnitude that float32 rounds neither to zero nor to infinity; 0 stays 0."""
    size = min(max(abs(value), LEAST_CONSTANT), LARGEST_CONSTANT) if value else 0.0
    return math.copysign(size, value)
