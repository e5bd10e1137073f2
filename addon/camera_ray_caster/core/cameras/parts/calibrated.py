"""The base of calibrated lenses that are symmetric about the axis, except for a distortion of the picture.

A point at the angle theta from the axis lies at the radius r(theta) on the plane of a ``Radial``. There the distortion
of radial_tangential.py moves it, and K brings it to the pixel. Rays undo these steps in reverse order. The picture ends
where r(theta) stops growing, or where the distortion stops being one-to-one, whichever is nearer.
"""

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import inf
from typing import ClassVar, Self

import numpy as np

from ...maths.panels import Disc, on_raster
from ...maths.recording import is_recorded
from ...maths.recording.scalars import least, plain
from ...records import BlenderCamera, Raster
from ..model import IN_RAYS
from .calibration import Calibration
from .film import FARTHEST_PIXELS
from .radial import RIM_SLACK, Radial
from .radial_tangential import RadialTangential
from .settings import Number
from .silhouette import pixel_bounds

SUPERSCRIPTS = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")


def in_words(name: str, first: int, coefficients: Sequence[float], variable: str) -> str:
    """Return a polynomial as a formula, such as "k1 theta + k2 theta²"; ``first`` is the power of the first term."""
    powers = ["", f" {variable}", *(f" {variable}{str(i).translate(SUPERSCRIPTS)}" for i in range(2, 99))]
    return " + ".join(f"{name}{i}{powers[i]}" for i in range(first, first + len(coefficients)))


@dataclass(frozen=True)
class Calibrated(Radial):
    """A ``Radial`` whose plane is distorted; its unit is the focal length."""

    distortion: RadialTangential = field(default=RadialTangential(), kw_only=True)

    group = "Calibrated"
    polynomials = IN_RAYS  # and in casts where there is distortion: see ``rays``
    NUMBERS: ClassVar[dict[str, Number]] = {}
    """The settings of the model's own numbers, by its fields."""
    DISTORTION: ClassVar[tuple[Number, ...]] = ()
    """The settings of the coefficients of ``distortion``."""

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Self:
        """See Model: by K or the lens, NUMBERS and DISTORTION."""
        calibration = Calibration.from_blender(raw, raster, cls.DISTORTION)
        numbers = {field: setting.read(raw) for field, setting in cls.NUMBERS.items()}
        distortion = RadialTangential(**calibration.coefficients)
        return cls(raster.size, calibration.window(), inf, **numbers, distortion=distortion).settled()

    @property
    def guarded(self) -> bool:  # type: ignore[override]
        """See Model: rays iterate to undo the distortion."""
        return not self.distortion.bends

    @property
    @abstractmethod
    def own_rim(self) -> float:
        """Return the radius where r(theta) stops growing, the rim of the lens without distortion; inf without one."""

    def settled(self) -> Self:
        """See Model: the rim, which may jump or become infinite where the coefficients change little."""
        rim = least(self.own_rim, self.distortion.limit)
        return self if rim == self.rim else replace(self, rim=rim)

    @property
    def disc(self) -> Disc | None:
        return None if self.distortion.bends else super().disc

    @property
    def K(self) -> np.ndarray | None:
        return self.window.matrix(self.size[1])

    @cached_property
    def widest(self) -> float:
        """See Radial; for an endless picture, the angle at the radius FARTHEST_PIXELS."""
        r = min(self.rim, FARTHEST_PIXELS)
        scale, cosine = self.factors(np.float64(r * r))
        return float(np.arctan2(scale * r, cosine))

    def rays(self, x, y):
        if not self.distortion.bends:
            return super().rays(x, y)
        return (0.0, 0.0, 0.0), tuple(on_raster(self._directions, x, y, count=3))

    def undistorted(self, x: float, y: float) -> dict[str, float]:
        """Return a and b of a pixel on the undistorted plane, y up, as values for a formula."""
        return dict(zip("ab", map(plain, self._plane(x, y)), strict=True))

    def _directions(self, x, y):
        a, b = self._plane(x, y)
        scale, cosine = self._factors_within(a * a + b * b)
        return a * scale, b * scale, -cosine

    def _plane(self, x, y):
        a, b = super()._plane(x, y)
        if not self.distortion.bends:
            return a, b
        if self._farthest < np.inf:
            a = np.where(a * a + b * b > self._farthest**2, np.nan, a)
        across, down = self.distortion.undistort(a, -b)
        return across, -down

    @cached_property
    def _farthest(self) -> float:
        """Return a radius in the distorted picture beyond which there is certainly no ray."""
        if not self.rim < np.inf:
            return np.inf
        farthest = plain(self.distortion.farthest(self.rim)) * (1 + RIM_SLACK)
        return plain(np.where(self.rim < np.inf, farthest, np.inf)) if is_recorded(self.rim) else farthest

    def _pixels(self, a, b):
        across, down = self.distortion.distort(a, -b)
        return super()._pixels(across, -down)

    def bounds(self, centers, radii):
        return pixel_bounds(self.window, *self.distortion.intervals(centers, radii, self.radius, self.widest))
