"""The division model: the undistorted radius is the distorted radius over a quadratic polynomial of the latter.

Assumption: the ray of the distorted coordinates (a, b) is (a, b, -(1 + lambda r^2)). With lambda below 0 the angle of
rays goes on behind the eye. With lambda above 0 it turns back at r = 1 / sqrt(lambda), where the picture ends.
Formula: tan(theta) = r / (1 + lambda r^2), in focal lengths, then K; the inverse is the root of a quadratic equation.
Singular: the angle at which rays turn back, and with lambda below 0 the point straight behind the eye.
References: A. Fitzgibbon, Simultaneous Linear Estimation of Multiple View Geometry and Lens Distortion (2001); COLMAP
documentation, Camera Models, where lambda is k.
"""

from dataclasses import dataclass
from math import inf

import numpy as np

from ..maths.recording.scalars import sqrt
from .model import Step
from .parts.calibrated import Calibrated
from .parts.calibration import CALIBRATION
from .parts.radial import COORDINATES
from .parts.settings import Number

LAMBDA = Number(
    "division_lambda", "Lambda", "Coefficient of r^2 in the denominator: below 0 barrel distortion, above 0 "
                                 "pincushion distortion", 0.0,
    -1e6, 1e6, digits=6, step=0.1,
)  # fmt: skip


@dataclass(frozen=True)
class Division(Calibrated):
    """A lens with tan(theta) = r / (1 + bend r^2)."""

    bend: float
    """The coefficient lambda."""

    key = "DIVISION"
    label = "Division"
    description = "A calibrated lens or fisheye with a single distortion coefficient"
    number = 23
    NUMBERS = {"bend": LAMBDA}
    SETTINGS = (*CALIBRATION, LAMBDA)
    FORMULA = (
        COORDINATES,
        Step("Radius and depth", "rho = sqrt(a² + b²), n = 1 + lambda rho²"),
        Step("Direction", "r = (a, b, -n) / sqrt(rho² + n²)"),
    )

    @property
    def own_rim(self) -> float:
        return 1 / sqrt(self.bend) if self.bend > 0 else inf

    def factors(self, r_squared):
        ahead = 1 + self.bend * r_squared
        scale = 1 / np.sqrt(r_squared + ahead * ahead)
        return scale, ahead * scale

    def radius(self, theta):
        """See Radial: the smaller positive root of lambda s r^2 - c r + s = 0, in the form that does not cancel."""
        s, c = np.sin(theta), np.cos(theta)
        root = np.sqrt(np.maximum(c * c - 4 * self.bend * s * s, 0.0))
        ahead = 2 * s / np.where(c >= 0, c + root, 1.0)
        if self.bend >= 0:
            return ahead
        return np.where(c >= 0, ahead, (c - root) / (2 * self.bend * np.where(s > 0, s, 1.0)))
