"""Equality of records whose fields are arrays, and records in one line."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np


def same(first: Any, second: Any) -> bool:
    """Whether two values are equal in type and content: fields of records, items, numbers of arrays; NaN equals NaN."""
    if first is second:
        return True
    if type(first) is not type(second):
        return False
    if isinstance(first, np.ndarray):
        return first.dtype == second.dtype and np.array_equal(first, second, equal_nan=first.dtype.kind in "fc")
    if is_dataclass(first):
        return all(same(getattr(first, field.name), getattr(second, field.name)) for field in fields(first))
    if isinstance(first, Mapping):
        return first.keys() == second.keys() and all(same(value, second[key]) for key, value in first.items())
    if isinstance(first, list | tuple):
        return len(first) == len(second) and all(map(same, first, second))
    by_identity = all("__eq__" not in vars(base) for base in type(first).__mro__[:-1])
    if by_identity and hasattr(first, "__dict__") and not callable(first):
        shared = vars(first).keys() & vars(second).keys()  # what is computed at first use may be in one of them
        return all(same(vars(first)[name], vars(second)[name]) for name in shared)
    return bool(first == second or (first != first and second != second))
