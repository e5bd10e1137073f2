"""Lens files of ISETCam and ISET3d (.json): a list ``surfaces`` with radius, thickness, ior and SEMI-aperture.

A radius of 0 is the stop, or a plane between two media. The stop's ior is 0 or that of the medium before it; files
also write 1 for it, which a plane into air has, too. ``ior`` is a number, or lists of wavelengths in nm and of
indices. The last medium may be other than air (an eye).
"""

import json
from math import inf
from typing import Any

from ...records import InputError
from ..prescription import C_LINE, D_LINE, F_LINE, Prescription, Row


def recognizes(text: str, path: str) -> bool:
    """Return whether a text is JSON with surfaces."""
    return text.lstrip().startswith("{") and '"surfaces"' in text and '"semi_aperture"' in text


def read(text: str, name: str) -> Prescription:
    """Return the lens. Raises InputError, which names the surface, for what is no number."""
    try:
        document = json.loads(text)
    except ValueError as error:
        raise InputError(f"it is not JSON ({error})") from error
    surfaces = document.get("surfaces") if isinstance(document, dict) else None
    if not isinstance(surfaces, list) or not all(isinstance(surface, dict) for surface in surfaces):
        raise InputError("its 'surfaces' must be a list of mappings")
    rows, medium = [], 1.0
    numbers = [_numbers(surface, number) for number, surface in enumerate(surfaces, 1)]
    stop = _stop(numbers)
    for k, (radius, gap, half, conic, index, abbe) in enumerate(numbers):
        medium = medium if k == stop else index or 1.0
        rows.append(Row(1 / radius if radius else 0.0, gap, medium, half or inf, conic, (), abbe))
    return Prescription(tuple(rows), stop, str(document.get("name", name)), str(document.get("description", "")))


def _numbers(surface: dict[str, Any], number: int) -> tuple[float, float, float, float, float, float]:
    """Return radius, thickness, semi-aperture, conic constant, index and Abbe's number."""
    radius, gap, half = (_number(surface.get(key), key, number) for key in ("radius", "thickness", "semi_aperture"))
    conic = surface.get("conic_constant", 0)
    conic = _number(conic[0] if isinstance(conic, list) and conic else conic, "conic constant", number)
    return radius, gap, half, conic, *_index(surface.get("ior", 1), number)


def _stop(numbers: list[tuple[float, float, float, float, float, float]]) -> int:
    """Return the place of the stop."""
    stops, medium = [], 1.0
    for k, (radius, *_, index, _) in enumerate(numbers):
        if radius == 0 and index in (0.0, medium):
            stops.append(k)
        else:
            medium = index or 1.0
    stops = stops or [k for k, (radius, *_, index, _) in enumerate(numbers) if radius == 0 and index == 1]
    if len(stops) != 1:
        raise InputError(f"it has {len(stops)} surfaces of radius 0 without a change of the medium: one is the stop")
    return stops[0]


def _number(value: Any, quantity: str, number: int) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise InputError(f"surface {number} has the {quantity} {str(value)[:20]}: it must be a number")
    return float(value)


def _index(value: Any, number: int) -> tuple[float, float]:
    """Return the index at the d line, and Abbe's number, of a number or of tables."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        return float(value), inf
    try:
        lengths, indices = (map(float, row) for row in value)
        pairs = sorted(zip(lengths, indices, strict=True))
    except (TypeError, ValueError) as error:
        raise InputError(f"surface {number} has an ior that is neither a number nor two lists of them") from error
    d, f, c = (_between(pairs, line) for line in (D_LINE, F_LINE, C_LINE))
    return d, ((d - 1) / (f - c) if f > c else inf)


def _between(pairs: list[tuple[float, float]], wavelength: float) -> float:
    low = max((pair for pair in pairs if pair[0] <= wavelength), default=pairs[0])
    high = min((pair for pair in pairs if pair[0] >= wavelength), default=pairs[-1])
    share = (wavelength - low[0]) / (high[0] - low[0]) if high[0] > low[0] else 0.0
    return low[1] + share * (high[1] - low[1])
