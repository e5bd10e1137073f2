"""The fisheye of a measured lens: Blender's FISHEYE_LENS_POLYNOMIAL.

Assumption: the angle from the axis is a polynomial of the radius on the sensor, in millimeters; the sensor is fitted
to the frame as for a pinhole.
Formula: theta = -(k0 + k1 r + k2 r^2 + k3 r^3 + k4 r^4); no ray where abs(theta) > fov / 2. The minus is Blender's: an
upright picture needs k1 < 0. A negative theta lies on the other side of the axis. Newton's method gives the inverse.
Singular: r = 0 if k0 is not 0. The lens is not smooth there: theta is -k0 and the azimuth is undefined (in Cycles
rounding decides; here the ray is turned up). With k0 < 0 no pixel sees the cone of half angle -k0 about the axis.
A polynomial that turns back inside the frame would fold the picture and is refused.
Reference: Blender manual, Cameras > Panoramic; rays read out of Cycles.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import hypot

import numpy as np

from ..conventions import gamma
from ..maths.inversion import Inverse
from ..maths.polynomials import positive_roots
from ..maths.recording import is_recorded
from ..maths.speed import lazy
from ..records import BlenderCamera, InputError, Raster
from .model import IN_CASTS, Step
from .parts.film import FILM, Film, Window
from .parts.radial import FISHEYE_FOV, RADIUS, RAY, SENSOR_PLANE, TINY, Radial, factors_of, radii_of, up_to
from .parts.settings import CAMERA, FULL_TURN, Number
from .parts.silhouette import pixel_bounds, radial_intervals

BEYOND = 1 + 1e-6
"""The rim over the radius at which theta leaves the field of view, and the picture ends. The margin covers the error of
the inverse, which is the square root of EPS where theta is flat.
"""

COEFFICIENTS = tuple(
    Number(f"fisheye_polynomial_k{i}", f"K{i}", f"Coefficient of r^{i}, rad / mm^{i}, negated", default, owner=CAMERA)
    for i, default in enumerate((-1.1735143712967577e-05, -0.019988736953434998, -3.3525322965709175e-06,
                                 3.099275275886036e-06, -2.6064646454854524e-08))
)  # fmt: skip


@dataclass(frozen=True)
class FisheyePolynomial(Radial):
    """A lens with theta = polynomial(r), monotone up to ``limit``; falling theta turns the picture by 180 degrees."""

    coefficients: tuple[float, ...]
    """Coefficients of theta, from the constant up, in rad / mm^i: Blender's, negated."""
    half_fov: float

    key = "FISHEYE_LENS_POLYNOMIAL"
    label = "Fisheye Lens Polynomial"
    description = "A measured lens: the angle is a polynomial of the radius on the sensor"
    group = "Blender's Own"
    polynomials = IN_CASTS
    SETTINGS = (*COEFFICIENTS, FISHEYE_FOV, *FILM)
    FORMULA = (
        SENSOR_PLANE, RADIUS, Step("Angle from the axis", "theta = -(k0 + k1 rho + k2 rho² + k3 rho³ + k4 rho⁴)"), RAY,
    )  # fmt: skip

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> FisheyePolynomial:
        """See Model. A polynomial that folds the picture is refused."""
        film = Film.from_blender(raw, raster)
        window = Window.round_pixels(raw, raster, film.size / film.fitted_pixels)
        coefficients = tuple(-coefficient.read(raw) for coefficient in COEFFICIENTS)
        half_fov = FISHEYE_FOV.read(raw) / 2
        lens = cls(raster.size, window, np.inf, coefficients, half_fov)
        if is_recorded(half_fov, *coefficients):
            return lens  # the rim alone would need the inverse, and rays end there without it
        corner, turns = lens._corner, _turns(coefficients, lens._corner)
        if turns.size and _is_seen_beyond(coefficients, turns, corner, half_fov):
            names = ", ".join(f"k{i} = {-k:g}" for i, k in enumerate(coefficients))
            raise InputError(
                f"the fisheye polynomial of camera {raw.name!r} ({names}) turns back {turns[0]:.6g} mm from the axis "
                f"and folds the picture: it must grow or fall all the way to the corner at {corner:.6g} mm"
            )
        return lens.settled()

    def settled(self) -> FisheyePolynomial:
        ends = self.widest < np.inf and self.half_fov <= self.angle(min(self.limit, self._corner))
        rim = float(np.fmax(self._inverse(self.half_fov), 0.0)) * BEYOND if ends else np.inf  # 0 if theta begins beyond
        return self if rim == self.rim else replace(self, rim=rim)

    @property
    def _corner(self) -> float:
        x0, x1, y0, y1 = self.window.extent(self.size)
        return hypot(max(-x0, x1), max(-y0, y1))

    @lazy
    def limit(self) -> float:
        """The radius in mm up to which there is an inverse: where theta turns back, or else where it leaves the field
        of view, but not less than the corner of the frame.
        """
        start, *higher = self.coefficients
        ends = [np.polynomial.Polynomial((start - end, *higher)) for end in (-self.half_fov, self.half_fov)]
        beyond = [BEYOND * r for end in ends for r in positive_roots(end).tolist() if r > self._corner]
        reach = min(beyond, default=self._corner)
        return float(min([reach, *_turns(self.coefficients, reach)]))

    def _knots(self, low: float, high: float, count: int) -> np.ndarray:
        """Return the points of the inverse's table: even up to the corner of the frame, then ever wider."""
        within = 3 * count // 4
        if high <= self._corner:
            return np.linspace(low, high, count)
        out = np.geomspace(self._corner, high, count - within + 1)
        return np.concatenate((np.linspace(low, self._corner, within), out[1:-1], [high]))

    def angle(self, r):
        """Return theta (rad) of radii in mm."""
        k0, k1, k2, k3, k4 = self.coefficients
        return k0 + r * (k1 + r * (k2 + r * (k3 + r * k4)))

    def _plane(self, x, y):
        """Return the point on the plane; at r = 0 with k0 not 0 it is moved up a little, which turns the ray up."""
        a, b = super()._plane(x, y)
        return a, b + np.where(b == 0, TINY, 0.0) if self.coefficients[0] else b

    def factors(self, r_squared):
        r = radii_of(r_squared)
        theta = self.angle(r)
        theta = np.where(np.abs(theta) > self.half_fov, np.nan, theta)
        return factors_of(theta, r)

    @cached_property
    def _sign(self) -> float:
        return 1.0 if self.angle(self.limit) >= self.coefficients[0] else -1.0

    @cached_property
    def _inverse(self):
        return Inverse(self._growing, self._slope, 0.0, self.limit, self._knots)

    def _growing(self, r):
        return self._sign * self.angle(r)

    def _slope(self, r):
        k1, k2, k3, k4 = (self._sign * i * k for i, k in enumerate(self.coefficients[1:], 1))
        return k1 + r * (k2 + r * (k3 + r * k4))

    def radius(self, theta):
        """See Radial; r is negative if theta is seen on the other side of the axis."""
        start, sign = self.coefficients[0], self._sign
        same, across = (sign * start + _turned(sign * (angle - start)) for angle in (theta, -theta))
        target = np.minimum(same, across)
        r = self._inverse(np.sign(target) * up_to(self.half_fov, np.abs(target)))
        return np.where(same <= across, r, -r)

    def bounds(self, centers, radii):
        """See Radial; the cone about the axis that no pixel sees counts as the center of the picture."""
        seen = lambda theta: self.radius(np.maximum(theta, self.coefficients[0]))  # noqa: E731
        return pixel_bounds(self.window, *radial_intervals(centers, radii, seen, self.widest))

    @property
    def widest(self) -> float:
        """See Radial; inf if the picture is turned by 180 degrees or crosses the axis: it has no simple bounds then."""
        rim = self.angle(self.limit)
        return min(rim, self.half_fov) if rim > self.coefficients[0] >= 0 else np.inf


def _turned(theta):
    """Return angles reduced to [0, FULL_TURN); angles within rounding of 0 become 0."""
    return np.mod(np.where(np.abs(theta) <= gamma(16), 0.0, theta), FULL_TURN)


def _turns(coefficients, corner: float):
    """Return the radii inside (0, corner) where theta turns back, from the axis out; 0 if theta is constant."""
    slope = np.polynomial.Polynomial(coefficients).deriv()
    if not slope.coef.any():
        return np.zeros(1)
    roots = positive_roots(slope)
    edges = np.concatenate(([0.0], roots[roots < corner], [corner]))
    with np.errstate(over="ignore", invalid="ignore"):  # NaN counts as a turn
        signs = np.sign(slope((edges[1:] + edges[:-1]) / 2))
    return edges[1:-1][signs[1:] != signs[:-1]]


def _is_seen_beyond(coefficients, turns, corner: float, half_fov: float) -> bool:
    """Return whether theta comes within the field of view beyond its first turning point."""
    with np.errstate(over="ignore", invalid="ignore"):
        theta = np.polynomial.Polynomial(coefficients)(np.append(turns, corner))
    return bool((np.abs(theta) <= half_fov).any() or (np.sign(theta[1:]) != np.sign(theta[:-1])).any())
