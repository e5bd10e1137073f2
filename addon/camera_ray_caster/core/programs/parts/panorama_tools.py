"""Lenses of Panorama Tools and its relatives: a polynomial of the radius, in halves of the picture's shorter side.

The radius of the ideal picture is focal tan(theta) of a pinhole, and focal theta of a fisheye; the polynomial gives
that of the real picture. Both models are exact.
Reference: Panorama Tools documentation, Lens correction model.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from .lens import Lens, matrix

RECTILINEAR, FISHEYE = "RADIAL_POLYNOMIAL", "FTHETA"


def ptlens(a: float, b: float, c: float) -> list[float]:
    """Return the coefficients from the linear one up: they add up to 1."""
    return [1 - a - b - c, c, b, a]


def lens_of(
    name: str, model: str, size: dict[str, Any], focal: float, center: tuple[float, float], half: float,
    terms: Sequence[float],
) -> Lens:  # fmt: skip
    """Return the lens of a focal length and half the shorter side, in pixels, and its center from the corner."""
    settings = size | matrix(focal, focal, *center, 0.5)
    scaled = [0.0, *(term * (focal / half) ** power for power, term in enumerate(terms))]
    if model == RECTILINEAR:
        return Lens(name, model, settings | {"radial_polynomial": " ".join(map(repr, scaled))})
    pixels = " ".join(repr(focal * term) for term in scaled)
    settings = {key: value for key, value in settings.items() if key not in ("fx", "fy")}
    return Lens(name, model, settings | {"ftheta_angle_to_radius": pixels})
