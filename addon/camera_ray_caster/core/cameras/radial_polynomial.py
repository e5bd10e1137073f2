"""The radial polynomial of lens correction programs: all powers of the radius, odd and even.

Assumption: the azimuth is kept. The distorted radius r_d is a polynomial of the radius r = tan(theta) of a pinhole.
Formula: r_d = k1 r + k2 r^2 + ..., in focal lengths, then K; the inverse is found by Newton's method to full precision.
ptlens is k4 to k1 = a, b, c and 1 - a - b - c, poly3 has r and r^3, poly5 r, r^3 and r^5.
Singular: the radius where the polynomial stops growing, at which the picture ends.
References: lensfun documentation, lens distortion models; H. Dersch, Panorama Tools, correcting barrel distortion.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import inf

import numpy as np

from ..maths.inversion import Inverse
from ..maths.polynomials import horner
from ..maths.recording import is_recorded, least_root
from ..maths.recording.scalars import least, plain
from ..maths.speed import lazy
from ..records import BlenderCamera, Raster
from .model import IN_CASTS, Step
from .parts.calibrated import Calibrated, in_words
from .parts.calibration import CALIBRATION, Calibration
from .parts.radial import COORDINATES, RADIUS, RAY, factors_of, radii_of
from .parts.settings import Coefficients

POLYNOMIAL = Coefficients(
    "radial_polynomial", "Polynomial", "Distorted radius: 0, then the coefficients of r, r^2, ...", "0 1"
)

STEEPEST = 2.0**14
"""Largest tangent of an angle from the axis, 89.9965 degrees: its 64th power is finite."""


@dataclass(frozen=True)
class RadialPolynomial(Calibrated):
    """A lens with r = k1 tan(theta) + k2 tan(theta)^2 + ..."""

    polynomial: tuple[float, ...]
    """Coefficients, from the linear term up."""

    key = "RADIAL_POLYNOMIAL"
    label = "Radial Polynomial"
    description = "A calibrated lens whose radial distortion has all powers, as of Hugin, PTGui and lensfun"
    number = 29
    polynomials = IN_CASTS
    guarded = False
    SETTINGS = (*CALIBRATION, POLYNOMIAL)
    FORMULA = (
        COORDINATES,
        RADIUS,
        Step("Tangent of the angle, by Newton's method", "rho = k1 t + k2 t² + ..."),
        Step("Angle from the axis", "theta = atan(t)"),
        RAY,
    )

    @property
    def steps(self) -> tuple[Step, ...]:
        """See Model: with the polynomial of these settings."""
        *before, tangent, angle, ray = self.FORMULA
        return (*before, Step(tangent.words, f"rho = {in_words('k', 1, self.polynomial, 't')}"), angle, ray)

    def formula_values(self, x, y):
        """See Model: the coefficients, and the tangent that is found by iteration."""
        values = {f"k{i}": k for i, k in enumerate(self.polynomial, 1)}
        rho = np.sqrt(self._r_squared(x, y))
        theta = plain(self._inverse(rho))
        return values | ({"t": plain(np.tan(theta))} if is_recorded(theta) or rho <= self.own_rim else {})

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> RadialPolynomial:
        """Build the camera from its settings.

        Raises InputError for an invalid setting, and for a polynomial that does not start at 0 and grow there.
        """
        constant, *coefficients = POLYNOMIAL.read(raw)
        if constant != 0 or not coefficients or not coefficients[0] > 0:
            raise POLYNOMIAL.refusal(raw, repr(POLYNOMIAL.given(raw)), "0, a number above 0, and more")
        window = Calibration.from_blender(raw, raster).window()
        return cls(raster.size, window, inf, tuple(coefficients)).settled()

    @lazy
    def widest(self) -> float:
        """See Radial."""
        return np.arctan(least(STEEPEST, least_root([i * k for i, k in enumerate(self.polynomial, 1)])))

    @property
    def own_rim(self) -> float:
        """See Calibrated."""
        return self.radius(self.widest)

    def radius(self, theta):
        """See Radial."""
        t = np.tan(theta)
        return t * horner(t, self.polynomial)

    def _slope(self, theta):
        t = np.tan(theta)
        return horner(t, [i * k for i, k in enumerate(self.polynomial, 1)]) * (1 + t * t)

    @cached_property
    def _inverse(self):
        return Inverse(self.radius, self._slope, 0.0, self.widest)

    def factors(self, r_squared):
        """See Radial."""
        r = radii_of(r_squared)
        return factors_of(self._inverse(r), r)
