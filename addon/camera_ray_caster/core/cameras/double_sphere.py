"""The double sphere camera: a model of fisheyes with two parameters and without further distortion.

Assumption: a point is projected onto the unit sphere about the eye, from there onto a sphere about a center xi away,
and is seen from behind that center; then K applies.
Formula: see parts/unified.py with beta = 1.
Singular: the edge of the picture, at r = 1 / sqrt(2 alpha - 1) if alpha > 1/2.
Reference: V. Usenko, N. Demmel and D. Cremers, The Double Sphere Camera Model (2018).
"""

from dataclasses import dataclass

from .model import Step
from .parts.calibration import CALIBRATION
from .parts.radial import COORDINATES, RADIUS
from .parts.unified import ALPHA, XI, Unified


@dataclass(frozen=True)
class DoubleSphere(Unified):
    """A lens with r = sin(theta) / (alpha sqrt(sin(theta)^2 + (xi + cos(theta))^2) + (1 - alpha) (xi + cos(theta)))."""

    key = "DOUBLE_SPHERE"
    label = "Double Sphere"
    description = "A calibrated fisheye: two spheres, the second seen from behind its center"
    number = 19
    NUMBERS = {"xi": XI, "alpha": ALPHA}
    SETTINGS = (*CALIBRATION, XI, ALPHA)
    FORMULA = (
        COORDINATES,
        RADIUS,
        Step("Lengths", "D = alpha sqrt(1 + (1 - 2 alpha) rho²) + 1 - alpha, N = 1 - alpha² rho²"),
        Step("On the second sphere", "s = D rho / sqrt(D² rho² + N²), c = N / sqrt(D² rho² + N²)"),
        Step("Distance from the second sphere's center to the first sphere", "t = xi c + sqrt(1 - xi² s²)"),
        Step("Direction", "r = (a/rho t s, b/rho t s, xi - t c)"),
    )
