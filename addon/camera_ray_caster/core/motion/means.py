"""Weighted means of the evaluations of an interval; the weights have the sum 1."""

from collections.abc import Sequence
from dataclasses import fields, is_dataclass, replace

import numpy as np


def mixed(values: Sequence, weights: Sequence[float]):
    """Return the weighted mean of all numbers in records of one type; other values are those of the first record. Of
    records that are the same it is the first itself, with all that has been computed of it.
    """
    first = values[0]
    if all(same(first, value) for value in values[1:]):
        return first
    if is_dataclass(first) and not isinstance(first, type) and all(type(value) is type(first) for value in values):
        names = [field.name for field in fields(first)]
        return replace(first, **{name: mixed([getattr(value, name) for value in values], weights) for name in names})
    if isinstance(first, tuple) and all(isinstance(value, tuple) and len(value) == len(first) for value in values):
        return tuple(mixed(entries, weights) for entries in zip(*values, strict=True))
    return mean(values, weights) if isinstance(first, float | np.ndarray) else first


def same(first, second) -> bool:
    """Whether two records have the same type and the same values."""
    if first is second:
        return True
    if is_dataclass(first):
        return type(first) is type(second) and all(
            same(getattr(first, field.name), getattr(second, field.name)) for field in fields(first)
        )
    if isinstance(first, tuple) and isinstance(second, tuple):
        return len(first) == len(second) and all(map(same, first, second))
    return np.array_equal(first, second)


def mean(values: Sequence, weights: Sequence) -> np.ndarray:
    """Return the weighted mean by numbers or arrays, computed as an addition to the first value."""
    total = values[0]
    for value, weight in zip(values[1:], weights[1:], strict=True):
        total = total + weight * (value - values[0])
    return total
