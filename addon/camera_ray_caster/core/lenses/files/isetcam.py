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
    numbers = [_numbers(surface, surface_index) for surface_index, surface in enumerate(surfaces)]
    stop = _stop(numbers)
    for surface_index, (surface, (radius, gap, half, index, abbe)) in enumerate(zip(surfaces, numbers, strict=True)):
        medium = medium if surface_index == stop else index or 1.0
        conic = surface.get("conic_constant", 0)
        conic = conic[0] if isinstance(conic, list) and conic else conic
        if not isinstance(conic, int | float):
            raise InputError(
                f"surface {surface_index + 1} has the conic constant {str(conic)[:20]}: it must be a number"
            )
        rows.append(Row(1 / radius if radius else 0.0, gap, medium, half or inf, float(conic), (), abbe))
    return Prescription(tuple(rows), stop, str(document.get("name", name)), str(document.get("description", "")))


def _numbers(surface: dict[str, Any], surface_index: int) -> tuple[float, float, float, float, float]:
    """Return radius, thickness, semi-aperture, index and Abbe's number."""
    radius, gap, half = (_number(surface, key, surface_index) for key in ("radius", "thickness", "semi_aperture"))
    return radius, gap, half, *_index(surface.get("ior", 1), surface_index)


def _stop(numbers: list[tuple[float, float, float, float, float]]) -> int:
    """Return the place of the stop."""
    stops, medium = [], 1.0
    for surface_index, (radius, _, _, index, _) in enumerate(numbers):
        if radius == 0 and index in (0.0, medium):
            stops.append(surface_index)
        else:
            medium = index or 1.0
    stops = stops or [surface_index for surface_index, row in enumerate(numbers) if row[0] == 0 and row[3] == 1]
    if len(stops) != 1:
        raise InputError(f"it has {len(stops)} surfaces of radius 0 without a change of the medium: one is the stop")
    return stops[0]


def _number(surface: dict[str, Any], key: str, surface_index: int) -> float:
    value = surface.get(key)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise InputError(f"surface {surface_index + 1} has the {key} {str(value)[:20]}: it must be a number")
    return float(value)


def _index(value: Any, surface_index: int) -> tuple[float, float]:
    """Return the index at the d line, and Abbe's number, of a number or of tables."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        return float(value), inf
    try:
        lengths, indices = ([float(number) for number in row] for row in value)
        pairs = sorted(zip(lengths, indices, strict=True))
    except (TypeError, ValueError) as error:
        raise InputError(
            f"surface {surface_index + 1} has an ior that is neither a number nor two lists of them"
        ) from error
    d, f, c = (_between(pairs, line) for line in (D_LINE, F_LINE, C_LINE))
    return d, ((d - 1) / (f - c) if f > c else inf)


def _between(pairs: list[tuple[float, float]], wavelength: float) -> float:
    low = max((pair for pair in pairs if pair[0] <= wavelength), default=pairs[0])
    high = min((pair for pair in pairs if pair[0] >= wavelength), default=pairs[-1])
    share = (wavelength - low[0]) / (high[0] - low[0]) if high[0] > low[0] else 0.0
    return low[1] + share * (high[1] - low[1])
