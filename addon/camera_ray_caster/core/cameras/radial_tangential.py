"""OpenCV's distortion of a pinhole's picture: radial, rational, tangential and thin prism; and its inverse.

With r^2 = x^2 + y^2 and g = (1 + k1 r^2 + k2 r^4 + k3 r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6):
    x' = x g + 2 p1 x y + p2 (r^2 + 2 x^2) + s1 r^2 + s2 r^4
    y' = y g + p1 (r^2 + 2 y^2) + 2 p2 x y + s3 r^2 + s4 r^4
Where the symmetric part of the Jacobian is positive definite on a disc, the map is strictly monotone and therefore
one-to-one there (G. Minty, 1962). Its least eigenvalue is at least
    min(g, d(r g)/dr) - 6 |p| r - 2 r (|(s1, s3)| + 2 r^2 |(s2, s4)|),
equal to it without prism where d(r g)/dr < g, so that its first zero is the radius up to which the model means
something. Beyond, pictures fold, and there are neither rays nor projections here.
Reference: OpenCV documentation, Camera Calibration and 3D Reconstruction; D. C. Brown (1966); C. Ricolfe-Viala and
A. Sanchez-Salmeron (2010), thin prism.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, inf

import numpy as np

from ..conventions import EPS
from .inversion import invert

STEPS = 60


@dataclass(frozen=True)
class RadialTangential:
    """The coefficients by their OpenCV names."""

    k1: float = 0.0
    k2: float = 0.0
    p1: float = 0.0
    p2: float = 0.0
    k3: float = 0.0
    k4: float = 0.0
    k5: float = 0.0
    k6: float = 0.0
    s1: float = 0.0
    s2: float = 0.0
    s3: float = 0.0
    s4: float = 0.0

    def gain(self, r_squared):
        """Return g and its derivative by r^2."""
        s = r_squared
        above = 1 + s * (self.k1 + s * (self.k2 + s * self.k3))
        below = 1 + s * (self.k4 + s * (self.k5 + s * self.k6))
        above_slope = self.k1 + s * (2 * self.k2 + 3 * s * self.k3)
        below_slope = self.k4 + s * (2 * self.k5 + 3 * s * self.k6)
        gain = above / below
        return gain, (above_slope - gain * below_slope) / below

    def distort(self, x, y):
        """Return (x', y') of undistorted coordinates."""
        s = x * x + y * y
        g, _ = self.gain(s)
        return (
            x * g + 2 * self.p1 * x * y + self.p2 * (s + 2 * x * x) + s * (self.s1 + s * self.s2),
            y * g + self.p1 * (s + 2 * y * y) + 2 * self.p2 * x * y + s * (self.s3 + s * self.s4),
        )

    def jacobian(self, x, y):
        """Return the derivatives (x' by x, x' by y, y' by x, y' by y)."""
        s = x * x + y * y
        g, slope = self.gain(s)
        cross = 2 * (x * y * slope + self.p1 * x + self.p2 * y)
        prism_x, prism_y = 2 * (self.s1 + 2 * s * self.s2), 2 * (self.s3 + 2 * s * self.s4)
        return (
            g + 2 * x * x * slope + 2 * self.p1 * y + 6 * self.p2 * x + x * prism_x,
            cross + y * prism_x,
            cross + x * prism_y,
            g + 2 * y * y * slope + 6 * self.p1 * y + 2 * self.p2 * x + y * prism_y,
        )

    def off_radius(self, r):
        """Return a bound on how far a point at this radius is moved otherwise than along it."""
        s = r * r
        return s * (3 * hypot(self.p1, self.p2) + hypot(self.s1, self.s3) + s * hypot(self.s2, self.s4))

    def limit(self) -> float:
        """Return the undistorted radius up to which the map is one-to-one, inf without one.

        It is the least root of the denominator and of the two conditions above, brought to polynomials in r; taken
        1e-9 of itself short, more than the roots' rounding.
        """
        r = np.polynomial.Polynomial([0.0, 1.0])
        above = np.polynomial.Polynomial([1, 0, self.k1, 0, self.k2, 0, self.k3])
        below = np.polynomial.Polynomial([1, 0, self.k4, 0, self.k5, 0, self.k6])
        slope = (above.deriv() * below - above * below.deriv()) * r
        bend = r * (6 * hypot(self.p1, self.p2) + 2 * hypot(self.s1, self.s3)) + 4 * r**3 * hypot(self.s2, self.s4)
        least = inf
        for polynomial in (below, above * below - bend * below**2, above * below + slope - bend * below**2):
            roots = polynomial.roots()
            real = roots.real[(np.abs(roots.imag) <= 1e-9 * np.abs(roots)) & (roots.real > 0)]
            least = min(least, *real.tolist(), inf)
        return least * (1 - 1e-9)

    def undistort(self, u, v, limit: float):
        """Return (x, y) within the limit with distort(x, y) = (u, v); NaN where there is none.

        The radius alone gives the first guess, Newton's method in one variable; with tangential or prism terms
        Newton's in two goes on, a step halved until it comes nearer. Right to some EPS of the distorted radius,
        times the inverse of the Jacobian.
        """
        u, v = np.broadcast_arrays(u, v)
        rho = np.hypot(u, v)
        r = self._radius(rho, limit)
        scale = np.where(rho > 0, r / np.where(rho > 0, rho, 1.0), 1.0)
        x, y = u * scale, v * scale
        if any((self.p1, self.p2, self.s1, self.s2, self.s3, self.s4)):
            x, y = self._newton(u, v, np.nan_to_num(x, nan=0.0), np.nan_to_num(y, nan=0.0), limit)
        return x, y

    def _radius(self, rho, limit: float):
        """Return r with r g(r^2) = rho, up to the limit; NaN beyond."""
        high, farthest = limit, np.max(rho, initial=0.0, where=~np.isnan(rho))
        if high == inf:
            high = max(farthest, 1.0)
            while high * self.gain(high * high)[0] < farthest and high < 1e12:
                high *= 2
        return invert(lambda r: r * self.gain(r * r)[0], self._radial_slope, rho, 0.0, high)

    def _radial_slope(self, r):
        g, slope = self.gain(r * r)
        return g + 2 * r * r * slope

    def _newton(self, u, v, x, y, limit: float):
        goal = 8 * EPS * (np.hypot(u, v) + self.off_radius(np.hypot(x, y)))
        off_x, off_y = self._off(x, y, u, v)
        share = np.ones_like(x)
        for _ in range(STEPS):
            error = np.hypot(off_x, off_y)
            if not (error > goal).any():
                break
            xx, xy, yx, yy = self.jacobian(x, y)
            determinant = xx * yy - xy * yx
            with np.errstate(divide="ignore", invalid="ignore"):
                step_x, step_y = (yy * off_x - xy * off_y) / determinant, (xx * off_y - yx * off_x) / determinant
            next_x, next_y = x - share * step_x, y - share * step_y
            inside = np.minimum(1.0, limit / np.maximum(np.hypot(next_x, next_y), 1e-300))
            next_x, next_y = next_x * inside, next_y * inside
            next_off = self._off(next_x, next_y, u, v)
            better = np.hypot(*next_off) < error
            share = np.where(better, 1.0, share / 2)
            x, y = np.where(better, next_x, x), np.where(better, next_y, y)
            off_x, off_y = np.where(better, next_off[0], off_x), np.where(better, next_off[1], off_y)
        found = np.hypot(off_x, off_y) <= 4 * goal
        return np.where(found, x, np.nan), np.where(found, y, np.nan)

    def _off(self, x, y, u, v):
        there = self.distort(x, y)
        return there[0] - u, there[1] - v
