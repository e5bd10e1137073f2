"""Weighted means of the evaluations of an interval; the weights have the sum 1."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields, is_dataclass, replace

import numpy as np


def mixed(values: Sequence, weights: Sequence[float]):
    """Return the weighted mean of all numbers in records of one type; other values are those of the first record."""
    first = values[0]
    if is_dataclass(first) and not isinstance(first, type) and all(type(value) is type(first) for value in values):
        parts = {part.name: mixed([getattr(value, part.name) for value in values], weights) for part in fields(first)}
        changed = {name: part for name, part in parts.items() if part is not getattr(first, name)}
        return replace(first, **changed) if changed else first
    if isinstance(first, tuple) and all(isinstance(value, tuple) and len(value) == len(first) for value in values):
        return tuple(mixed(entries, weights) for entries in zip(*values, strict=True))
    if not isinstance(first, float | np.ndarray) or all(np.array_equal(first, value) for value in values[1:]):
        return first
    return mean(values, weights)


def mean(values: Sequence, weights: Sequence[float]) -> np.ndarray:
    """Return the weighted mean, computed as an addition to the first value."""
    total = values[0]
    for value, weight in zip(values[1:], weights[1:], strict=True):
        total = total + weight * (value - values[0])
    return total
