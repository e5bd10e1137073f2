"""OCam of Scaramuzza: a model of mirror lenses and fisheyes, whose rays have a polynomial of the radius as component z.

Assumption: on a sensor perpendicular to the axis, the ray of the pixel at (u', v') from the center is (u', v', f(r)).
The third axis points back, so that f is below 0 on the axis.
Formula: the toolbox has x along the row numbers, down, and y to the right. With its c, d and e, a pixel's offset from
the center is (right, down) = ((1, e), (d, c)) (u', v'), and f(r) = a0 + a1 r + a2 r^2 + ..., in pixels. The inverse is
exact, by Newton's method, instead of the polynomial that the toolbox fits to it.
The picture ends where the angle from the axis stops growing, or at the corner of the frame.
Singular: the radius where the angle stops growing.
Reference: D. Scaramuzza, A. Martinelli and R. Siegwart, A Toolbox for Easily Calibrating Omnidirectional Cameras
(2006).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import inf

import numpy as np
from numpy.polynomial.polynomial import polyval

from ..maths.inversion import Inverse
from ..maths.polynomials import horner
from ..maths.recording import least_root
from ..maths.recording.scalars import largest, least
from ..maths.speed import lazy
from ..records import BlenderCamera, Raster
from .model import Step
from .parts.calibrated import Calibrated, in_words
from .parts.calibration import PRINCIPAL_POINT, Calibration
from .parts.left_out import NEEDED
from .parts.radial import radii_of
from .parts.settings import Coefficients, Number

POLYNOMIAL = Coefficients(
    "ocam_polynomial", "Polynomial", "Coefficients in pixels or mm: a0 (below 0), a1 (0 for most lenses), a2, ...",
    "-1000 0 0.0004", grows=(1, -1), left_out=NEEDED,
)  # fmt: skip
C, D, E = (
    Number(f"ocam_{name}", name.upper(), f"Entry of the affine matrix: {text}", default, digits=6, step=0.1)
    for name, text, default in (
        ("c", "down from down", 1.0), ("d", "down from right", 0.0), ("e", "right from down", 0.0),
    )
)  # fmt: skip


@dataclass(frozen=True)
class OCam(Calibrated):
    """An OCam lens. Its plane is in pixels of the calibrated picture, or in millimeters."""

    polynomial: tuple[float, ...]
    """Coefficients, from the constant up."""

    key = "OCAM"
    label = "OCam (Scaramuzza)"
    description = "A calibrated mirror lens or fisheye: a polynomial of the radius"
    number = 25
    SETTINGS = (*PRINCIPAL_POINT, POLYNOMIAL, C, D, E)
    FORMULA = (
        Step(
            "From the center x_0, y_0, v down, in units of the calibration, of s_x and s_y pixels of the frame",
            "u = (x - x_0) / s_x, v = (y_0 - y) / s_y",
        ),
        Step(
            "On a sensor perpendicular to the axis of the lens, y up",
            "a = (c u - e v) / (c - d e), b = (d u - v) / (c - d e), rho = sqrt(a² + b²)",
        ),
        Step("Behind the picture", "f = a0 + a1 rho + a2 rho² + ..."),
        Step("Direction", "r = (a, b, f) / sqrt(rho² + f²)"),
    )

    @property
    def steps(self) -> tuple[Step, ...]:
        """See Model: with the polynomial of these settings."""
        *before, behind, ray = self.FORMULA
        return (*before, Step(behind.words, f"f = {in_words('a', 0, self.polynomial, 'rho')}"), ray)

    def formula_values(self, x, y):
        """See Model: the coefficients."""
        return {f"a{i}": a for i, a in enumerate(self.polynomial)}

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> OCam:
        """See Model. A polynomial that is not below 0 on the axis is refused."""
        c, d, e = (setting.read(raw) for setting in (C, D, E))
        if not c - d * e > 0:
            raise C.refusal(raw, f"{c:.6g}", f"above ocam_d times ocam_e, {d * e:.6g}")
        coefficients = POLYNOMIAL.read(raw)
        if not coefficients[0] < 0:
            raise POLYNOMIAL.refusal(raw, repr(POLYNOMIAL.given(raw)), "a number below 0, and more")
        window = Calibration.from_blender(raw, raster, settings=PRINCIPAL_POINT).window(((1.0, e), (d, c)))
        return cls(raster.size, window, inf, coefficients).settled()

    @lazy
    def own_rim(self) -> float:
        """See Calibrated; also the corner of the frame."""
        corners = np.meshgrid(*((0.0, side) for side in self.size))
        corner = largest(*np.hypot(*self.window.plane_from_pixels(*corners)).ravel())
        return least(corner, least_root(self._slopes))

    @property
    def _slopes(self) -> list[float]:
        """Return the coefficients of r f' - f, which is 0 where the angle stops growing."""
        return [(i - 1) * a for i, a in enumerate(self.polynomial)]

    @property
    def K(self) -> None:
        """None, since the polynomial replaces the focal lengths; see Model."""
        return None

    def factors(self, r_squared):
        r = radii_of(r_squared)
        ahead = -horner(r, self.polynomial)
        scale = 1 / np.sqrt(r_squared + ahead * ahead)
        return scale, ahead * scale

    @cached_property
    def radius(self):
        """Return the inverse of the angle as a function of the radius; see Radial."""
        return Inverse(self._angle, self._slope, 0.0, self.rim)

    def _angle(self, r):
        return np.arctan2(r, -horner(r, self.polynomial))

    def _slope(self, r):
        behind = horner(r, self.polynomial)
        return polyval(r, self._slopes) / (r * r + behind * behind)
