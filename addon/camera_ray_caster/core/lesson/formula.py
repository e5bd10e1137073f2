"""Formulas of models, evaluated with the numbers of a pixel, one assignment after the other.

A formula is text for readers: ``theta = 2 asin(r / (2 f))``, ``d = (a, b, -n) / sqrt(r² + n²)``. Adjacent terms are
multiplied, from left to right together with divisions. A superscript is a power, ° the factor from degrees to radians,
× the cross product, a point between spaces the dot product. m_x, m_y and m_z are the components of a vector m that was
assigned.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

FUNCTIONS = {
    "sin": np.sin, "cos": np.cos, "tan": np.tan, "asin": np.arcsin, "acos": np.arccos, "atan": np.arctan,
    "sqrt": np.sqrt, "min": np.minimum, "max": np.maximum,
}  # fmt: skip
POWERS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789")
TOKEN = re.compile(r"\s*(?:(\d+\.?\d*)|([A-Za-z_][A-Za-z_0-9]*'?)|([⁰¹²³⁴⁵⁶⁷⁸⁹]+)|(°)|(\.\s|[-+*/(),×]))")


class Product:
    """A product of the vectors on both sides: ``a @ cross @ b``, with the precedence of a product of numbers."""

    __array_ufunc__ = None  # numpy leaves @ to this class

    def __init__(self, of: Callable, first=None):
        self._of, self._first = of, first

    def __rmatmul__(self, first):
        return Product(self._of, first)

    def __matmul__(self, second):
        return self._of(self._first, second)


SIGNS = {"degree": np.pi / 180, "cross": Product(np.cross), "dot": Product(np.vdot)}
PRODUCTS = {"×": "@cross@", ".": "@dot@"}
NAME = re.compile(r"[A-Za-z_][A-Za-z_0-9]*'?")
PRODUCT = re.compile(r"(?<=[\w)⁰¹²³⁴⁵⁶⁷⁸⁹°'])\s+(?=[\w(])")
"""The space between two factors."""
ASSIGNMENT = re.compile(r"([A-Za-z_][A-Za-z_0-9]*'?) = (.*)")

NOISE = 2e-15
"""What rounding leaves of sums and angles of numbers around 1, as of the cosine of 90°: 9 units in the last place."""


def assignments(symbols: str) -> Iterator[tuple[str, str]]:
    """Yield the names that a formula assigns, each with its expression.

    Commas and semicolons outside of parentheses separate the assignments.
    """
    depth, parts = 0, [""]
    for letter in symbols:
        depth += (letter == "(") - (letter == ")")
        if letter in ",;" and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    for assignment in parts:
        match = ASSIGNMENT.fullmatch(assignment.strip())
        if match:
            yield match[1], match[2]


def value(expression: str, known: Mapping[str, Any]) -> Any:
    """Return the value of an expression, a number or a vector; None if it is malformed or has unknown names."""
    words, at, ended = [], 0, False
    expression = expression.rstrip()
    while at < len(expression):
        match = TOKEN.match(expression, at)
        if match is None:
            return None
        at = match.end()
        number, name, power, degrees, sign = match.groups()
        begins = number or name or sign == "("
        if begins and ended:
            words.append("*")
        if name and name not in FUNCTIONS:
            if name not in known:
                return None
            words.append(f"known[{name!r}]")
        else:
            sign = sign and PRODUCTS.get(sign.strip(), sign)
            words.append(number or name or sign or (degrees and "*degree") or f"**{power.translate(POWERS)}")
        ended = bool(sign == ")" if sign else name not in FUNCTIONS)
    try:
        with np.errstate(all="ignore"):  # NaN means: no ray
            return eval("".join(words), {"__builtins__": {}}, FUNCTIONS | SIGNS | {"known": known})
    except (SyntaxError, TypeError, ValueError, ZeroDivisionError):
        return None


def worked_out(formulas: Sequence[tuple[str, Mapping[str, Any]]], known: Mapping[str, Any]) -> list[list[str]]:
    """Return for each formula the assignments that can be evaluated, with numbers and results.

    formulas: pairs of a formula and the values that only this formula knows. An assignment may use the result of a
    later one. Values in ``known`` of names that are assigned are ignored.
    """
    parts = [(k, *pair) for k, (symbols, _) in enumerate(formulas) for pair in assignments(symbols)]
    known = {name: number for name, number in known.items() if name not in {name for _, name, _ in parts}}
    lines: dict[int, str] = {}
    before = -1
    while before < len(lines):
        before = len(lines)
        for at, (k, name, expression) in enumerate(parts):
            names = known | dict(formulas[k][1])
            number = None if at in lines else value(expression, names)
            if number is not None:
                put_in, result = with_numbers(expression, names), shown(number)
                lines[at] = f"{name} = {result}" if put_in == result else f"{name} = {put_in} = {result}"
                known[name] = number
                if np.ndim(number):
                    known |= {f"{name}_{axis}": component for axis, component in zip("xyz", number, strict=True)}
    return [[lines[at] for at in sorted(lines) if parts[at][0] == k] for k in range(len(formulas))]


def digits(number: float, sign: str = "-") -> str:
    """Return a number with six digits, and with ``sign`` "+" a sign in any case; 0 for one below NOISE."""
    return f"{0.0 if abs(number) < NOISE else number:{sign}.6g}"


def shown(number: Any) -> str:
    """Return a number, or a vector, with six digits; a component is 0 that is less than half a millionth, or than that
    of the longest component if this is below 1.
    """
    if np.ndim(number) == 0:
        return digits(number)
    parts = np.asarray(number, np.float64)
    with np.errstate(invalid="ignore"):
        least = 5e-7 * np.minimum(np.abs(parts).max(initial=0.0), 1.0)
        parts = np.where(np.abs(parts) < least, 0.0, parts) + 0.0  # no -0
    return f"({', '.join(f'{component:.6g}' for component in parts)})"


def with_numbers(expression: str, known: Mapping[str, Any]) -> str:
    """Return an expression with numbers in place of known names; vectors and unknown names stay. Products are dots."""

    def number(match: re.Match) -> str:
        name = match.group()
        if np.ndim(known.get(name, ())):
            return name
        text = shown(known[name])
        return f"({text})" if text.startswith("-") else text

    text = re.sub(r"\(\((-[^()]*)\)\)", r"(\1)", NAME.sub(number, expression))
    return PRODUCT.sub(" · ", text)
