"""The chief rays of a lens: the real rays through the center of the stop, a family of one parameter.

They begin at the center of the stop, at an angle to the axis in the medium before it, and are traced to the front and
to the film. The ray before the lens does not depend on the film; the film's place gives the radius r at which the ray
meets it. A family of polynomials gives from r what a camera needs: the height h and the place z at which the ray leaves
the front surface, the tangent of half its angle to the axis, and the height e at which it crosses the paraxial exit
pupil. With R the radius at which rays cease to exist, by grazing refraction or since r stops growing, the functions h /
r, z, tan / r and e / r have a root at R, and are smooth functions of t = sqrt(1 - r^2 / R^2).
References: J. Boyd, Chebyshev and Fourier Spectral Methods, 2nd ed. (2001), section 2; W. Smith, Modern Optical
Engineering, 4th ed. (2008), section 9 (pupils).
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from math import inf, pi

import numpy as np
from numpy.polynomial.chebyshev import chebvander

from ..records import InputError
from .optics import BISECTIONS, Optics, bisected
from .trace import trace

DEGREE = 28
"""Of the polynomials: the lenses of the library are then right to 1e-13 radians and 2e-12 mm (with 24 to 2e-12 and
4e-11). With one degree all lenses have one formula, whose coefficients follow the focus and can be exchanged.
"""

ANGLES = 2049
"""Places at which the family is searched for its ends."""

ENDS = 3.0, 2.0, 1.6, 1.3, 1.15, 1.05, 1.01
"""Largest R over the radius at which a rim stops the chief ray, tried in turn: close to grazing refraction the
functions are steep. Beyond R rays of the aperture are bounded, and spread, as if the chief ray were that of R.
"""

WIDEST = 2.0
"""Largest radius over the focal length: without rims rays exist up to kilometers, which no polynomial describes. The
widest lenses that are not fisheyes have 1.8.
"""

GOOD = 1e-12
"""Error in mm and radians up to which the first of ENDS is taken; if none is as good, the best."""

BEFORE_END = 1 - 1e-3
"""Share of the family's last angle up to which rays are used: where r stops growing, it does not tell them apart."""

CHECKS = 257
"""Places at which the polynomials are compared with the trace."""


@dataclass(frozen=True)
class ChiefRays:
    """The polynomials of the family, Chebyshev series in 2 t - 1, in mm."""

    height: tuple[float, ...]
    front: tuple[float, ...]
    tangent: tuple[float, ...]
    pupil: tuple[float, ...]
    end: float
    """R: the radius on the film at which rays cease to exist."""
    rim: float
    """The radius on the film beyond which a rim is in the way of the chief ray."""
    errors: tuple[float, float]
    """Largest difference from the trace: of origins in mm, and of directions in radians."""
    widest: float
    """Angle from the axis of the chief ray at ``rim``."""
    crossing_error: float
    """Largest difference of e from the trace, in mm, up to ``rim``."""

    def at(self, squared):
        """Return h / r, z and tan(theta / 2) / r at r^2; NaN beyond ``end``. It can be recorded."""
        return self._values(squared, self.height, self.front, self.tangent)

    def crossing(self, squared):
        """Return e / r at r^2, as ``at`` does; beyond ``end`` that of ``end``."""
        return self._values(np.minimum(squared, self.end * self.end), self.pupil)[0]

    def crossing_with_slope(self, squared):
        """Return e / r at r^2 and its derivative by r^2; beyond ``end`` those close to it."""
        size = self.end * self.end
        root = np.sqrt(1 - np.minimum(squared, size * (1 - 1e-6)) / size)
        value, slope = clenshaw_with_slope(2 * root - 1, self.pupil)
        return value, -slope / (size * root)

    def _values(self, squared, *series):
        t = 2 * np.sqrt(1 - squared / (self.end * self.end)) - 1
        return tuple(clenshaw(t, coefficients) for coefficients in series)


def clenshaw(t, series):
    """Return the value of a Chebyshev series at t, -1 to 1; its rounding is some EPS of the sum of magnitudes times
    the degree. numpy's ``chebval`` does not record.
    """
    before, now = 0.0, series[-1]
    for coefficient in series[-2:0:-1]:
        before, now = now, coefficient + (t + t) * now - before
    return series[0] + t * now - before


def clenshaw_with_slope(t, series):
    """Return the value of a Chebyshev series and its derivative at t."""
    before, now, slope_before, slope = 0.0, series[-1], 0.0, 0.0
    for coefficient in series[-2:0:-1]:
        slope_before, slope = slope, now + now + (t + t) * slope - slope_before
        before, now = now, coefficient + (t + t) * now - before
    return series[0] + t * now - before, now + t * slope - slope_before


@lru_cache(maxsize=16)
def chief_rays(optics: Optics, film: float) -> ChiefRays:
    """Return the chief rays of a film at z = film. Raises InputError if no ray passes the lens near its axis, and if
    their polynomials have no values.
    """
    family = _family(optics, film)
    radius, _, _, angle_end, rim_angle = family
    last, rim = (float(radius(np.array([angle]))[0]) for angle in (angle_end, min(rim_angle, BEFORE_END * angle_end)))
    rim = min(rim, WIDEST * optics.focal_length)
    tried = []
    for end in dict.fromkeys(min(last, factor * rim) for factor in ENDS):
        tried.append(_polynomials(optics, film, family, end, rim))
        if _worst(tried[-1]) <= GOOD:
            break
    best = min(tried, key=_worst)
    if _worst(best) == inf:
        raise InputError("its chief rays cannot be described: check gaps, rims and the place of the stop")
    return best


def _worst(chief: ChiefRays) -> float:
    """Return the larger of the errors; inf if one is undefined."""
    return max(chief.errors) if np.isfinite(chief.errors).all() else inf


def _polynomials(optics: Optics, film: float, family, end: float, rim: float) -> ChiefRays:
    """Return the polynomials on the radii from 0 to ``end``, with their errors up to ``rim``."""
    radius, front, rear, angle_end, _ = family
    nodes = np.cos((np.arange(DEGREE + 1) + 0.5) * pi / (DEGREE + 1))
    t = (nodes + 1) / 2
    functions = _functions(optics, film, _angles(radius, end * np.sqrt((1 - t) * (1 + t)), angle_end), front, rear)
    weights = 2 / (DEGREE + 1) * chebvander(nodes, DEGREE)
    weights[:, 0] /= 2
    height, front_z, tangent, pupil = (tuple((weights.T @ values).tolist()) for values in functions)
    chief = ChiefRays(height, front_z, tangent, pupil, end, rim, (0.0, 0.0), 0.0, 0.0)
    # up to the rim: beyond it nothing is asked but where the pupil is
    radii = np.linspace(rim / CHECKS, rim, CHECKS)
    h, z, half, e = _functions(optics, film, _angles(radius, radii, angle_end), front, rear)
    near_h, near_z, near_half = chief.at(radii * radii)
    origin = np.hypot((near_h - h) * radii, near_z - z).max()
    turned = 2 * np.abs(np.arctan(near_half * radii) - np.arctan(half * radii)).max()
    crossing = float(np.abs((chief.crossing(radii * radii) - e) * radii).max())
    errors, widest = (float(origin), float(turned)), float(2 * np.arctan(half[-1] * rim))
    return replace(chief, errors=errors, widest=widest, crossing_error=crossing)


def _family(optics: Optics, film: float):
    """Return the functions of the stop's angle: r on the film, front and rear rays; the angle at which the family ends,
    and the one at which a rim is in the way.
    """
    before, start = optics.surfaces[: optics.stop][::-1], optics.surfaces[optics.stop].z

    def from_stop(surfaces, side, angle, clip):
        zero = np.zeros_like(angle)
        direction = zero, -side * np.sin(angle), side * np.cos(angle)
        with np.errstate(all="ignore"):
            return trace(surfaces, (zero, zero, start + zero), direction, side > 0, clip)

    def front(angle, clip=False):
        return from_stop(before, -1, angle, clip)

    def rear(angle, clip=False):
        return from_stop(optics.surfaces[optics.stop :], 1, angle, clip)

    def radius(angle):
        (_, y, z), (_, dy, dz) = rear(angle)
        with np.errstate(all="ignore"):
            return -(y + (film - z) * dy / dz)

    def exists(angle, clip=False):
        finite = np.isfinite(radius(angle)) & np.isfinite(front(angle)[1][1])
        if clip:
            finite &= np.isfinite(rear(angle, True)[1][0]) & np.isfinite(front(angle, True)[1][0])
        return finite

    angles = np.linspace(0.0, pi / 2, ANGLES)[:-1]
    if not exists(angles[:2], clip=True).all():
        raise InputError("no ray through the center of the stop passes the lens: check its rims and indices")
    radii = radius(angles)
    last = int(np.argmin(np.append(exists(angles)[1:] & (np.diff(radii) > 0), False)))
    low, high = (float(angles[min(max(k, 0), len(angles) - 1)]) for k in (last - 1, last + 1))
    end = _growing(radius, low, bisected(exists, low, high))  # rays cease to exist at the second, at the latest
    passing = exists(angles, clip=True) & (angles <= end)
    first_lost = int(np.argmin(np.append(passing, False)))
    rim = bisected(lambda angle: exists(angle, clip=True) & (angle <= end), angles[first_lost - 1],
                    angles[first_lost] if first_lost < len(angles) else end)  # fmt: skip
    return radius, front, rear, end, min(rim, end)


def _growing(radius, low: float, high: float) -> float:
    """Return the angle from low to high up to which r grows: the golden section search of its largest value."""
    share = (5**0.5 - 1) / 2
    start, stop = low, high
    for _ in range(BISECTIONS):
        first, second = stop - share * (stop - start), start + share * (stop - start)
        r = radius(np.array([first, second]))
        start, stop = (first, stop) if r[0] < r[1] else (start, second)
    middle = (start + stop) / 2
    return high if radius(np.array([high]))[0] >= radius(np.array([middle]))[0] else middle


def _angles(radius, radii, end: float):
    """Return the angles at the stop of radii on the film, (n,): the secant method in a bracket (Illinois)."""
    knots = np.linspace(0.0, end, ANGLES)
    known = radius(knots)
    knot = np.clip(np.searchsorted(known, radii), 1, ANGLES - 1)
    a, b = knots[knot - 1], knots[knot]
    fa, fb = known[knot - 1] - radii, known[knot] - radii
    for _ in range(BISECTIONS):
        with np.errstate(all="ignore"):
            angle = np.where(fb == fa, b, b - fb * (b - a) / (fb - fa))
        angle = np.clip(angle, np.minimum(a, b), np.maximum(a, b))
        value = radius(angle) - radii
        same = value * fb > 0
        a, fa = np.where(same, a, b), np.where(same, fa / 2, fb)
        b, fb = angle, value
        if not (np.abs(b - a) > np.spacing(end)).any() or not value.any():
            break
    return b


def _functions(optics: Optics, film: float, angle, front, rear):
    """Return h / r, z, tan(theta / 2) / r and e / r at angles of the stop other than 0."""
    (_, y, z), (_, dy, dz) = rear(angle)
    r = -(y + (film - z) * dy / dz)
    crossing = -(y + (optics.exit_pupil[0] - z) * dy / dz)
    (_, h, front_z), (_, up, ahead) = front(angle)
    return h / r, front_z, up / (1 - ahead) / r, crossing / r
