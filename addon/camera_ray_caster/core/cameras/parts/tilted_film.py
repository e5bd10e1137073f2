"""The film of a real lens, tilted to its axis (Scheimpflug): where its points are, and which chief rays meet them.

The film turns about the point where the axis meets it, by the rotation R of ``parts.tilt``. The picture is upright here
(y up), Z is the distance behind the upright film. A point (u, v) of the film lies at P = (X, Y, Z) = u t1 + v t2, with
t1 and t2 the first two rows of R, and the film's points have n . P = 0, with n the third. With c the height at which a
chief ray crosses the exit pupil, over its height r on the upright film, and D the distance between these planes, the
ray through (a, b) of the upright film is (a, b) (1 + m Z) at Z, m = (1 - c) / D. So P is met by the ray of
    (a, b) = k (X, Y), k (1 + m(k^2 (X^2 + Y^2)) Z) = 1,
found by Newton's method, and (a, b) has its ray's point P = (a n3, b n3, -w) / (n3 + m w) on the film, w = a n1 + b n2.
"""

from dataclasses import dataclass, replace
from itertools import product
from math import degrees
from typing import Any

import numpy as np

from ...conventions import gamma
from ...lenses.chief import ChiefRays
from ...maths.recording import is_recorded
from ...maths.vector import dot
from ...records import BlenderCamera
from .calibration import TAU_X, TAU_Y
from .film import Window
from .tilt import Tilt, intervals_around

NEWTON_STEPS = 4
"""Of Newton's method: for the lenses of the library, tilted by 40 degrees, 3 leave 3e-9 of k, 4 its rounding."""
LEAST_GROWTH = 0.05
"""Smallest growth of a point's distance from the axis with its chief ray's r, over that of the axis."""
BULGE = 1.02
"""What the frame's corners may be nearer to the axis than what is between them, on the upright film."""
CHECKS, HALVINGS = 257, 30


@dataclass(frozen=True)
class TiltedFilm:
    """A tilt, and the distance from the paraxial exit pupil to the film's point on the axis; lengths are mm."""

    tilt: Tilt
    away: float

    def __bool__(self) -> bool:
        """Whether the film is tilted at all."""
        return bool(self.tilt)

    @property
    def rows(self) -> list[list[float]]:
        """t1, t2 and n, with y up."""
        first, second, third = self.tilt.rotation.tolist()
        return [
            [first[0], -first[1], first[2]], [-second[0], second[1], -second[2]], [third[0], -third[1], third[2]],
        ]  # fmt: skip

    def places(self, u, v, film: float = 0.0):
        """Return X, Y and Z, which counts from ``film``, of points of the film."""
        if not self:
            return u, v, film
        first, second, _ = self.rows
        x, y, z = (u * across + v * up for across, up in zip(first, second, strict=True))
        return x, y, film + z

    def upright(self, chief: ChiefRays, u, v):
        """Return the points (a, b) of the upright film that have the chief rays of points of this one."""
        if not self:
            return u, v
        x, y, z = self.places(u, v)
        k = self._factor(chief, x * x + y * y, z / self.away)
        return k * x, k * y

    def _factor(self, chief: ChiefRays, squared, share):
        """Return k of points of the film, of X^2 + Y^2 and Z / D. It can be recorded."""
        k = 1 / (1 + share)
        for _ in range(NEWTON_STEPS):
            crossing, slope = chief.crossing_with_slope(k * k * squared)
            scale = 1 + share * (1 - crossing)
            k = k - (k * scale - 1) / (scale - 2 * share * k * k * squared * slope)
        return k

    def onto(self, chief: ChiefRays, a, b) -> tuple[Any, Any]:
        """Return u and v of the points in which the chief rays of the upright film meet the tilted one; NaN where they
        do not.
        """
        return self._met(a, b, (1 - chief.crossing(a * a + b * b)) / self.away) if self else (a, b)

    def _met(self, a, b, slope):
        first, second, normal = self.rows
        beside = a * normal[0] + b * normal[1]
        below = normal[2] + slope * beside
        below = np.where(below > 0, below, np.nan)
        point = [coordinate / below for coordinate in (a * normal[2], b * normal[2], -beside)]
        return dot(first, point), dot(second, point)

    def intervals(self, chief: ChiefRays, radii, interval_x, interval_y):
        """Return the intervals in u and v that hold the images of all points of the upright film's intervals, (n,)
        each, at ``radii`` of the upright film.

        For each m the map is projective, which takes a box to the hull of its corners' images; each of these lies
        between those of the least and of the largest m. They are endless if a corner has no image. NaN stays NaN.
        """
        if not self:
            return interval_x, interval_y
        slopes = (1 - chief.crossing(radii * radii)) / self.away
        ends = slopes.min() - 1e-9 * abs(slopes.min()), slopes.max() + 1e-9 * abs(slopes.max())
        with np.errstate(invalid="ignore"):
            met = np.array([self._met(a, b, m) for a, b, m in product(interval_x, interval_y, ends)])
        return intervals_around(met, interval_x, interval_y)

    def farthest(self, chief: ChiefRays, corners) -> float:
        """Return the largest radius on the upright film of a frame with these corners, (4, 2)."""
        return float(np.hypot(*self.upright(chief, *np.transpose(corners))).max() * (BULGE if self else 1.0))

    def values(self, chief: ChiefRays, u: float, v: float) -> dict[str, Any]:
        """Return the values of the formula's names at a point of the film."""
        if not self:
            return {}
        first, second, _ = map(np.array, self.rows)
        x, y, z = self.places(u, v)
        return {"t_1": first, "t_2": second, "k": self._factor(chief, x * x + y * y, z / self.away)}

    def check(self, raw: BlenderCamera, chief: ChiefRays, behind: float, window: Window, frame) -> None:
        """Raise InputError, with the largest tilt, for a film that reaches the lens, whose last vertex is at ``behind``
        before the film, or whose points are not met by one chief ray each. A recorded window is not checked.
        """
        if not self or is_recorded(*vars(window).values()):
            return
        corners = window.corners(frame)
        plain = TiltedFilm(Tilt(float(self.tilt.tau_x), float(self.tilt.tau_y)), float(self.away))
        if not plain or plain._holds(chief, behind, corners):
            return
        low, high = 0.0, 1.0
        for _ in range(HALVINGS):
            share = (low + high) / 2
            film = replace(plain, tilt=Tilt(share * plain.tilt.tau_x, share * plain.tilt.tau_y))
            low, high = (share, high) if film._holds(chief, behind, corners) else (low, share)
        tilt, setting = max((abs(plain.tilt.tau_x), TAU_X), (abs(plain.tilt.tau_y), TAU_Y), key=lambda each: each[0])
        limit = f"at most {degrees(low * tilt):.4g} degrees: a film that is tilted more reaches the lens"
        raise setting.refusal(raw, f"{degrees(tilt):.4g} degrees", limit)

    def _holds(self, chief: ChiefRays, behind: float, corners) -> bool:
        z = self.places(*np.transpose(corners))[2]
        if not (z.min() > -behind and (1 + z / self.away).min() > LEAST_GROWTH):
            return False
        return self._growth(chief, corners) > LEAST_GROWTH

    def _growth(self, chief: ChiefRays, corners) -> float:
        """Return the least growth of the distance from the axis, where a ray meets the film, with r; 0 if undefined."""
        farthest = self.farthest(chief, corners)
        if not np.isfinite(farthest):
            return 0.0
        r = np.linspace(0.0, min(farthest, chief.rim), CHECKS)
        crossing, slope = chief.crossing_with_slope(r * r)
        z = self.places(*np.transpose(corners))[2]
        return float((1 + np.multiply.outer((z.min(), z.max()), (1 - crossing - 2 * r * r * slope) / self.away)).min())

    def rounding(self, chief: ChiefRays, corners) -> float:
        """Return the error of r: of the polynomial of c and its sum, and of Newton's last step."""
        share = np.abs(self.places(*np.transpose(corners))[2] / self.away).max()
        steps = np.array([1, *range(3, len(chief.pupil) + 2)])
        sums = gamma(4) * float((np.abs(chief.pupil) * steps).sum()) * chief.rim
        return float(share * (chief.crossing_error + sums) + gamma(8) * chief.rim) / self._growth(chief, corners)


UPRIGHT_FILM = TiltedFilm(Tilt(0.0, 0.0), 1.0)
