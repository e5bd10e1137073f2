"""Values in JSON's types, with all their bits, and the common entries of several mappings.

Numbers that JSON cannot represent are {"float": "nan"}, "inf" or "-inf". Python writes the shortest decimals that are
read back as the same float64.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np


def plain(value, of_infinite: Callable[[float], Any] = lambda number: {"float": str(number)}) -> Any:
    """Return JSON's kind of value: dicts, lists, strings, numbers, True, False and None.

    of_infinite: gives the value that stands for an infinite number or NaN.
    """
    if isinstance(value, Mapping):
        return {str(key): plain(entry, of_infinite) for key, entry in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist(), of_infinite)
    if isinstance(value, list | tuple):
        return [plain(entry, of_infinite) for entry in value]
    return of_infinite(value) if isinstance(value, float) and not math.isfinite(value) else value


def restored(value) -> Any:
    """Return values as they were before ``plain``; arrays and tuples become lists."""
    if isinstance(value, dict):
        if list(value) == ["float"]:
            return float(value["float"])
        return {key: restored(entry) for key, entry in value.items()}
    return [restored(entry) for entry in value] if isinstance(value, list) else value


def shared(mappings: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Return the entries that are the same in all plain mappings, including entries of nested mappings."""
    first, equal = mappings[0], {}
    for key, value in first.items():
        others = [other[key] for other in mappings if key in other]
        if len(others) < len(mappings):
            continue
        if all(_same(value, other) for other in others):
            equal[key] = value
        elif all(isinstance(other, dict) for other in others):
            equal[key] = shared(others)
    return equal


def without(mapping: Mapping[str, Any], base: Mapping[str, Any]) -> dict[str, Any]:
    """Return the entries of a plain mapping that are not the same in ``base``, including entries of nested mappings."""
    own_entries = {}
    for key, value in mapping.items():
        if key in base and isinstance(value, dict) and isinstance(base[key], dict):
            own_entries[key] = without(value, base[key])
        elif key not in base or not _same(value, base[key]):
            own_entries[key] = value
    return {key: value for key, value in own_entries.items() if value != {} or key not in base}


def differing(mapping: Mapping[str, Any], base: Mapping[str, Any]) -> dict[str, Any]:
    """Return the entries of a plain mapping that are not the same in ``base``, each as a whole."""
    return {key: value for key, value in mapping.items() if key not in base or not _same(value, base[key])}


def merged(base: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Return ``base`` with the entries of ``changes`` in place of its own, also nested ones: undoes ``without``."""
    result = dict(base)
    for key, value in changes.items():
        is_nested = isinstance(value, dict) and isinstance(base.get(key), dict)
        result[key] = merged(base[key], value) if is_nested else value
    return result


def _same(left, right) -> bool:
    """Whether two plain values have the same text. 0 and -0 differ, and so do 0 and 0.0."""
    return left is right or repr(left) == repr(right)
