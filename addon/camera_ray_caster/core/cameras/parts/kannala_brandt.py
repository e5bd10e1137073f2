"""The fisheye of Kannala and Brandt: the radius is an odd polynomial of the angle from the axis, of any degree.

r = theta (1 + k1 theta^2 + k2 theta^4 + ...), up to the angle where r stops growing, or 180 degrees. It is inverted by
Newton's method. Further distortion is applied to the picture as in ``Calibrated``.
Reference: J. Kannala and S. Brandt, A Generic Camera Model and Calibration Method (2006).
"""

from dataclasses import dataclass
from functools import cached_property
from math import inf, pi
from typing import ClassVar, Self

import numpy as np

from ...maths.inversion import Inverse
from ...maths.polynomials import horner
from ...maths.recording import is_recorded, least_root
from ...maths.recording.scalars import least, plain, sqrt
from ...maths.speed import lazy
from ...records import BlenderCamera, Raster
from ..model import IN_CASTS
from .calibrated import Calibrated
from .calibration import Calibration
from .radial import factors_of, radii_of
from .radial_tangential import RadialTangential
from .settings import Number


@dataclass(frozen=True)
class KannalaBrandt(Calibrated):
    """r = polynomial(theta) up to ``limit``."""

    coefficients: tuple[float, ...]
    """Coefficients k1, k2, ..."""

    guarded = False
    polynomials = IN_CASTS
    RADIAL: ClassVar[tuple[Number, ...]] = ()
    """The settings of ``coefficients``."""

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Self:
        calibration = Calibration.from_blender(raw, raster, (*cls.RADIAL, *cls.DISTORTION))
        others = dict(calibration.coefficients)
        radial = tuple(others.pop(setting.name) for setting in cls.RADIAL)
        return cls(raster.size, calibration.window(), inf, radial, distortion=RadialTangential(**others)).settled()

    def distorted(self, theta):
        """Return the radii r of angles."""
        return theta * horner(theta * theta, (1.0, *self.coefficients))

    def slope(self, theta):
        """Return the derivative of r by theta."""
        return horner(theta * theta, self._slope)

    @lazy
    def _slope(self) -> list[float]:
        return [1.0, *((2 * i + 3) * k for i, k in enumerate(self.coefficients))]

    @lazy
    def limit(self) -> float:
        """The angle at which the polynomial stops growing, at most pi."""
        return least(pi, sqrt(least_root(self._slope)))

    @property
    def own_rim(self) -> float:
        return self.distorted(self.limit)

    @cached_property
    def angle(self):
        """Return the inverse of ``distorted``: a function from r to the angle."""
        return Inverse(self.distorted, self.slope, 0.0, self.limit)

    def formula_values(self, x, y):
        """See Model: the angle, unless it is beyond the rim."""
        theta = plain(self.angle(np.sqrt(self._r_squared(x, y))))
        return {"theta": theta} if is_recorded(theta) or theta <= self.limit else {}

    def factors(self, r_squared):
        r = radii_of(r_squared)
        theta = self.angle(r)
        return factors_of(theta, r)

    def radius(self, theta):
        return self.distorted(theta)

    @lazy
    def widest(self) -> float:
        return self.limit if self.rim >= self.own_rim else float(self.angle(self.rim))
