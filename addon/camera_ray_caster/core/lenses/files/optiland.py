"""Lens files of Optiland (.json): a group of surfaces, the first of which is the object, the last the image.

Places are the z of each surface's frame (cs). Coefficients of EvenAsphere are those of r^2, r^4 ..., of OddAsphere
those of r, r^2 ... Files seldom have rims: the stop's radius then follows from the system's aperture.
"""

import json
from dataclasses import replace
from itertools import pairwise
from math import inf
from typing import Any

from ...records import InputError
from ..optics import Optics
from ..prescription import Prescription, Row
from .zemax import glass_of

POWERS = {"EvenAsphere": 2, "OddAsphere": 1}
"""By the type of a geometry: step of the powers of r, which is also the first of them."""

BESIDE = "x", "y", "rx", "ry"
"""What a frame on the axis has 0."""


def recognizes(text: str, path: str) -> bool:
    """Return whether a text is JSON with a group of surfaces."""
    return text.lstrip().startswith("{") and '"surface_group"' in text and '"material_post"' in text


def read(text: str, name: str) -> Prescription:
    """Return the lens. Raises InputError, which names the surface, for what is no centered refracting surface."""
    try:
        system = json.loads(text)
        surfaces = system["surface_group"]["surfaces"]
        passed = enumerate(pairwise(surfaces[1:]), 1)
        rows = tuple(_row(surface, after, number) for number, (surface, after) in passed)
        stops = [number for number, surface in enumerate(surfaces[1:-1]) if surface.get("is_stop")]
        if len(stops) != 1:
            raise InputError(f"it has {len(stops)} surfaces that are the stop: it must be one")
        before = _medium(surfaces[0]["material_post"], 0)[0]
        lens = Prescription(rows, stops[0], str(system.get("name") or name), "", before)
        return _with_stop(lens, system.get("aperture") or {})
    except InputError:
        raise
    except (AttributeError, IndexError, KeyError, TypeError, ValueError) as error:
        raise InputError(f"its group of surfaces cannot be read ({type(error).__name__}: {error})") from error


def _row(surface: dict[str, Any], after: dict[str, Any], number: int) -> Row:
    geometry, kind = surface["geometry"], surface["geometry"]["type"]
    reflects = surface.get("is_reflective") or (surface.get("interaction_model") or {}).get("is_reflective")
    if kind not in ("Plane", "StandardGeometry", *POWERS) or reflects or any(geometry["cs"][axis] for axis in BESIDE):
        description = f"{kind}{', reflecting' if reflects else ''}"
        raise InputError(f"surface {number} is a {description}: only centered, refracting surfaces are supported")
    step = POWERS.get(kind, 1)
    powers = enumerate(geometry.get("coefficients") or () if kind in POWERS else (), 1)
    asphere = tuple((step * k, float(value)) for k, value in powers if value)
    if asphere and asphere[0][0] < 2:
        raise InputError(f"surface {number} has a coefficient of r^1, a cone at its vertex: remove it")
    radius = float(geometry.get("radius", inf))
    rim = float((surface.get("aperture") or {}).get("r_max", inf))
    index, abbe = _medium(surface["material_post"], number)
    behind = float(after["geometry"]["cs"]["z"]) - float(geometry["cs"]["z"])
    conic = float(geometry.get("conic", 0.0))
    return Row(1 / radius if radius else 0.0, behind, index, rim, conic, asphere, abbe, label=str(number))


def _medium(material: dict[str, Any], number: int) -> tuple[float, float]:
    """Return the index behind a surface at the d line, and Abbe's number."""
    if "index" in material:
        return float(material["index"]), float(material.get("abbe") or inf)
    glass = str(material.get("name", "")).upper()
    return glass_of(glass, f"surface {number} has the medium {glass or 'unknown'}", "index and abbe")


def _with_stop(lens: Prescription, aperture: dict[str, Any]) -> Prescription:
    """Return a lens whose stop has a radius: its own, or that of the system's aperture."""
    if lens.rows[lens.stop].rim < inf or "value" not in aperture:
        return lens
    optics, value = Optics.of(lens), float(aperture["value"])
    kinds = {"float_by_stop_size": value / 2, "EPD": value / 2 / abs(optics.entrance_pupil[1])}
    rim = optics.stop_radius(value) if aperture.get("type") == "imageFNO" else kinds.get(str(aperture.get("type")), inf)
    rows = list(lens.rows)
    rows[lens.stop] = replace(rows[lens.stop], rim=rim)
    return replace(lens, rows=tuple(rows))
