"""OpenCV's calibrated fisheye, the lens of Kannala and Brandt.

Assumption: the distorted radius is an odd polynomial of the angle from the axis, azimuth is kept.
Formula: r = theta (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8), r in focal lengths, K in OpenCV's
convention. The inverse is Newton's. Pixels and points beyond the angle up to which r grows have no ray and no pixel.
Unlike OpenCV's own functions, which stop at 90 degrees, angles go up to that limit or 180 degrees.
Singular: that angle, and the point straight behind the eye.
Reference: J. Kannala and S. Brandt, A Generic Camera Model and Calibration Method (2006); OpenCV documentation, Fisheye
camera model.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..maths.inversion import Inverse
from ..maths.roots import positive_roots
from ..records import BlenderCamera, Raster
from .model import Step
from .parts.calibration import CALIBRATION, FISHEYE, Calibration
from .parts.radial import COORDINATES, RADIUS, RAY, Radial, radii_of


@dataclass(frozen=True)
class OpencvFisheye(Radial):
    """r = polynomial(theta) up to ``limit``."""

    coefficients: tuple[float, ...]
    """k1 .. k4."""
    limit: float
    """Radians."""

    key = "OPENCV_FISHEYE"
    label = "OpenCV Fisheye"
    description = "A calibrated fisheye, by Kannala and Brandt"
    group = "Calibrated"
    number = 5
    factors_by_polynomials = True
    SETTINGS = (*CALIBRATION, *FISHEYE)
    FORMULA = (
        COORDINATES,
        RADIUS,
        Step("Angle, by Newton's method", "r = theta (1 + k1 theta² + k2 theta⁴ + k3 theta⁶ + k4 theta⁸)"),
        RAY,
    )

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> OpencvFisheye:
        """Build it from the settings of the same names or a calibration file; see Calibration for what is refused."""
        calibration = Calibration.from_blender(raw, raster, FISHEYE)
        coefficients = tuple(calibration.coefficients[setting.name] for setting in FISHEYE)
        slope = np.polynomial.Polynomial([1.0, *((2 * i + 3) * k for i, k in enumerate(coefficients))])
        turns = positive_roots(slope)
        limit = min(np.pi, *np.sqrt(turns).tolist(), np.pi)
        lens = cls(raster.size, calibration.window(raster), np.inf, coefficients, limit)
        return replace(lens, rim=lens.distorted(limit))

    @property
    def K(self) -> np.ndarray:
        """See Model."""
        return self.window.matrix(self.frame[1])

    def distorted(self, theta):
        """Return r of angles."""
        k1, k2, k3, k4 = self.coefficients
        s = theta * theta
        return theta * (1 + s * (k1 + s * (k2 + s * (k3 + s * k4))))

    def slope(self, theta):
        """Return the derivative of r by theta."""
        k1, k2, k3, k4 = self.coefficients
        s = theta * theta
        return 1 + s * (3 * k1 + s * (5 * k2 + s * (7 * k3 + s * 9 * k4)))

    @cached_property
    def _angle(self):
        return Inverse(self.distorted, self.slope, 0.0, self.limit)

    def factors(self, r_squared):
        """See Radial."""
        r = radii_of(r_squared)
        theta = self._angle(r)
        return np.sin(theta) / r, np.cos(theta)

    def radius(self, theta):
        """See Radial."""
        return self.distorted(theta)

    @property
    def widest(self) -> float:
        """See Radial."""
        return self.limit
