"""Checks of arguments, one per kind. Each returns the value, or raises InputError with one line that names it."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Collection, Iterable
from functools import wraps
from itertools import islice
from math import inf, nan
from operator import index
from pathlib import Path
from reprlib import repr as shortened
from tokenize import TokenError
from typing import Any, ParamSpec, TypeVar
from zipfile import BadZipFile
from zlib import error as ZlibError

import numpy as np

from .other_names import meant, nearest
from .records import InputError

P = ParamSpec("P")
R = TypeVar("R")

DAMAGED = (
    BadZipFile, ZlibError, TokenError, SyntaxError, ValueError, EOFError, OSError, KeyError, TypeError, RuntimeError,
    MemoryError,
)  # fmt: skip
"""What ``np.load`` and its arrays raise for a file that is cut off, damaged or encrypted, or holds no numbers."""


LONGEST_VALUE = 200
"""Number of letters of a value in a message: nested lists are long, though each is shortened."""


def shown(value) -> str:
    """Return any value as one short line of text, a scalar of numpy as the number that it is."""
    text = " ".join(shortened(value.item() if isinstance(value, np.generic) else value).split())
    return text if len(text) <= LONGEST_VALUE else f"{text[: LONGEST_VALUE - 3]}..."


def shape_of(array: np.ndarray) -> str:
    """Return the shape of an array as text, and whether it has numbers that are not finite."""
    return f"of shape {array.shape}" + ("" if np.isfinite(array).all() else ", with NaN or infinite numbers")


def count(value, name: str, highest: float = inf) -> int:
    """Return a whole number from 1 to ``highest``."""
    limit = "a whole number from 1" + (f" to {highest}" if highest < inf else "")
    try:
        number = 0 if isinstance(value, bool | np.bool_) else index(value)
    except (TypeError, ValueError) as error:
        raise _refusal(name, value, limit) from error
    if not 1 <= number <= highest:
        raise _refusal(name, value, limit)
    return number


def number(value, name: str, highest: float, lowest: float | None = None) -> float:
    """Return a Python or numpy number from ``lowest``, by default -highest, to ``highest`` as a float."""
    lowest = -highest if lowest is None else lowest
    is_number = isinstance(value, int | float | np.integer | np.floating) and not isinstance(value, bool)
    try:
        result = float(value) if is_number else nan
    except OverflowError:  # of a whole number
        result = nan
    if not lowest <= result <= highest:
        raise _refusal(name, value, f"a number from {lowest:.12g} to {highest:.12g}")
    return result


def folder(value) -> Path:
    """Return the path of a folder, which need not exist."""
    try:
        path = Path(value)
    except TypeError as error:
        raise _refusal("folder", value, "a path") from error
    if "\0" in str(path) or not _can_be(os.fsencode, str(path)):
        raise _refusal("folder", value, "a path, which has no null characters and no halves of characters")
    return path


def name(value, argument: str = "name") -> str:
    """Return a string that files can hold."""
    if not _can_be(str.encode, word(value, argument)):
        raise _refusal(argument, value, "a string without halves of characters (lone surrogates)")
    return value


def _can_be(encoded: Callable[[str], bytes], text: str) -> bool:
    try:
        encoded(text)
    except UnicodeEncodeError:
        return False
    return True


def flag(value, name: str) -> bool:
    """Return True or False."""
    if not isinstance(value, bool | np.bool_):
        raise _refusal(name, value, "True or False")
    return bool(value)


def spelled(value, known: Collection[str]):
    """Return a value, a word of ``known`` in any case as it is spelled there."""
    if not isinstance(value, str) or value in known:
        return value
    return next((spelling for spelling in known if spelling.casefold() == value.casefold()), value)


def word(value, name: str, known: Collection[str] | None = None) -> str:
    """Return a string; it must be one of ``known`` in any case, unless that is None."""
    value = value if known is None else spelled(value, known)
    if not isinstance(value, str) or (known is not None and value not in known):
        raise _refusal(name, value, "a string" if known is None else f"one of {', '.join(known)}")
    return value


def words(value: str | Iterable[str], name: str, known: Collection[str]) -> tuple[str, ...]:
    """Return the names in one string or in an iterable of strings, each name once; all must be in ``known``, in any
    case.
    """
    if isinstance(value, str):
        value = (value,)
    try:
        iterator = iter(value)
    except TypeError as error:
        raise _refusal(name, value, f"some of {', '.join(known)}") from error
    limit = 100 * len(known)  # an iterator without end is refused
    names = [spelled(word, known) for word in islice(iterator, limit + 1)]
    if len(names) > limit:
        raise _refusal(name, value, f"at most {limit} names")
    for word in names:
        if not isinstance(word, str) or word not in known:
            raise unknown(name.removesuffix("es"), word, known)
    return tuple(dict.fromkeys(names))


def real_type(value, name: str) -> np.dtype:
    """Return a numpy floating-point type."""
    try:
        dtype = np.dtype(value)
    except Exception as error:  # numpy calls the value's own methods: TypeError, ValueError, SyntaxError and others
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
        array = np.asanyarray(value)
        if array.dtype.kind in "cmM" or isinstance(array, np.ma.MaskedArray):
            raise TypeError
        return np.asarray(array, dtype=np.float64)
    except Exception as error:  # numpy may raise anything, with several lines of text
        masked = isinstance(value, np.ma.MaskedArray)
        raise _refusal(name, value, "real numbers" + masked * ", without a mask") from error


def unknown(kind: str, value, known: Collection[str]) -> InputError:
    """Return the error for a word that is none of ``known``: it names the nearest one, and all."""
    near = (meant(value, known) or nearest(value, known)) if isinstance(value, str) else ""
    guess = f"did you mean {near}? " if near else ""
    return InputError(f"unknown {kind} {shown(value)}: {guess}choose from {', '.join(known)}")


def chosen(value, kind: str, known: Collection[str]) -> str:
    """Return the word of ``known`` that is given in any case. Raises InputError that names the nearest one."""
    value = spelled(value, known)
    if not isinstance(value, str) or value not in known:
        raise unknown(kind, value, known)
    return value


def deprecated(message: str, level: int = 3) -> None:
    """Warn about an old form; the message names the new one."""
    warnings.warn(f"{message}; version 1.0 will refuse the old form", DeprecationWarning, stacklevel=level)


def keywords(function: Callable[P, R]) -> Callable[P, R]:
    """Let a function take its keyword-only arguments by position, too, in their order, with a DeprecationWarning."""
    code: Any = getattr(function, "__code__")  # noqa: B009 (a function has it, a Callable need not)
    count = code.co_argcount
    names = code.co_varnames[count : count + code.co_kwonlyargcount]

    @wraps(function)
    def call(*args: P.args, **kwargs: P.kwargs) -> R:
        by_place: dict[str, Any] = dict(zip(names, args[count:], strict=False))
        if not by_place or len(args) > count + len(names):
            return function(*args, **kwargs)
        deprecated(f"{function.__name__} takes keywords here: {', '.join(f'{name}=' for name in by_place)}")
        by_name: Any = function
        return by_name(*args[:count], **by_place, **kwargs)

    return call


def _refusal(name: str, value, allowed: str) -> InputError:
    return InputError(f"{name} is {shown(value)}: it must be {allowed}")
