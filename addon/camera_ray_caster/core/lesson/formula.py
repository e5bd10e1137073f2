"""Formulas of models, evaluated with the numbers of a pixel, one assignment after the other.

A formula is text for readers: ``theta = 2 asin(r / (2 f))``, ``d = (a, b, -n) / sqrt(r² + n²)``. Adjacent terms are
multiplied, from left to right together with divisions. A superscript is a power, ° the factor from degrees to radians,
× the cross product, a point between spaces the dot product. m_x, m_y and m_z are the components of a vector m that was
assigned.
"""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
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


SIGNS = {"cross": Product(np.cross), "dot": Product(np.vdot)}
PRODUCTS = {"×": "@cross@", ".": "@dot@"}
NAME = re.compile(r"[A-Za-z_][A-Za-z_0-9]*'?")
PRODUCT = re.compile(r"(?<=[\w)⁰¹²³⁴⁵⁶⁷⁸⁹°'])\s+(?=[\w(])")
"""The space between two factors."""
ASSIGNMENT = re.compile(r"([A-Za-z_][A-Za-z_0-9]*'?) = (.*)")

NOISE = 2e-15
"""What rounding leaves of sums and angles of numbers around 1, as of the cosine of 90°: 9 units in the last place."""

_most = ContextVar("most", default=17)
"""Maximum number of significant digits that are written."""


@contextmanager
def at_most(count: int) -> Iterator[None]:
    """Write numbers with at most this many significant digits inside the context."""
    token = _most.set(count)
    try:
        yield
    finally:
        _most.reset(token)


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


def value_and_noise(expression: str, known: Mapping[str, Any], noise: Mapping[str, float] | None = None) -> tuple:
    """Return the value of an expression, a number or a vector, and what rounding can have added to it, in the value's
    shape. The value is None if the expression is malformed or has unknown names.

    noise: of known values, if it is more than their own rounding. To first order: the sum of what the value changes by
    if each number in the expression changes by NOISE times itself, or by its noise.
    """
    words, terms, at, ended = [], list[tuple[Any, float]](), 0, False
    expression = expression.rstrip()
    while at < len(expression):
        match = TOKEN.match(expression, at)
        if match is None:
            return None, 0.0
        at = match.end()
        number, name, power, degrees, sign = match.groups()
        if (number or name or sign == "(") and ended:
            words.append("*")
        if name in FUNCTIONS:
            words.append(name)
        elif number or name or degrees:
            if name and name not in known:
                return None, 0.0
            term = known[name] if name else float(number) if number else np.pi / 180
            words += ["*"] * bool(degrees) + [f"terms[{len(terms)}]"]
            terms.append((term, np.maximum(NOISE * np.abs(term), (noise or {}).get(name, 0.0))))
        else:
            words.append(PRODUCTS.get(sign.strip(), sign) if sign else f"**{power.translate(POWERS)}")
        ended = bool(sign == ")" if sign else name not in FUNCTIONS)
    try:
        with np.errstate(all="ignore"):  # NaN means: no ray
            code = compile("".join(words), "<formula>", "eval")
            values = [term for term, _ in terms]
            result = _evaluated(code, values)
            moved = (_evaluated(code, [*values[:k], term + step, *values[k + 1 :]])
                     for k, (term, step) in enumerate(terms))  # fmt: skip
            return result, sum(np.abs(np.subtract(other, result)) for other in moved)
    except (SyntaxError, TypeError, ValueError, ZeroDivisionError):
        return None, 0.0


def _evaluated(code, terms: Sequence) -> Any:
    return eval(code, {"__builtins__": {}}, FUNCTIONS | SIGNS | {"terms": terms})


def worked_out(
    formulas: Sequence[tuple[str, Mapping[str, Any]]],
    known: Mapping[str, Any],
    noise: Mapping[str, float] | None = None,
) -> list[list[str]]:
    """Return for each formula the assignments that can be evaluated, with numbers and results.

    formulas: pairs of a formula and the values that only this formula knows. An assignment may use the result of a
    later one. Values in ``known`` of names that are assigned are ignored. A result that may be rounding alone is 0.
    noise: what rounding has added to known values, if it is more than their own.
    """
    parts = [(k, *pair) for k, (symbols, _) in enumerate(formulas) for pair in assignments(symbols)]
    known = {name: number for name, number in known.items() if name not in {name for _, name, _ in parts}}
    noise = dict(noise or {})
    lines: dict[int, str] = {}
    before = -1
    while before < len(lines):
        before = len(lines)
        for at, (k, name, expression) in enumerate(parts):
            if at in lines:
                continue
            names = known | dict(formulas[k][1])
            number, error = value_and_noise(expression, names, noise)
            if number is not None:
                put_in, result = with_numbers(expression, names, noise), shown(number, error)
                lines[at] = f"{name} = {result}" if put_in == result else f"{name} = {put_in} = {result}"
                known[name], noise[name] = number, np.max(error)
                if np.ndim(number):
                    for axis, component, step in zip("xyz", number, np.broadcast_to(error, 3), strict=True):
                        known[f"{name}_{axis}"], noise[f"{name}_{axis}"] = component, step
    return [[lines[at] for at in sorted(lines) if parts[at][0] == k] for k in range(len(formulas))]


def digits(number: float, sign: str = "-", noise: float = NOISE, count: int = 6) -> str:
    """Return a number as text, 0 if it is no more than ``noise``, what rounding can have added to it.

    It has ``count`` significant digits, or fewer within ``at_most``, but all digits of its whole part up to a million.
    With ``sign`` "+" it has a sign in any case.
    """
    # At a pole noise is as large as the number, which is no zero for that.
    count, number = min(count, _most.get()), 0.0 if abs(number) <= min(noise, 1.0) else number
    return f"{number:{sign}.0f}" if 10**count <= abs(number) < 1e6 else f"{number:{sign}.{count}g}"


def shown(number: Any, noise: Any = NOISE) -> str:
    """Return a number, or a vector, as text: see ``digits``; a component is 0 that is less than half a millionth, or
    than that of the longest component if this is below 1.
    """
    if np.ndim(number) == 0:
        return digits(number, noise=noise)
    parts = np.asarray(number, np.float64)
    with np.errstate(invalid="ignore"):
        least = 5e-7 * np.minimum(np.abs(parts).max(initial=0.0), 1.0)
        parts = np.where(np.abs(parts) < least, 0.0, parts) + 0.0  # no -0
    return f"({', '.join(digits(component, noise=0.0) for component in parts)})"


def with_numbers(expression: str, known: Mapping[str, Any], noise: Mapping[str, float] | None = None) -> str:
    """Return an expression with numbers in place of known names; vectors and unknown names stay. Products are dots.

    noise: what rounding has added to known values.
    """

    def number(match: re.Match) -> str:
        name = match.group()
        if np.ndim(known.get(name, ())):
            return name
        text = shown(known[name], (noise or {}).get(name, 0.0))
        return f"({text})" if text.startswith("-") else text

    text = re.sub(r"\(\((-[^()]*)\)\)", r"(\1)", NAME.sub(number, expression))
    return PRODUCT.sub(" · ", text)
