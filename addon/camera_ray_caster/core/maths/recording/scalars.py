"""Functions of one number, which may be a recorded one. Of a varied number, roots take the value alone."""

import math
from functools import reduce
from typing import Any

import numpy as np

from .number import is_recorded
from .varied import Varied


def _scalar(name: str, function) -> Any:
    ufunc = getattr(np, name)

    def apply(*numbers):
        return ufunc(*numbers) if is_recorded(*numbers) else function(*numbers)

    apply.__doc__ = f"Return math.{function.__name__} of numbers, or numpy's {name} of recorded ones."
    return apply


def cbrt(number):
    """Return the cube root of a number of at least 0."""
    return np.power(number, 1 / 3) if is_recorded(number) else math.cbrt(number)


def least(*numbers):
    """Return the least of numbers as a float, or a recorded number; no branch is taken."""
    return plain(reduce(np.minimum, numbers))


def largest(*numbers):
    """Return the largest of numbers as a float, or a recorded number; no branch is taken."""
    return plain(reduce(np.maximum, numbers))


def plain(number):
    """Return a scalar of numpy as a float, and a varied or a recorded number as it is."""
    return number if is_recorded(number) or isinstance(number, Varied) else float(number)


sqrt, hypot = (_scalar(function.__name__, function) for function in (math.sqrt, math.hypot))
