"""A record of a formula, written as JavaScript: float64 and NaN, as in numpy.

Reference: ECMAScript 2015, chapter 20.2 (Math).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from ..maths.recording import Operation
from .writer import C_FUNCTIONS, Term, Writer

RUNTIME = """\
function remainder(a, b) {
  const rest = a % b;
  return rest !== 0 && rest < 0 !== b < 0 ? rest + b : rest;
}
function rint(a) {
  const low = Math.floor(a), part = a - low;
  return part > 0.5 || (part === 0.5 && low % 2 !== 0) ? low + 1 : low;
}
function countBelow(table, value, orEqual) {
  let low = 0, high = table.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (orEqual ? table[middle] <= value : table[middle] < value) low = middle + 1;
    else high = middle;
  }
  return low;
}
function entry(table, place) {
  return place >= 0 && place < table.length ? table[place] : NaN;
}
function valueOf(polynomial, x) {
  return polynomial.reduceRight((sum, coefficient) => sum * x + coefficient, 0);
}
function positiveRoots(polynomial) {
  const size = Math.max(...polynomial.map(Math.abs));
  let count = polynomial.length;
  while (count > 1 && !(Math.abs(polynomial[count - 1]) > 1e-250 * size)) count--;
  if (count < 2) return [];
  const own = polynomial.slice(0, count), lead = Math.abs(own[count - 1]);
  const turns = positiveRoots(own.map((coefficient, k) => k * coefficient).slice(1));
  const far = 1 + Math.max(...own.slice(0, -1).map((coefficient) => Math.abs(coefficient) / lead));
  const roots = [];
  [...turns.filter((turn) => turn < far), far].reduce((left, right) => {
    const rises = valueOf(own, right) > valueOf(own, left);
    let low = left, high = right;
    if (valueOf(own, left) * valueOf(own, right) < 0) {
      for (let middle = (low + high) / 2; low < middle && middle < high; middle = (low + high) / 2) {
        if (valueOf(own, middle) > 0 === rises) high = middle;
        else low = middle;
      }
      roots.push(high);
    } else if (valueOf(own, right) === 0 && right < far) roots.push(right);
    return right;
  }, 0);
  return roots;
}
function leastRoot(polynomial) {
  return Math.min(...positiveRoots(polynomial), Infinity);
}
"""
"""Functions that JavaScript lacks: numpy's remainder, rint, searchsorted and a table's entry; and the least
positive root of a polynomial, by bisection between the roots of its derivative, which lie below Cauchy's bound.
"""


@dataclass
class JavaScriptWriter(Writer):
    """Writer of the statements of a JavaScript function, which needs RUNTIME."""

    NUMBER = TRUTH = INDEX = "let"
    ABSENT: ClassVar[dict[str, str]] = {}
    HELPERS: ClassVar[dict[str, str]] = {}
    EPS = 2.0**-53
    FUNCTIONS = C_FUNCTIONS | {
        name: f"Math.{function}({', '.join(['{}'] * count)})"
        for function, count, name in (
            ("pow", 2, "power"), ("abs", 1, "absolute"), ("sign", 1, "sign"), ("min", 2, "minimum"),
            ("max", 2, "maximum"), ("floor", 1, "floor"), ("ceil", 1, "ceil"), ("sqrt", 1, "sqrt"),
            ("hypot", 2, "hypot"), ("exp", 1, "exp"), ("expm1", 1, "expm1"), ("log", 1, "log"), ("log1p", 1, "log1p"),
            ("sin", 1, "sin"), ("cos", 1, "cos"), ("tan", 1, "tan"), ("asin", 1, "arcsin"), ("acos", 1, "arccos"),
            ("atan", 1, "arctan"), ("atan2", 2, "arctan2"), ("sinh", 1, "sinh"), ("cosh", 1, "cosh"),
            ("tanh", 1, "tanh"),
        )
    } | {"remainder": "remainder({}, {})", "rint": "rint({})", "equal": "{} === {}"}  # fmt: skip

    @staticmethod
    def literal(value: float) -> str:
        """Return the text of a number, with all its digits."""
        text = repr(float(value)).replace("inf", "Infinity").removesuffix(".0")
        return f"({text})" if math.copysign(1.0, value) < 0 else text

    def table_text(self, name: str, entries: Sequence[float]) -> str:
        return f"    const {name} = [{', '.join(map(self.literal, entries))}];"

    def undefined(self) -> Term:
        return Term("NaN")

    def _least_root(self, step: Operation, operands: list[Term], _) -> Term:
        return Term(self.put("let", f"leastRoot([{', '.join(operand.text for operand in operands)}])"))

    def _searchsorted(self, step: Operation, operands: list[Term], _) -> Term:
        entries, side = step.fixed
        or_equal = "true" if side == "right" else "false"
        return Term(self.put("let", f"countBelow({self.table(entries)}, {operands[0].text}, {or_equal})"))

    def _take(self, step: Operation, operands: list[Term], _) -> Term:
        return Term(self.put("let", f"entry({self.table(step.fixed[0])}, {operands[0].text})"))
