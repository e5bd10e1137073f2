"""The thin prism fisheye: equidistant, with the distortion of a pinhole's picture.

Assumption: the radius is the angle from the axis, and the resulting picture is distorted.
Formula: r = theta, in focal lengths, then parts/radial_tangential.py with k4 as the coefficient of r^8, as in COLMAP,
whose sx1 and sy1 are s1 and s3 here. Then K. The distortion is inverted by Newton's method, to full precision.
Beyond the angle up to which it is one-to-one, or 180 degrees, pixels have no ray and points have no pixel.
Singular: that angle, and the point straight behind the eye.
References: J. Weng, P. Cohen and M. Herniou, Camera Calibration with Distortion Models and Accuracy Evaluation (1992);
COLMAP documentation, Camera Models.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

from ..records import BlenderCamera, Raster
from .model import Step
from .parts.calibration import CALIBRATION, K1, K2, K3, K4, P1, P2, S1, S3, Calibration
from .parts.kannala_brandt import KannalaBrandt
from .parts.radial import DISTORTED, RAY
from .parts.radial_tangential import RadialTangential

DISTORTION = K1, K2, P1, P2, K3, K4, S1, S3


@dataclass(frozen=True)
class ThinPrismFisheye(KannalaBrandt):
    """A fisheye with r = theta, distorted."""

    key = "THIN_PRISM_FISHEYE"
    label = "Thin Prism Fisheye"
    description = "A calibrated fisheye: equidistant, with radial, tangential and thin prism distortion"
    number = 21
    SETTINGS = (*CALIBRATION, *DISTORTION)
    FORMULA = (
        DISTORTED,
        Step(
            "Gain at the undistorted a and b, y up, found by Newton's method",
            "rho = sqrt(a² + b²), g = 1 + k1 rho² + k2 rho⁴ + k3 rho⁶ + k4 rho⁸",
        ),
        Step("Their distortion across gives u", "u = a g - 2 p1 a b + p2 (rho² + 2 a²) + s1 rho²"),
        Step("Their distortion down gives v", "v = -b g + p1 (rho² + 2 b²) - 2 p2 a b + s3 rho²"),
        Step("Angle from the axis", "theta = rho"),
        RAY,
    )

    def formula_values(self, x, y):
        """See Model: the undistorted coordinates."""
        return self.undistorted(x, y)

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> ThinPrismFisheye:
        calibration = Calibration.from_blender(raw, raster, DISTORTION)
        coefficients = dict(calibration.coefficients)
        distortion = RadialTangential(r8=coefficients.pop(K4.name), **coefficients)
        return cls(raster.size, calibration.window(), inf, (), distortion=distortion).settled()
