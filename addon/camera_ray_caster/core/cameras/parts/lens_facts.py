"""The formula of a real lens in steps, and its numbers for reports."""

import numpy as np

from ...lenses.chief import ChiefRays
from ...lenses.optics import Optics
from ...lenses.prescription import Prescription
from .steps import Step

MILLIMETER = 1e-3
"""In Blender units, as for a thin lens."""

UPRIGHT = (
    Step(
        "Point on the upright film, mm of the file (V: pixels along the fitted side; p: pixel height / width)",
        "a = (x - W/2 + shift_x V) pitch, b = ((y - H/2) p + shift_y V) pitch",
    ),
    Step("Chief ray of the radius, by its polynomials", "rho = sqrt(a² + b²), h, z, q"),
    Step("Angle from the axis", "theta = 2 atan(q rho)"),
    Step("Origin, where it leaves the front surface", "o = (a h unit, b h unit, z unit)"),
    Step("Direction", "r = (2 q a, 2 q b, q² rho² - 1)"),
)

TILTED = (
    Step(
        "Point of the tilted film, mm of the file (V: pixels along the fitted side; p: pixel height / width)",
        "u = (x - W/2 + shift_x V) pitch, v = ((y - H/2) p + shift_y V) pitch",
    ),
    Step("From the film's point on the axis, by the tilts tau_x and tau_y", "P = u t_1 + v t_2"),
    Step("Its chief ray on the upright film, k found by Newton's method", "a = k P_x, b = k P_y"),
)
"""Steps of the formula in place of its first, where the film is tilted."""


def facts_of(
    lens: Prescription | None, optics: Optics, chief: ChiefRays, unit: float, radius: float, film: float
) -> dict[str, object]:
    """Return a lens's numbers, in mm but for f_number, and what its file states of them. unit: Blender units per mm of
    the file. radius: of the stop, and film: its z, in mm of the file.
    """
    scale = unit / MILLIMETER
    known: dict[str, object] = {"lens": lens.name, "source": lens.source} if lens else {}
    known |= {
        "focal_length": optics.focal_length * scale,
        "f_number": optics.focal_length / (2 * radius * abs(optics.entrance_pupil[1])),
        "widest_f_number": optics.widest_f_number,
        "back_focus": optics.back_focus * scale,
        "film_distance": (film - optics.rear.z) * scale,
        "stop": 2 * radius * scale,
        "image_circle": 2 * chief.rim * scale,
        "field_of_view": [float(np.degrees(2 * chief.widest))],
        "nearest_focus": optics.nearest_focus * scale,
    }
    claims = lens.claims.items() if lens else ()
    return known | {f"{name}, as the file states": value for name, value in claims}
