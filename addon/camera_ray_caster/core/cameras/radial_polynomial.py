"""The radial polynomial of photographers' programs: the radius in the picture is a polynomial of a pinhole's radius.

Assumption: the picture of a pinhole is stretched along the radius, by a polynomial with even and odd powers.
Formula: rho = k1 t + k2 t^2 + ..., where t is the tangent of the angle from the axis, in focal lengths, then K.
Newton's method gives the inverse to full precision. The picture ends where the polynomial stops growing.
In panorama tools' words k1 = d, k2 = c s, k3 = b s^2 and k4 = a s^3; s is the focal length over half the shorter side.
Singular: the radius where it stops growing.
References: H. Dersch, Panorama Tools, lens correction model; Hugin documentation, Lens correction model; lensfun
documentation, Lens distortion models (ptlens, poly3, poly5).
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
from .parts.film import FARTHEST_PIXELS
from .parts.radial import COORDINATES, radii_of
from .parts.settings import Coefficients

POLYNOMIAL = Coefficients(
    "radial_polynomial", "Radial Polynomial", "Radius in focal lengths: 0, then the coefficients of t, t^2, ..., where "
                                              "t is the tangent of the angle from the axis", "0 1",
)  # fmt: skip


@dataclass(frozen=True)
class RadialPolynomial(Calibrated):
    """A lens with r = k1 t + k2 t^2 + ... and t = tan(theta)."""

    polynomial: tuple[float, ...]
    """Coefficients, from the linear term up."""

    key = "RADIAL_POLYNOMIAL"
    label = "Radial Polynomial"
    description = "A photographic lens: distortion by any powers of the radius, as in lensfun, Hugin and PTGui"
    number = 29
    polynomials = IN_CASTS
    guarded = False
    SETTINGS = (*CALIBRATION, POLYNOMIAL)
    FORMULA = (
        COORDINATES,
        Step("Tangent of the angle from the axis, by Newton's method", "rho = k1 t + k2 t² + ..., rho = sqrt(a² + b²)"),
        Step("Direction", "r = (a t / rho, b t / rho, -1) / sqrt(1 + t²)"),
    )

    @property
    def steps(self) -> tuple[Step, ...]:
        """See Model: with the polynomial of these settings."""
        plane, inverse, ray = self.FORMULA
        words = f"rho = {in_words('k', 1, self.polynomial, 't')}, rho = sqrt(a² + b²)"
        return plane, Step(inverse.words, words), ray

    def formula_values(self, x, y):
        """See Model: the coefficients, and the tangent that is found by iteration."""
        values = {f"k{i}": k for i, k in enumerate(self.polynomial, 1)}
        rho = np.sqrt(self._r_squared(x, y))
        tangent = plain(self._inverse(rho))
        return values | ({"t": tangent} if is_recorded(tangent) or rho <= self.own_rim else {})

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> RadialPolynomial:
        """See Model. A polynomial that does not start at 0 and grow there is refused."""
        calibration = Calibration.from_blender(raw, raster)
        constant, *coefficients = POLYNOMIAL.read(raw)
        if constant != 0 or not coefficients or not coefficients[0] > 0:
            raise POLYNOMIAL.refusal(raw, repr(POLYNOMIAL.given(raw)), "0, a number above 0, and more")
        return cls(raster.size, calibration.window(), inf, tuple(coefficients)).settled()

    @lazy
    def limit(self) -> float:
        """The largest tangent at which the polynomial is valid; the radius does not exceed FARTHEST_PIXELS there."""
        end = least_root((-FARTHEST_PIXELS, *self.polynomial))
        return least(end, least_root([i * k for i, k in enumerate(self.polynomial, 1)]))

    @property
    def own_rim(self) -> float:
        return self._value(self.limit)

    def _value(self, tangent):
        return tangent * horner(tangent, self.polynomial)

    def _slope(self, tangent):
        return horner(tangent, [i * k for i, k in enumerate(self.polynomial, 1)])

    def _knots(self, low: float, high: float, count: int) -> np.ndarray:
        """Return the points of the inverse's table: even in the angle, which ends at 90 degrees for an endless lens."""
        knots = np.tan(np.linspace(low, np.arctan(high), count))
        knots[-1] = high
        return knots

    @cached_property
    def _inverse(self):
        return Inverse(self._value, self._slope, 0.0, self.limit, self._knots)

    def factors(self, r_squared):
        r = radii_of(r_squared)
        tangent = self._inverse(r)
        cosine = 1 / np.sqrt(1 + tangent * tangent)
        return tangent / r * cosine, cosine

    def radius(self, theta):
        return self._value(np.tan(theta))
