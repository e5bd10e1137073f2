"""OpenCV's calibrated fisheye, the lens of Kannala and Brandt.

Assumption: the distorted radius is an odd polynomial of the angle from the axis; azimuth is kept.
Formula: r = theta (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8), r in focal lengths, K in OpenCV's
convention. Newton's method gives the inverse. Beyond the angle up to which r grows, pixels have no ray and points have
no pixel. OpenCV's own functions stop at 90 degrees; here angles go up to that limit or 180 degrees.
Singular: that angle, and the point straight behind the eye.
Reference: J. Kannala and S. Brandt, A Generic Camera Model and Calibration Method (2006); OpenCV documentation, Fisheye
camera model.
"""

from dataclasses import dataclass

from .model import Step
from .parts.calibration import CALIBRATION, FISHEYE
from .parts.kannala_brandt import KannalaBrandt
from .parts.radial import COORDINATES, RADIUS, RAY


@dataclass(frozen=True)
class OpencvFisheye(KannalaBrandt):
    """A fisheye with four coefficients and no other distortion."""

    key = "OPENCV_FISHEYE"
    label = "OpenCV Fisheye"
    description = "A calibrated fisheye, by Kannala and Brandt"
    number = 5
    RADIAL = FISHEYE
    SETTINGS = (*CALIBRATION, *FISHEYE)
    FORMULA = (
        COORDINATES,
        RADIUS,
        Step("Angle, by Newton's method", "rho = theta (1 + k1 theta² + k2 theta⁴ + k3 theta⁶ + k4 theta⁸)"),
        RAY,
    )
