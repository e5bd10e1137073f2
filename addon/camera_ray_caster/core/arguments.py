"""What a caller may give, one check for each kind of argument: its value, or InputError in one line that names it."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable
from itertools import islice
from math import inf
from operator import index
from reprlib import repr as shortened
from typing import Any

import numpy as np

from .records import InputError


def shown(value) -> str:
    """Return what a value looks like, in one short line, whatever it is."""
    return " ".join(shortened(value).split())


def count(value, name: str, most: float = inf) -> int:
    """Return a whole number from 1 to ``most``."""
    limit = "a whole number from 1" + (f" to {most}" if most < inf else "")
    try:
        number = 0 if isinstance(value, bool | np.bool_) else index(value)
    except (TypeError, ValueError) as error:
        raise _refusal(name, value, limit) from error
    if not 1 <= number <= most:
        raise _refusal(name, value, limit)
    return number


def number(value, name: str, most: float) -> float:
    """Return a number from -most to most, of Python or numpy."""
    is_number = isinstance(value, int | float | np.integer | np.floating) and not isinstance(value, bool)
    if not is_number or not abs(value) <= most:  # NaN is not
        raise _refusal(name, value, f"a number from -{most} to {most}")
    return float(value)


def flag(value, name: str) -> bool:
    """Return True or False."""
    if not isinstance(value, bool | np.bool_):
        raise _refusal(name, value, "True or False")
    return bool(value)


def word(value, name: str, known: Collection[str] | None = None) -> str:
    """Return a string, one of those that are known; None for any."""
    if not isinstance(value, str) or (known is not None and value not in known):
        raise _refusal(name, value, "a string" if known is None else f"one of {', '.join(known)}")
    return value


def words(value: str | Iterable[str], name: str, known: Collection[str]) -> tuple[str, ...]:
    """Return some of the strings that are known, each once: from one string, or from what gives some."""
    if isinstance(value, str):
        value = (value,)
    try:
        given_one_by_one = iter(value)
    except TypeError as error:
        raise _refusal(name, value, f"some of {', '.join(known)}") from error
    most = 100 * len(known)  # what never ends is not waited for
    given = list(islice(given_one_by_one, most + 1))
    if len(given) > most:
        raise _refusal(name, value, f"at most {most} names")
    return tuple(dict.fromkeys(word(one, f"one of {name}", known) for one in given))


def real_type(value, name: str) -> np.dtype:
    """Return a floating-point type of numpy."""
    try:
        dtype = np.dtype(value)
    except Exception as error:  # numpy asks the value itself, and has TypeError, ValueError, SyntaxError and others
        raise _refusal(name, value, "float16, float32 or float64") from error
    if value is None or dtype.kind != "f" or dtype.shape:
        raise _refusal(name, value, "float16, float32 or float64")
    return dtype


def function(value, name: str) -> Callable[..., Any] | None:
    """Return a function, or None."""
    if value is not None and not callable(value):
        raise _refusal(name, value, "a function, or None")
    return value


def numbers(value, name: str) -> np.ndarray:
    """Return numbers as a float64 array."""
    try:
        return np.asarray(value, dtype=np.float64)
    except Exception as error:  # what numpy says of it may be anything, on several lines
        raise _refusal(name, value, "numbers") from error


def _refusal(name: str, value, allowed: str) -> InputError:
    return InputError(f"{name} is {shown(value)}: it must be {allowed}")
