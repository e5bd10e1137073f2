"""Lenses of Panorama Tools and its relatives: a polynomial of the radius, in halves of the picture's shorter side.

The radius of the ideal picture is focal tan(theta) of a pinhole, and focal theta of a fisheye; the polynomial gives
that of the real picture. Both models are exact. All pictures are taken from one place. The middle of the panorama is
along y, up is z: a camera that looks there is turned clockwise about its axis by the roll, then up by the pitch, then
to the right by the yaw, in degrees.
References: Panorama Tools documentation, Lens correction model; Image positioning model.
"""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ...maths.rotations import rotation, transform
from .document import Document
from .fields import Fields
from .lens import Lens, matrix
from .placed import Placed
from .program import of_pictures

ANGLES = "yaw", "pitch", "roll"
UPRIGHT = np.array(((1, 0, 0), (0, 0, 1), (0, -1, 0)))
"""From x right, y down, z ahead to x right, y ahead, z up."""
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


def of_panorama(
    pictures: Callable[[Document], list[tuple[Lens, Fields]]], moved: Sequence[str], angles: Sequence[str] = ANGLES
) -> dict[str, Any]:
    """Return ``read`` and ``poses`` of a program, given the pictures of a document: lenses, which have their names, and
    the entries with their angles. They raise InputError if one of the entries ``moved`` is not 0: the picture is taken
    from another place.
    """

    def placed(document: Document, picture: tuple[Lens, Fields]) -> Placed:
        document.check()
        lens, position = picture
        for name in moved:
            if position.number(name, 0.0):
                raise position.refusal(name, "0: pictures are taken from one place")
        yaw, pitch, roll = np.radians([position.number(name, 0.0) for name in angles])
        right, up, clockwise = rotation(np.array(((0, yaw, 0), (pitch, 0, 0), (0, 0, roll))))
        return Placed("", lens.name, None, transform(UPRIGHT @ right @ up @ clockwise, 0.0))

    return of_pictures(pictures, lambda document, picture: picture[0], placed)
