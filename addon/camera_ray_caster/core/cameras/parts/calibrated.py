"""The base of calibrated lenses that are symmetric about the axis, except for a distortion of the picture.

A point at the angle theta from the axis lies at the radius r(theta) on the plane of a ``Radial``. There the distortion
of radial_tangential.py moves it, and K brings it to the pixel. Rays undo these steps in reverse order. The picture ends
where r(theta) stops growing, or where the distortion stops being one-to-one, whichever is nearer.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Self

import numpy as np

from ...maths.panels import Disc, on_raster
from ...maths.recording import is_recorded
from ...maths.recording.scalars import least, plain
from ..model import IN_RAYS
from .film import FARTHEST_PIXELS
from .radial import RIM_SLACK, Radial
from .radial_tangential import RadialTangential
from .silhouette import angular_radius, pixel_bounds, radial_intervals

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
        across = np.hypot(centers[:, 0], centers[:, 1])
        far = np.arctan2(across, -centers[:, 2]) + angular_radius(np.hypot(across, centers[:, 2]), radii)
        spread = self.distortion.off_radius(self.radius(np.minimum(far, self.widest)))

        def radius(theta):
            r = self.radius(theta)
            return r * self.distortion.gain(r * r)[0]

        intervals = radial_intervals(centers, radii, radius, self.widest)
        return pixel_bounds(self.window, *((low - spread, high + spread) for low, high in intervals))
