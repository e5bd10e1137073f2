"""The field-of-view camera: one parameter, the angle of an ideal fisheye.

Assumption: the radius is proportional to the angle at which a pinhole's picture is seen.
Formula: r = atan(2 tan(omega / 2) tan(theta)) / omega, in focal lengths, then K; the inverse has a closed form. The
picture ends 90 degrees from the axis, where r = pi / (2 omega).
Singular: that angle. With omega 0 it is a pinhole, r = tan(theta), without an end.
References: F. Devernay and O. Faugeras, Straight Lines Have to Be Straight (2001); COLMAP documentation, Camera Models.
"""

from dataclasses import dataclass
from math import atan, inf, pi, radians

import numpy as np

from ..maths.recording import tan
from .model import Step
from .parts.calibrated import Calibrated
from .parts.calibration import CALIBRATION
from .parts.film import FARTHEST_PIXELS
from .parts.radial import COORDINATES, RADIUS, RAY, radii_of
from .parts.settings import Number

OMEGA = Number("fov_omega", "Omega", "Angle of the fisheye; 0 is a pinhole", 1.0, 0.0, radians(179), "angle", digits=4)

PINHOLE = 1e-8
"""Omega up to which r differs from tan(theta) by less than rounding."""


@dataclass(frozen=True)
class FieldOfView(Calibrated):
    """A lens with r = atan(2 tan(omega / 2) tan(theta)) / omega."""

    omega: float

    key = "FOV"
    label = "Field of View (FOV)"
    description = "A calibrated wide-angle lens whose distortion is given by a single angle"
    number = 22
    guarded = False
    NUMBERS = {"omega": OMEGA}
    SETTINGS = (*CALIBRATION, OMEGA)
    FORMULA = (
        COORDINATES,
        RADIUS,
        Step("Angle from the axis", "theta = atan(tan(rho omega) / (2 tan(omega / 2)))"),
        RAY,
    )

    @property
    def own_rim(self) -> float:
        return inf if self.is_pinhole else pi / (2 * self.omega)

    @property
    def is_pinhole(self) -> bool:
        """Whether omega is 0 to rounding."""
        return self.omega <= PINHOLE

    @property
    def _stretch(self) -> float:
        return 2 * tan(self.omega / 2)

    def factors(self, r_squared):
        if self.is_pinhole:
            scale = 1 / np.sqrt(1 + r_squared)
            return scale, scale
        r = radii_of(r_squared)
        across, ahead = np.sin(r * self.omega), self._stretch * np.cos(r * self.omega)
        length = np.sqrt(across * across + ahead * ahead)
        return across / (r * length), ahead / length

    def radius(self, theta):
        if self.is_pinhole:
            return np.tan(theta)
        return np.arctan2(self._stretch * np.sin(theta), np.cos(theta)) / self.omega

    @property
    def widest(self) -> float:
        return atan(FARTHEST_PIXELS) if self.is_pinhole else pi / 2
