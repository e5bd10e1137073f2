"""The exact rays of any model, with the digits that mpmath is set to: its own formula, recorded and evaluated.

It says what the formula of the core gives without rounding, from the constants that the model keeps in float64. Whether
the formula is the right one, and how the constants follow from Blender's settings, is for others to say: Blender and
Cycles, OpenCV, geometry by hand, and the formulas written anew in truth, lenses and multiperspective.
"""

from bisect import bisect_left, bisect_right
from functools import partial

from mpmath import floor, mp, mpf

from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.maths.recording import DOMAIN, record

NAN = mpf("nan")


def number(function, domain, *operands):
    """The function's value; no number of no number, and outside of the domain."""
    known = not any(map(mp.isnan, operands)) and domain(*operands)
    return function(*operands) if known else NAN


FUNCTIONS = {
    "add": lambda a, b: a + b, "subtract": lambda a, b: a - b, "multiply": lambda a, b: a * b,
    "divide": lambda a, b: a / b, "remainder": lambda a, b: a - b * floor(a / b), "power": mp.power,
    "negative": lambda a: -a, "absolute": abs, "sign": mp.sign, "minimum": min, "maximum": max,
    "floor": floor, "ceil": mp.ceil, "rint": mp.nint, "sqrt": mp.sqrt, "hypot": mp.hypot,
    "exp": mp.exp, "expm1": mp.expm1, "log": mp.log, "log1p": mp.log1p, "sin": mp.sin, "cos": mp.cos, "tan": mp.tan,
    "arcsin": mp.asin, "arccos": mp.acos, "arctan": mp.atan, "arctan2": mp.atan2,
    "sinh": mp.sinh, "cosh": mp.cosh, "tanh": mp.tanh,
}  # fmt: skip

MPMATH = {
    **{name: partial(number, function, DOMAIN.get(name, lambda *_: True)) for name, function in FUNCTIONS.items()},
    "less": lambda a, b: a < b, "less_equal": lambda a, b: a <= b, "equal": lambda a, b: a == b,
    "logical_and": lambda a, b: a and b, "logical_or": lambda a, b: a or b, "logical_not": lambda a: not a,
    "where": lambda condition, a, b: a if condition else b,
    "constant": lambda value: value if isinstance(value, bool) else mpf(value),
    "roundoff": lambda: +mp.eps,
    "stop_gradient": lambda a: a,
    "searchsorted": lambda a, table, side: mpf({"left": bisect_left, "right": bisect_right}[side](table, a)),
    "take": lambda index, table: NAN if mp.isnan(index) else mpf(table[int(index)]),
    "all": bool,
}  # fmt: skip
"""The arithmetic of records, with the digits that mpmath is set to."""


_LAST: dict = {}
"""The last record that was asked for, and its lens: many pixels of one camera are asked for in a row."""


def lens_of(raw):
    """The function of pixel coordinates that gives origin and direction in the camera's frame, None where there is no
    ray; and whether the model is planar, so that t counts depth.
    """
    if _LAST.get("raw") is not raw:
        model = camera_from(raw).model
        _LAST.update(raw=raw, lens=(_lens(model), model.planar))
    return _LAST["lens"]


def _lens(model):
    rays = record(lambda x, y: sum(map(tuple, model.rays(x, y)), ()), 2)

    def lens(x, y):
        values = rays.evaluate(MPMATH, (mpf(x), mpf(y)))
        return None if any(map(mp.isnan, values)) else (list(values[:3]), list(values[3:]))

    return lens
