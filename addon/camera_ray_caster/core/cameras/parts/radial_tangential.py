"""OpenCV's distortion of a pinhole's picture: radial, rational, tangential and thin prism; and its inverse.

With r^2 = x^2 + y^2 and g = (1 + k1 r^2 + k2 r^4 + k3 r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6):
    x' = x g + 2 p1 x y + p2 (r^2 + 2 x^2) + s1 r^2 + s2 r^4
    y' = y g + p1 (r^2 + 2 y^2) + 2 p2 x y + s3 r^2 + s4 r^4
If the symmetric part of the Jacobian is positive definite on a disc, the map is strictly monotone and therefore
one-to-one there (G. Minty, 1962). The least eigenvalue of that part is at least
    min(g, d(r g)/dr) - 6 |p| r - 2 r (|(s1, s3)| + 2 r^2 |(s2, s4)|),
with equality if there is no prism and d(r g)/dr < g. The model is valid up to the radius at which this bound has its
first zero. Beyond it pictures fold, and there are neither rays nor projections here.
Reference: OpenCV documentation, Camera Calibration and 3D Reconstruction; D. C. Brown (1966); C. Ricolfe-Viala and
A. Sanchez-Salmeron (2010), thin prism.
"""

from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import cached_property
from math import atan, inf, radians, tan

import numpy as np

from ...maths.inversion import Inverse
from ...maths.polynomials import horner, with_slope
from ...maths.recording import is_recorded, least_root, loop, roundoff, stop_gradient
from ...maths.recording.scalars import hypot, least
from .edge import Edge
from .silhouette import Sectors

STEEPEST = tan(radians(89.9))
"""Largest undistorted radius of a picture without an end."""

FAST_STEPS = 5
"""Maximum number of Newton's steps from the radial guess, whose error is about a hundredth; each squares the error."""

LAST_STEP = 1e-8
"""Fraction of the guessed radius: after a step shorter than this, the remaining error is below rounding."""

NEWTON_STEPS = 200


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
    r8: float = 0.0
    """Coefficient of r^8 in the numerator, which OpenCV does not have."""

    @property
    def bends(self) -> bool:
        """Whether there is any distortion."""
        return any(getattr(self, coefficient.name) for coefficient in fields(self))

    def gain(self, r_squared):
        """Return g and its derivative by r^2."""
        above, above_slope = with_slope(r_squared, (1.0, self.k1, self.k2, self.k3, self.r8))
        if not (self.k4 or self.k5 or self.k6):
            return above, above_slope
        below, below_slope = with_slope(r_squared, (1.0, self.k4, self.k5, self.k6))
        gain = above / below
        return gain, (above_slope - gain * below_slope) / below

    def cancelled(self, r_squared):
        """Return the factor by which cancellation multiplies the rounding of g.

        It is the sum of the terms' magnitudes over the magnitude of their sum, added for numerator and denominator.
        """
        s, k = r_squared, self
        terms = ((k.k1, k.k2, k.k3, k.r8), (k.k4, k.k5, k.k6))
        parts = (((1.0, *coefficients), (1.0, *map(abs, coefficients))) for coefficients in terms)
        return sum(horner(s, larger) / np.abs(horner(s, coefficients)) for coefficients, larger in parts)

    def distort(self, x, y):
        """Return the distorted coordinates (x', y') of undistorted ones."""
        s = x * x + y * y
        return self._moved(x, y, s, self._turn(x, y, self.gain(s)[0]))

    def _turn(self, x, y, gain):
        return gain + 2 * (self.p1 * y + self.p2 * x)

    def _moved(self, x, y, s, turn):
        moved_x, moved_y = x * turn + self.p2 * s, y * turn + self.p1 * s
        if self._has_prism:
            moved_x, moved_y = moved_x + s * (self.s1 + s * self.s2), moved_y + s * (self.s3 + s * self.s4)
        return moved_x, moved_y

    @property
    def _has_prism(self) -> bool:
        return any((self.s1, self.s2, self.s3, self.s4))

    def _derivatives(self, x, y, s, turn, slope):
        """Return the derivatives of x' by x, x' by y, y' by x and y' by y."""
        bend_x, bend_y = 2 * (slope * x + self.p2), 2 * (slope * y + self.p1)  # of turn, by x and by y
        xx, yy = turn + x * (bend_x + 2 * self.p2), turn + y * (bend_y + 2 * self.p1)
        xy = x * bend_y + 2 * self.p2 * y  # also of y' by x
        if self._has_prism:
            prism_x, prism_y = 2 * self.s1 + 4 * s * self.s2, 2 * self.s3 + 4 * s * self.s4
            return xx + x * prism_x, xy + y * prism_x, xy + x * prism_y, yy + y * prism_y
        return xx, xy, xy, yy

    def off_radius(self, r):
        """Return a bound on the displacement of a point at this radius by the tangential and prism terms."""
        s = r * r
        return s * (3 * hypot(self.p1, self.p2) + hypot(self.s1, self.s3) + s * hypot(self.s2, self.s4))

    def farthest(self, r):
        """Return a bound on the distorted radius of a point at this radius, within the limit; it grows with r."""
        return r * self.gain(r * r)[0] + self.off_radius(r)

    def intervals(self, centers, radii, radius: Callable, widest: float, reach: float = inf):
        """Return the intervals in x and y that spheres cover in the distorted picture, whose radii are up to ``reach``;
        ``radius`` and ``widest`` are those of ``radial_intervals``, of the undistorted picture.
        """
        sectors = Sectors.of(centers, radii, widest)
        inner, outer = radius(sectors.inner), radius(sectors.outer)
        if not self.bends:
            return sectors.intervals(inner, outer)
        spread = self.off_radius(np.minimum(outer, reach))
        intervals = sectors.intervals(*(r * self.gain(r * r)[0] for r in (inner, outer)))
        return tuple((low - spread, high + spread) for low, high in intervals)

    @cached_property
    def limit(self) -> float:
        """Return the undistorted radius up to which the map is one-to-one, inf if it is so everywhere.

        It is the least root of the denominator and of the two parts of the module's bound, as polynomials in r, less
        1e-9 of itself, which is more than the roots' rounding.
        """
        r = np.polynomial.Polynomial([0.0, 1.0])
        above = np.polynomial.Polynomial([1, 0, self.k1, 0, self.k2, 0, self.k3, 0, self.r8])
        below = np.polynomial.Polynomial([1, 0, self.k4, 0, self.k5, 0, self.k6])
        slope = (above.deriv() * below - above * below.deriv()) * r
        bend = r * (6 * hypot(self.p1, self.p2) + 2 * hypot(self.s1, self.s3)) + 4 * r**3 * hypot(self.s2, self.s4)
        polynomials = below, above * below - bend * below**2, above * below + slope - bend * below**2
        return least(*(least_root(polynomial.coef.tolist()) for polynomial in polynomials)) * (1 - 1e-9)

    @cached_property
    def edge(self) -> Edge:
        """The curve around the distorted picture: the image of the limit's circle, or else a circle around it."""
        if self.limit == inf:
            return Edge.circle(inf)
        second = self.limit * abs(self.gain(self.limit**2)[0]) + 8 * self.limit**2 * hypot(self.p1, self.p2)
        curve = Edge.around(lambda x, y: self.distort(self.limit * x, self.limit * y), second)
        return curve or Edge.circle(self.farthest(self.limit))

    @cached_property
    def _radius(self):
        """Return the inverse of r g(r^2), up to the limit or 89.9 degrees, whichever is less."""
        high = least(self.limit, STEEPEST)
        return Inverse(self._radial, self._radial_slope, 0.0, high, _even_in_angle)

    def _radial(self, r):
        return r * self.gain(r * r)[0]

    def _radial_slope(self, r):
        s = r * r
        g, slope = self.gain(s)
        return g + 2 * s * slope

    def undistort(self, u, v):
        """Return (x, y) within the limit with distort(x, y) = (u, v); NaN where there is no such point.

        Uses Newton's method from the solution for the radial terms alone. The result is right to some EPS of the
        distorted radius, times the inverse of the Jacobian.
        """
        if not self.bends:
            return tuple(np.array(coordinate) for coordinate in np.broadcast_arrays(u, v))
        u, v = np.broadcast_arrays(u, v)
        radial = not any((self.p1, self.p2, self.s1, self.s2, self.s3, self.s4))
        if is_recorded(u, v) and not radial:
            x, y = self._careful(stop_gradient(u), stop_gradient(v))
            step_x, step_y = self._step(x, y, u, v)
            return x - step_x, y - step_y  # their derivatives are the inverse's
        rho = np.hypot(u, v)
        if not (radial or (near := self.edge.may_hold(u, v, rho)).all()):  # Newton's method would take long
            x, y = np.full(rho.shape, np.nan), np.full(rho.shape, np.nan)  # arrays, also for one pixel
            x[near], y[near] = self.undistort(u[near], v[near])
            return x, y
        r = self._radius(rho) if radial else self._radius.guess(rho)
        scale = np.where(rho > 0, r / np.where(rho > 0, rho, 1.0), 1.0)
        x, y = u * scale, v * scale
        if radial:
            return x, y
        with np.errstate(over="ignore", invalid="ignore"):  # diverging points become slow
            for _ in range(FAST_STEPS):
                step_x, step_y = self._step(x, y, u, v)
                x, y = x - step_x, y - step_y
                slow = ~(np.abs(step_x) + np.abs(step_y) <= LAST_STEP * r)
                if not slow.any():
                    break
        slow |= ~(np.hypot(x, y) <= self.limit)
        if slow.any():
            x, y = np.asarray(x), np.asarray(y)
            x[slow], y[slow] = self._careful(u[slow], v[slow])
        return x, y

    def _step(self, x, y, u, v):
        s = x * x + y * y
        gain, slope = self.gain(s)
        turn = self._turn(x, y, gain)
        moved_x, moved_y = self._moved(x, y, s, turn)
        off_x, off_y = moved_x - u, moved_y - v
        xx, xy, yx, yy = self._derivatives(x, y, s, turn, slope)
        with np.errstate(divide="ignore", invalid="ignore"):
            inverse = 1 / (xx * yy - xy * yx)
            return (yy * off_x - xy * off_y) * inverse, (xx * off_y - yx * off_x) * inverse

    def _careful(self, u, v):
        """Invert by Newton's method from the axis; each step is halved until it comes nearer, and kept in the limit."""

        def goal(x, y, u, v):
            radius = np.hypot(x, y)
            return 8 * roundoff(u) * (np.hypot(u, v) * self.cancelled(radius * radius) + self.off_radius(radius))

        def step(x, y, share, off_x, off_y, u, v):
            step_x, step_y = self._step(x, y, u, v)
            next_x, next_y = x - share * step_x, y - share * step_y
            radius = np.hypot(next_x, next_y)
            beyond = radius > self.limit
            inside = np.where(beyond, self.limit / np.where(beyond, radius, 1.0), 1.0)
            next_x, next_y = next_x * inside, next_y * inside
            next_off_x, next_off_y = self._off(next_x, next_y, u, v)
            better = np.hypot(next_off_x, next_off_y) < np.hypot(off_x, off_y)
            share = np.where(better, 1.0, share / 2)
            x, y = np.where(better, next_x, x), np.where(better, next_y, y)
            off_x, off_y = np.where(better, next_off_x, off_x), np.where(better, next_off_y, off_y)
            is_there = ~(np.hypot(off_x, off_y) > goal(x, y, u, v))
            return (x, y, share, off_x, off_y, u, v), is_there | (share < roundoff(u))

        x, y = np.zeros_like(u), np.zeros_like(v)
        with np.errstate(over="ignore", invalid="ignore"):
            x, y, _, *off, _, _ = loop(step, (x, y, np.ones_like(u), *self._off(x, y, u, v), u, v), NEWTON_STEPS)
            converged = np.hypot(*off) <= 4 * goal(x, y, u, v)
        return np.where(converged, x, np.nan), np.where(converged, y, np.nan)

    def _off(self, x, y, u, v):
        there = self.distort(x, y)
        return there[0] - u, there[1] - v


def _even_in_angle(low: float, high: float, count: int):
    """Return radii (tangents) from low to high that are evenly spaced in angle, with exact ends."""
    radii = np.tan(np.linspace(atan(low), atan(high), count))
    radii[0], radii[-1] = low, high
    return radii
