"""The thin prism fisheye: equidistant, and distorted as a pinhole's picture would be.

Assumption: the radius is the angle from the axis; the picture of that is distorted.
Formula: r = theta, in focal lengths, then parts/radial_tangential.py with k4 as the coefficient of r^8, as COLMAP has
it; its sx1 and sy1 are s1 and s3 here. Then K. The distortion is inverted by Newton's method, to full precision.
Pixels and points beyond the angle up to which it is one-to-one, or 180 degrees, have no ray and no pixel.
Singular: that angle, and the point straight behind the eye.
References: J. Weng, P. Cohen and M. Herniou, Camera Calibration with Distortion Models and Accuracy Evaluation (1992);
COLMAP documentation, Camera Models.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..records import BlenderCamera, Raster
from .model import Step
from .parts.calibration import CALIBRATION, K1, K2, K3, K4, P1, P2, S1, S3, Calibration
from .parts.kannala_brandt import KannalaBrandt
from .parts.radial import COORDINATES, RAY
from .parts.radial_tangential import RadialTangential

DISTORTION = K1, K2, P1, P2, K3, K4, S1, S3


@dataclass(frozen=True)
class ThinPrismFisheye(KannalaBrandt):
    """r = theta, distorted."""

    key = "THIN_PRISM_FISHEYE"
    label = "Thin Prism Fisheye"
    description = "A calibrated fisheye: equidistant, with radial, tangential and thin prism distortion"
    number = 21
    SETTINGS = (*CALIBRATION, *DISTORTION)
    FORMULA = (
        COORDINATES,
        Step("Undistorted across, by Newton's method", "a g + 2 p1 a b + p2 (r² + 2 a²) + s1 r², r² = a² + b²"),
        Step("Undistorted down, b down, too", "b g + p1 (r² + 2 b²) + 2 p2 a b + s3 r²"),
        Step("Gain", "g = 1 + k1 r² + k2 r⁴ + k3 r⁶ + k4 r⁸"),
        Step("Angle from the axis", "theta = r"),
        RAY,
    )

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> ThinPrismFisheye:
        """Build it from the settings of the same names; InputError for one without meaning."""
        calibration = Calibration.from_blender(raw, raster, DISTORTION)
        coefficients = dict(calibration.coefficients)
        eighth = coefficients.pop(K4.name)
        return cls.of(calibration, raster, (), RadialTangential(**coefficients, r8=eighth))
