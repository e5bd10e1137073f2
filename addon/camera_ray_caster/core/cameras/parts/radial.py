"""The base of all fisheyes: the angle from the axis depends on the radius in the image alone, and azimuth is kept.

With (a, b) the pixel on the image plane and r its length, the ray at the angle theta(r) from the viewing direction is
F = (a/r sin theta, b/r sin theta, -cos theta): straight ahead at r = 0, where sin theta / r has a finite limit.
A model defines the factors sin theta / r and cos theta, and the inverse, r(theta).
Reference: Blender manual, Cameras > Panoramic; Kannala and Brandt (2006), section 2, for the family.
"""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass, replace
from math import inf, pi, radians

import numpy as np

from ...maths.panels import Disc, is_raster, on_raster
from ...maths.speed import lazy
from ...maths.vector import components
from ..model import IN_CASTS, Step, WindowModel
from .affine_window import AffineWindow
from .settings import ABOVE_ZERO, CAMERA, Number
from .silhouette import pixel_bounds, radial_intervals

FOV = Number("fov", "Field of View", "Angle of view from rim to rim of the picture", pi, radians(1), 2 * pi, "angle", 4)
FISHEYE_FOV = Number(
    "fisheye_fov", "Field of View", "Angle of view from rim to rim of the picture", pi, ABOVE_ZERO, radians(1800),
    "angle", owner=CAMERA,
)  # fmt: skip
FISHEYE_LENS = Number(
    "fisheye_lens", "Focal Length", "Focal length of the fisheye lens", 10.5, ABOVE_ZERO, inf, "mm", owner=CAMERA
)  # fmt: skip

ROUND_PLANE = Step(
    "Point on the plane, shorter side from -1 to 1 (p: pixel height / width)",
    "a = (2 x/W - 1 + 2 shift_x) W / w, b = (2 y/H - 1 + 2 shift_y) p H / w, w = min(W, p H)",
)
WHOLE_PLANE = Step("Pixel on the plane, the frame's sides at 1", "a = 2 x/W - 1 + 2 shift_x, b = 2 y/H - 1 + 2 shift_y")
SENSOR_PLANE = Step(
    "Point on the sensor, mm (p: pixel height / width)",
    "a = (x - W/2 + shift_x W) sensor / V, b = (y - H/2 + shift_y H) p sensor / V",
)
COORDINATES = Step(
    "Distorted coordinates, in focal lengths, y up", "b = (H - y - 1/2 - cy) / -fy, a = (x - 1/2 - cx + skew b) / fx"
)
DISTORTED = Step(
    "Distorted coordinates, in focal lengths, y down", "v = (H - y - 1/2 - cy) / fy, u = (x - 1/2 - cx - skew v) / fx"
)
RADIUS = Step("Radius", "rho = sqrt(a² + b²); no ray beyond the rim")
RAY = Step("Direction, with the same azimuth", "r = (a/rho sin(theta), b/rho sin(theta), -cos(theta))")

TINY = 1e-300
"""A radius in place of r = 0: its square underflows, and its reciprocal is finite."""

RIM_SLACK = 2.0**-30
"""Angle in radians beyond the rim within which a point counts as on the rim, so that a point on any ray of a picture
has a pixel. Rounding moves a point this far if it is a million times nearer to the eye than to the world's origin.
"""


@dataclass(frozen=True)
class Radial(WindowModel):
    """A central model with rays (a k, b k, -c) where (k, c) = factors(a^2 + b^2)."""

    rim: float
    """Radius r beyond which there is no ray; inf if only the factors or the frame limit the picture."""

    group = "Fisheye"

    @abstractmethod
    def factors(self, r_squared):
        """Return sin(theta) / r and cos(theta) for squared radii; NaN in both where there is no ray.

        Beyond the rim, which the caller cuts off, they are whatever the formula gives.
        """

    @abstractmethod
    def radius(self, theta):
        """Return r of angles 0 .. pi from the axis, up to ``widest``: the least r that sees each. NaN stays NaN."""

    @property
    @abstractmethod
    def widest(self) -> float:
        """Return the angle at the rim. r grows with theta from 0 up to this angle; beyond pi the picture repeats."""

    @property
    def disc(self) -> Disc | None:
        """See Model: None if the rim is not an ellipse with its axes along the frame's sides."""
        if self.rim == np.inf or isinstance(self.window, AffineWindow):
            return None
        return Disc((self.window.center_x, self.window.center_y), self._is_within)

    @lazy
    def endless(self) -> Radial:
        return self if self.disc is None else replace(self, rim=inf)

    def rays(self, x, y):
        """See Model. The direction is NaN where there is no ray. Each component is right to some EPS of 1 + theta."""
        a, b = self._plane(x, y)
        scale, cosine = self._factors_at(x, y)
        return (0.0, 0.0, 0.0), (a * scale, b * scale, -cosine)

    def _plane(self, x, y):
        return self.window.plane_from_pixels(x, y)

    def _pixels(self, a, b):
        return self.window.pixels_from_plane(a, b)

    def _r_squared(self, x, y):
        a, b = self._plane(x, y)
        return a * a + b * b

    def _is_within(self, x, y):
        return self._r_squared(x, y) <= self.rim * self.rim

    def _factors_at(self, x, y):
        if not (self.polynomials == IN_CASTS and is_raster(x, y)):
            return self._factors_within(self._r_squared(x, y))
        factors = self._factors_within if self.disc is None else self.factors
        return on_raster(lambda x, y: factors(self._r_squared(x, y)), x, y, self.disc)

    def _factors_within(self, r_squared):
        if self.rim < np.inf:
            r_squared = np.where(r_squared > self.rim * self.rim, np.nan, r_squared)
        return self.factors(r_squared)

    def project(self, points):
        """See Model: NaN also at the eye and straight behind it, where the azimuth is undefined. If a point has several
        images (fov beyond 360 degrees), the result is the one nearest to the axis.
        """
        x, y, z = components(np.asarray(points, np.float64))
        across = np.hypot(x, y)
        r = np.minimum(self.radius(up_to(self.widest, np.arctan2(across, -z))), self.rim)
        defined = (across > 0) | ((z < 0) & (r == 0))
        scale = np.where(defined, r / np.where(across > 0, across, 1.0), np.nan)
        return np.stack(self._pixels(x * scale, y * scale), axis=-1)

    def bounds(self, centers, radii):
        return pixel_bounds(self.window, *radial_intervals(centers, radii, self.radius, self.widest))


def radii_of(r_squared):
    """Return the radii of squared radii, at least TINY."""
    return np.maximum(np.sqrt(r_squared), TINY)


def factors_of(theta, r):
    """Return sin(theta) / r and cos(theta), right to gamma(10) of the first and gamma(8) of 1.

    They follow from the tangent of theta / 2 (right to gamma(4) in numpy). A sine takes as long as a tangent; on
    processors with AVX-512 it takes 6 to 8 times as long (numpy 1.26 and 2.5), and a cosine as well.
    """
    tangent = np.tan(theta / 2)
    share = 2 / (1 + tangent * tangent)
    return share * tangent / r, share - 1


def up_to(widest: float, theta):
    """Return angles, limited to ``widest``; NaN for angles that exceed it by more than RIM_SLACK."""
    return np.where(theta <= widest + RIM_SLACK, np.minimum(theta, widest), np.nan)
