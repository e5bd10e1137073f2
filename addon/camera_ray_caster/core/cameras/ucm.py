"""The unified camera: a model of mirror lenses and fisheyes, as calibrated by OpenCV's omnidir and Kalibr's omni.

Assumption: a point is projected onto the unit sphere about the eye and seen from xi behind the eye; then the picture is
distorted and K applies. xi = 0 is a pinhole, xi = 1 a stereographic fisheye.
Formula: see parts/unified.py with alpha = 0, and parts/radial_tangential.py.
Singular: the edge of the picture, where the angle from the axis is acos(-xi), or acos(-1 / xi) from xi = 1 on.
References: C. Mei and P. Rives, Single View Point Omnidirectional Camera Calibration from Planar Grids (2007); OpenCV
documentation, Omnidirectional Camera Calibration.
"""

from dataclasses import dataclass

from .model import Step
from .parts.calibration import CALIBRATION, K1, K2, P1, P2
from .parts.radial import DISTORTED, RAY
from .parts.unified import XI, Unified


@dataclass(frozen=True)
class UnifiedCamera(Unified):
    """A lens with r = sin(theta) / (xi + cos(theta)), distorted."""

    key = "UCM"
    label = "Unified (UCM, Mei)"
    description = "A calibrated mirror lens or fisheye: a sphere seen from behind its center"
    number = 17
    NUMBERS, DISTORTION = {"xi": XI}, (K1, K2, P1, P2)
    SETTINGS = (*CALIBRATION, XI, *DISTORTION)
    FORMULA = (
        DISTORTED,
        Step(
            "Gain at the undistorted a and b, y up, found by Newton's method",
            "rho = sqrt(a² + b²), g = 1 + k1 rho² + k2 rho⁴",
        ),
        Step("Their distortion across gives u", "u = a g - 2 p1 a b + p2 (rho² + 2 a²)"),
        Step("Their distortion down gives v", "v = -b g + p1 (rho² + 2 b²) - 2 p2 a b"),
        Step(
            "Angle from the axis, seen from the center and from xi behind it",
            "phi = atan(rho), theta = phi + asin(xi sin(phi))",
        ),
        RAY,
    )

    def formula_values(self, x, y):
        """See Model: the undistorted coordinates."""
        return self.undistorted(x, y)
