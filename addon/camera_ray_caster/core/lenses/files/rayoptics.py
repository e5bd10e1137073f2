"""Lens files of RayOptics (.roa, JSON): interfaces and gaps of a sequential model; the first is the object, the last
the image.

Profiles have cv = 1 / radius, and cc, the conic constant, or ec = cc + 1. Coefficients of EvenPolynomial are those of
r^2, r^4 ..., of RadialPolynomial those of r, r^2 ... Radii are those of the clear apertures, or else max_aperture.
"""

import json
from math import inf
from typing import Any

from ...records import InputError
from ..prescription import Prescription, Row
from .zemax import glass_of

UNITS = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "meters": 1000.0, "inches": 25.4, "in": 25.4}
"""Millimeters of the file's unit."""

POWER_STEPS = {"EvenPolynomial": 2, "RadialPolynomial": 1}
"""By the class of a profile: step of the powers of r, which is also the first of them."""


def recognizes(text: str, path: str) -> bool:
    """Return whether a text is JSON with a sequential model."""
    return text.lstrip().startswith("{") and '"optical_model"' in text and '"seq_model"' in text


def read(text: str, name: str) -> Prescription:
    """Return the lens. Raises InputError, which names the surface, for what is no centered refracting surface."""
    try:
        model = json.loads(text)["optical_model"]["attributes"]
        sequence, system = model["seq_model"]["attributes"], model.get("system_spec", {}).get("attributes", {})
        unit = UNITS[str(system.get("_dimensions", "mm")).lower()]
        profiles = model.get("profile_dict", {})
        gaps = [gap["attributes"] for gap in sequence["gaps"]]
        rows = [
            _row(surface["attributes"], gap, profiles, number, unit)
            for number, (surface, gap) in enumerate(zip(sequence["ifcs"][:-1], gaps, strict=True))
        ][1:]
        stop, before = int(sequence["stop_surface"]) - 1, _medium(gaps[0], 0)[0]
    except InputError:
        raise
    except (AttributeError, IndexError, KeyError, TypeError, ValueError) as error:
        raise InputError(f"its sequential model cannot be read ({type(error).__name__}: {error})") from error
    if not 0 <= stop < len(rows):
        raise InputError("its stop_surface is out of range")
    return Prescription(tuple(rows), stop, str(system.get("title") or name), "", before)


def _row(surface: dict[str, Any], gap: dict[str, Any], profiles: dict[str, Any], number: int, unit: float) -> Row:
    profile = surface.get("profile") or profiles[str(surface["profile_id"])]
    kind, numbers = profile["__instance_type__"][1], profile["attributes"]
    mode, is_known = surface["interact_mode"], kind in ("Spherical", "Conic", *POWER_STEPS)
    if not is_known or surface.get("decenter") or mode == "reflect":
        raise InputError(f"surface {number} is a {kind}, {mode}: only centered, refracting surfaces are supported")
    conic = float(numbers["ec"]) - 1 if "ec" in numbers else float(numbers.get("cc", 0.0))
    step = POWER_STEPS.get(kind, 1)
    powers = enumerate(numbers["coefs"], 1) if kind in POWER_STEPS else ()
    asphere = tuple((step * k, float(value) * unit ** (1 - step * k)) for k, value in powers if value)
    if asphere and asphere[0][0] < 2:
        raise InputError(f"surface {number} has a coefficient of r^1, a cone at its vertex: remove it")
    clear = surface.get("clear_apertures") or [{"attributes": {"radius": surface.get("max_aperture", 0.0)}}]
    index, abbe = _medium(gap, number)
    curvature, behind = float(numbers["cv"]) / unit, float(gap["thi"]) * unit
    rim = float(clear[0]["attributes"]["radius"]) * unit or inf
    return Row(curvature, behind, index, rim, conic, asphere, abbe, label=str(number))


def _medium(gap: dict[str, Any], number: int) -> tuple[float, float]:
    """Return the index behind a surface at the d line, and Abbe's number."""
    kind, numbers = gap["medium"]["__instance_type__"][1], gap["medium"]["attributes"]
    if kind == "Air":
        return 1.0, inf
    if "n" in numbers:
        return float(numbers["n"]), float(numbers.get("v") or inf)
    glass = str(numbers.get("gname", "")).upper()
    return glass_of(glass, f"surface {number} has the medium {glass or kind}", "n and v in its place")
