"""The unified camera and its relatives: a sphere or ellipsoid about the eye shows all points, and is seen from behind.

With (s, z) the sine and cosine of the angle theta from the axis, the radius in the picture is
    r = s / (alpha sqrt(beta s^2 + (xi + z)^2) + (1 - alpha) (xi + z)).
alpha = 0 is the unified camera (C. Geyer and K. Daniilidis, 2000), xi = 0 the enhanced one (B. Khomutenko and others,
2016), beta = 1 the double sphere (V. Usenko and others, 2018). The inverse has a closed form as well: with
    D = alpha sqrt(1 + (1 - 2 alpha) beta r^2) + 1 - alpha,  N = 1 - beta alpha^2 r^2,
(r D, N) has the direction of the angle phi at a point xi behind the eye, and theta = phi + asin(xi sin(phi)). The sine
and the cosine of theta are computed without the angles. D and N have the factor D in common, since
    N (1 - 2 alpha) = D (1 - alpha - alpha sqrt(1 + (1 - 2 alpha) beta r^2)),
and it changes its sign at r = 1 / (sqrt(beta) |alpha|) if alpha is below 0 or above 1: then the quotients are taken.
The picture ends where r stops growing with theta; otherwise r has no limit.
"""

from dataclasses import dataclass
from math import inf

import numpy as np

from ...maths.recording.scalars import least, sqrt
from .calibrated import Calibrated
from .settings import Number

XI = Number(
    "unified_xi", "Xi", "Distance from the center of the sphere back to the center of "
                        "projection, in sphere radii", 0.0, -0.99, 1e3, digits=6,
    step=0.1,
)  # fmt: skip
ALPHA = Number(
    "unified_alpha", "Alpha", "How the sphere is projected: 0 by a pinhole at its center, "
                              "1 by parallel rays", 0.5, -1.0, 2.0, digits=6,
    step=0.1,
)  # fmt: skip
BETA = Number("unified_beta", "Beta", "Flattening of the ellipsoid; 1 is a sphere", 1.0, 1e-3, 1e3, digits=6, step=0.1)


@dataclass(frozen=True)
class Unified(Calibrated):
    """A lens that projects points onto a sphere or an ellipsoid, and that as a pinhole farther back sees it."""

    xi: float = 0.0
    alpha: float = 0.0
    beta: float = 1.0

    @property
    def own_rim(self) -> float:
        rims = [inf]
        if self.alpha > 0.5:
            rims.append(1 / sqrt(self.beta * (2 * self.alpha - 1)))
        if self.xi > 1:  # phi is at most asin(1 / xi)
            steepest = 1 / sqrt((self.xi - 1) * (self.xi + 1))
            rims.append(steepest / (self.alpha * sqrt(self.beta * steepest * steepest + 1) + 1 - self.alpha))
        return least(*rims)

    def factors(self, r_squared):
        s = r_squared
        if self.alpha:
            root = np.sqrt(np.maximum(1 + (1 - 2 * self.alpha) * self.beta * s, 0.0))
            if 0 <= self.alpha <= 0.999:
                scale, ahead = self.alpha * root + (1 - self.alpha), 1 - self.beta * self.alpha**2 * s
            else:
                scale = abs(1 - 2 * self.alpha)
                ahead = (1 - self.alpha - self.alpha * root) * (1 if self.alpha < 0 else -1)
            length = np.sqrt(s * scale * scale + ahead * ahead)
            scale, cosine = scale / length, ahead / length
        else:
            scale = cosine = 1 / np.sqrt(1 + s)
        if not self.xi:
            return scale, cosine
        across = scale * scale * s
        turn = np.sqrt(np.maximum(cosine * cosine + (1 - self.xi) * (1 + self.xi) * across, 0.0))
        return scale * (turn + self.xi * cosine), cosine * turn - self.xi * across

    def radius(self, theta):
        across, ahead = np.sin(theta), np.cos(theta) + self.xi
        if not self.alpha:
            return across / ahead
        length = np.sqrt(self.beta * across * across + ahead * ahead)
        return across / (self.alpha * length + (1 - self.alpha) * ahead)
