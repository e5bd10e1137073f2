"""A record of a formula, written as statements of the Open Shading Language (OSL).

OSL has no NaN: a division by zero gives 0 there, and so does the root of a negative number. Each value is therefore
accompanied by an int that is 1 if the value is undefined. All numbers are float32.
Reference: Open Shading Language 1.14, Language Specification, chapters 5 and 7.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from ..maths.recording import Record, Step

FUNCTIONS = {
    "add": "{} + {}", "subtract": "{} - {}", "multiply": "{} * {}", "divide": "{} / {}", "negative": "-{}",
    "remainder": "{0} - {1} * floor({0} / {1})", "power": "pow({}, {})", "absolute": "fabs({})", "sign": "sign({})",
    "minimum": "min({}, {})", "maximum": "max({}, {})", "floor": "floor({})", "ceil": "ceil({})",
    "rint": "rint({})", "sqrt": "sqrt({})", "hypot": "hypot({}, {})", "exp": "exp({})", "expm1": "expm1({})",
    "log": "log({})", "log1p": "log1p({})", "sin": "sine({})", "cos": "cosine({})", "tan": "tan({})",
    "arcsin": "asin({})", "arccos": "acos({})", "arctan": "atan({})", "arctan2": "atan2({}, {})",
    "sinh": "sinh({})", "cosh": "cosh({})", "tanh": "tanh({})", "less": "{} < {}", "less_equal": "{} <= {}",
    "equal": "{} == {}", "logical_and": "{} && {}", "logical_or": "{} || {}", "logical_not": "!{}",
    "where": "{} ? {} : {}",
}  # fmt: skip
"""OSL text of each operation."""

ABSENT = {
    "divide": "{1} == 0.0", "remainder": "{1} == 0.0", "sqrt": "{0} < 0.0", "log": "{0} <= 0.0",
    "log1p": "{0} <= -1.0", "arcsin": "fabs({0}) > 1.0", "arccos": "fabs({0}) > 1.0",
    "power": "({0} < 0.0 && {1} != floor({1})) || ({0} == 0.0 && {1} < 0.0)",
}  # fmt: skip
"""Conditions under which an operation is undefined: the opposite of ``recording.DOMAIN``."""

HELPERS = {
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
    return sine(1.57079633 - fabs(x));
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
"""Functions that OSL lacks, or does not compute to float32's last digits: its sine is off by up to 1e-6. ``sine``
subtracts half turns in two parts, the first of which times a small whole number is exact; its sum is Taylor's, to 6e-8.
``log1p`` is W. Kahan's: it compensates the rounding of 1 + x.
"""

NEEDED_BY = {"cos": "sin"}
"""Helpers that are called by other helpers."""

LITERALS = frozenset((0.0, 0.5, 1.0, 2.0, 3.0, 4.0, math.pi / 2, math.pi, 2 * math.pi, math.inf))
"""Constants that are written in the text, as are their negatives: they belong to the formula and are not settings."""

LEAST, MOST = 1e-30, 3e38
"""Range of the magnitudes of constants, within float32's full precision; others are clipped to it."""

NEVER, ALWAYS = "0", "1"


class Term(NamedTuple):
    """A value in the text: an expression, and the condition under which it is undefined."""

    text: str
    none: str = NEVER


@dataclass
class Inputs:
    """The shader's inputs that stand for constants of a record, in the order of their first use.

    A constant with a name is an input of that name. An unnamed constant is written in the text if it is one of
    LITERALS; otherwise it is an input named after its place among the constants. The ``places`` are inputs in any case.
    """

    places: frozenset[int] = frozenset()
    values: dict[str, float] = field(default_factory=dict)
    used: set[int] = field(default_factory=set)
    """Places of the unnamed constants that are inputs."""
    _count: int = 0

    def named(self, name: str, value: float) -> str:
        """Set the value of an input; return its name."""
        self.values[name] = in_range(value)
        return name

    def number(self, value: float) -> str:
        """Return the text of a constant: its literal, or the name of its input."""
        self._count += 1
        place = self._count
        if abs(value) in LITERALS and place not in self.places:
            return literal(value)
        self.used.add(place)
        return self.named(f"c{place}", value)


@dataclass
class Writer:
    """Writer of the statements of a shader."""

    inputs: Inputs
    lines: list[str] = field(default_factory=list)
    tables: list[str] = field(default_factory=list)
    """Statements that precede the others."""
    helpers: set[str] = field(default_factory=set)
    _tables: dict[Sequence[float], str] = field(default_factory=dict)
    _count: int = 0
    _indent: str = "    "

    def put(self, kind: str, text: str) -> str:
        """Write a statement that gives a new name a value; return the name."""
        self._count += 1
        name = f"{'is' if kind == 'int' else 'v'}{self._count}"
        self.line(f"{kind} {name} = {text};")
        return name

    def line(self, text: str) -> None:
        """Write a line."""
        self.lines.append(self._indent + text)

    def write(self, record: Record, inputs: Sequence[Term]) -> list[Term]:
        """Write the steps of a record, applied to these inputs; return its outputs."""
        values: list[Any] = []
        for step in record.steps:
            operands = [values[place] for place in step.operands]
            values.append(STEPS.get(step.operation, Writer._function)(self, step, operands, inputs))
        return [values[place] for place in record.outputs]

    def table(self, entries: Sequence[float]) -> str:
        """Write a table unless it exists; return its name. Cycles cannot pass arrays to the inputs of a shader."""
        if entries not in self._tables:
            self._count += 1
            name = self._tables[entries] = f"table{self._count}"
            self.tables.append(f"    float {name}[{len(entries)}] = {{{', '.join(map(literal, entries))}}};")
        return self._tables[entries]

    def either(self, *conditions: str) -> str:
        """Return the condition that at least one of these conditions holds."""
        told = sorted({condition for condition in conditions if condition != NEVER})
        if ALWAYS in told:
            return ALWAYS
        return self.put("int", " || ".join(told)) if len(told) > 1 else told[0] if told else NEVER

    def _function(self, step: Step, operands: list[Term], _) -> Term:
        texts, none = [operand.text for operand in operands], self.either(*(operand.none for operand in operands))
        operation = step.operation
        self.helpers |= {operation, NEEDED_BY.get(operation, operation)} & HELPERS.keys()
        if step.truth:
            value = self.put("int", FUNCTIONS[operation].format(*texts))
            return Term(value if none == NEVER else NEVER if none == ALWAYS else self.put("int", f"!{none} && {value}"))
        if operation in ABSENT and not (operation == "divide" and texts[1][0] in "(123456789"):
            none = self.either(none, self.put("int", ABSENT[operation].format(*texts)))
        return Term(self.put("float", FUNCTIONS[operation].format(*texts)), none)

    def _input(self, step: Step, _, inputs: Sequence[Term]) -> Term:
        return inputs[step.fixed[0]]

    def _constant(self, step: Step, *_) -> Term:
        (value,) = step.fixed
        if step.truth:
            return Term(str(int(value)))
        return Term("0.0", ALWAYS) if math.isnan(value) else Term(self.inputs.number(value))

    def _parameter(self, step: Step, *_) -> Term:
        value, name = step.fixed
        return Term(self.inputs.named(name, value))

    def _roundoff(self, *_) -> Term:
        return Term(literal(2.0**-24))

    def _where(self, step: Step, operands: list[Term], _) -> Term:
        condition, yes, no = operands
        value = self.put("int" if step.truth else "float", f"{condition.text} ? {yes.text} : {no.text}")
        if yes.none == no.none:
            return Term(value, yes.none)
        return Term(value, self.put("int", f"{condition.text} ? {yes.none} : {no.none}"))

    def _searchsorted(self, step: Step, operands: list[Term], _) -> Term:
        """Write a binary search for the number of entries below a value (left), or not above it (right)."""
        (value,), (entries, side) = operands, step.fixed
        table, comparison = self.table(entries), "<" if side == "left" else "<="
        low = self.put("int", "0")
        high, middle = self.put("int", str(len(entries))), f"middle{self._count}"
        self.line(f"while ({low} < {high}) {{")
        self.line(f"    int {middle} = ({low} + {high}) / 2;")
        self.line(f"    if ({table}[{middle}] {comparison} {value.text}) {low} = {middle} + 1;")
        self.line(f"    else {high} = {middle};")
        self.line("}")
        return Term(self.put("float", low), value.none)

    def _take(self, step: Step, operands: list[Term], _) -> Term:
        (place,), (entries,) = operands, step.fixed
        return Term(self.put("float", f"{self.table(entries)}[(int){place.text}]"), place.none)

    def _loop(self, step: Step, operands: list[Term], _) -> list[Term]:
        body, most = step.fixed
        kinds = ["int" if inner.truth else "float" for inner in _inputs_of(body, len(operands))]
        state = [
            Term(self.put(kind, start.text), self.put("int", start.none))
            for kind, start in zip(kinds, operands, strict=True)
        ]
        count = f"i{self._count}"
        self.line(f"for (int {count} = 0; {count} < {most}; {count}++) {{")
        before, self._indent = self._indent, self._indent + "    "
        *after, settled = self.write(body, state)
        kept = [self.put(kind, value.text) for kind, value in zip(kinds, after, strict=True)]
        for own, value, name in zip(state, after, kept, strict=True):
            self.line(f"{own.text} = {name};")
            self.line(f"{own.none} = {value.none};")
        self.line(f"if ({settled.text}) break;")
        self._indent = before
        self.line("}")
        return state

    def _part(self, step: Step, operands, _) -> Term:
        return operands[0][step.fixed[0]]


STEPS: dict[str, Callable] = {
    "input": Writer._input, "constant": Writer._constant, "parameter": Writer._parameter, "where": Writer._where,
    "roundoff": Writer._roundoff, "searchsorted": Writer._searchsorted, "take": Writer._take, "loop": Writer._loop,
    "part": Writer._part, "stop_gradient": lambda writer, step, operands, _: operands[0],
}  # fmt: skip
"""Methods that write the steps that are not plain functions."""


def _inputs_of(body: Record, count: int) -> list[Step]:
    """Return the input step of each input of a loop's body; a numeric one if the body does not use the input."""
    found = {step.fixed[0]: step for step in body.steps if step.operation == "input"}
    return [found.get(place, Step("input", fixed=(place,))) for place in range(count)]


def literal(value: float) -> str:
    """Return the text of a number, to float32's last digit."""
    text = f"{in_range(value):.9g}"
    text += "" if set(text) & set(".e") else ".0"
    return f"({text})" if value < 0 else text


def in_range(value: float) -> float:
    """Return a number clipped to a magnitude that float32 rounds neither to zero nor to infinity; 0 stays 0."""
    size = min(max(abs(value), LEAST), MOST) if value else 0.0
    return math.copysign(size, value)
