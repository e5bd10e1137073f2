"""The enhanced unified camera: a model of fisheyes with two parameters and without further distortion.

Assumption: a point is projected onto an ellipsoid about the eye and seen from behind the eye; then K applies.
Formula: see parts/unified.py with xi = 0. beta = 1 is the unified camera with xi = alpha / (1 - alpha), its focal
lengths divided by 1 - alpha.
Singular: the edge of the picture, at r = 1 / sqrt(beta (2 alpha - 1)) if alpha > 1/2.
Reference: B. Khomutenko, G. Garcia and P. Martinet, An Enhanced Unified Camera Model (2016).
"""

from dataclasses import dataclass

from .model import Step
from .parts.calibration import CALIBRATION
from .parts.radial import COORDINATES, RADIUS
from .parts.unified import ALPHA, BETA, Unified


@dataclass(frozen=True)
class EnhancedUnifiedCamera(Unified):
    """A lens with r = sin(theta) / (alpha sqrt(beta sin(theta)^2 + cos(theta)^2) + (1 - alpha) cos(theta))."""

    key = "EUCM"
    label = "Enhanced Unified (EUCM)"
    description = "A calibrated fisheye: an ellipsoid seen from behind its center"
    number = 18
    NUMBERS = {"alpha": ALPHA, "beta": BETA}
    SETTINGS = (*CALIBRATION, ALPHA, BETA)
    FORMULA = (
        COORDINATES,
        RADIUS,
        Step("Lengths", "D = alpha sqrt(1 + (1 - 2 alpha) beta rho²) + 1 - alpha, N = 1 - beta alpha² rho²"),
        Step("Direction", "r = (D a, D b, -N) / sqrt(D² rho² + N²)"),
    )
