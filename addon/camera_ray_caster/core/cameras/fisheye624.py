"""Fisheye624 of Project Aria: Kannala and Brandt's model with 6 radial, 2 tangential and 4 thin prism coefficients.

COLMAP calls it RAD_TAN_THIN_PRISM_FISHEYE. Aria's k0 .. k5 and s0 .. s3 are k1 .. k6 and s1 .. s4 here. Its p0 and p1
are p2 and p1 in OpenCV's naming, which is used here.
Assumption: the radius is an odd polynomial of the angle from the axis, and the resulting picture is distorted further.
Formula: r = theta (1 + k1 theta^2 + ... + k6 theta^12), in focal lengths, then the tangential and thin prism terms of
parts/radial_tangential.py, then K. Both are inverted by Newton's method, to full precision. Beyond the angle up to
which both are one-to-one, pixels have no ray and points have no pixel.
Singular: that angle, and the point straight behind the eye.
References: Project Aria documentation, Camera Intrinsic Models; COLMAP documentation, Camera Models.
"""

from dataclasses import dataclass

from .model import Step
from .parts.calibration import CALIBRATION, K1, K2, K3, K4, K5, K6, P1, P2, S1, S2, S3, S4
from .parts.kannala_brandt import KannalaBrandt
from .parts.radial import DISTORTED, RAY


@dataclass(frozen=True)
class Fisheye624(KannalaBrandt):
    """A fisheye with six radial, two tangential and four thin prism coefficients."""

    key = "FISHEYE624"
    label = "Fisheye624"
    description = "A calibrated fisheye of Project Aria: radial, tangential and thin prism distortion"
    number = 20
    RADIAL = K1, K2, K3, K4, K5, K6
    DISTORTION = P1, P2, S1, S2, S3, S4
    SETTINGS = (*CALIBRATION, *RADIAL, *DISTORTION)
    FORMULA = (
        DISTORTED,
        Step("Radius of the undistorted a and b, y up, found by Newton's method", "rho = sqrt(a² + b²)"),
        Step("Their distortion across gives u", "u = a - 2 p1 a b + p2 (rho² + 2 a²) + s1 rho² + s2 rho⁴"),
        Step("Their distortion down gives v", "v = -b + p1 (rho² + 2 b²) - 2 p2 a b + s3 rho² + s4 rho⁴"),
        Step(
            "Angle, by Newton's method",
            "rho = theta (1 + k1 theta² + k2 theta⁴ + k3 theta⁶ + k4 theta⁸ + k5 theta¹⁰ + k6 theta¹²)",
        ),
        RAY,
    )

    def formula_values(self, x, y):
        """See KannalaBrandt; also the undistorted coordinates."""
        return self.undistorted(x, y) | super().formula_values(x, y)
