"""The inverse of a lens's chief rays: the radius on the film whose ray meets a point.

Chief rays lie in planes through the axis, and are a family of one number, the radius. Where a point lies beside a ray
is a smooth function of it; the secant method finds its root from a table of the rays' angles. Where it does not settle,
for points that are very near, the root is bracketed and bisected.
"""

from dataclasses import dataclass

import numpy as np

from ...lenses.chief import ChiefRays
from ...maths.speed import lazy

KNOTS = 4097
"""Angles of the table from which the inverse begins."""
SECANTS, BISECTIONS = 8, 60
"""Steps of the inverse: from the table, and in a bracket where these do not settle."""
SETTLED = 1e-14
"""Change of the radius over the largest radius below which the inverse has settled."""


@dataclass(frozen=True, eq=False)
class ChiefSearch:
    """The rays up to a radius; all lengths are mm of the lens, z in the lens frame."""

    chief: ChiefRays
    pupil: float
    """z of the entrance pupil."""
    rim: float
    """The largest radius."""

    def beside(self, r, rho, z):
        """Return how far points, rho from the axis at z, lie beside the chief ray of the radius r, and before it."""
        height, front, tangent = self.chief.at(r * r)
        turn = 2 / (1 + tangent * tangent * r * r)
        sine, cosine = tangent * r * turn, turn - 1
        out, ahead = rho - height * r, front - z
        return out * cosine - ahead * sine, out * sine + ahead * cosine

    @lazy
    def table(self):
        """Radii to the rim in even steps, with the angles of their rays, and their origins' heights and places."""
        return self.up_to(self.rim)

    def up_to(self, end: float):
        """Return radii to an end in even steps, the angles of their rays, and their origins' heights and places."""
        r = np.linspace(0.0, end, KNOTS)
        height, fronts, tangent = self.chief.at(np.minimum(r * r, end * end))
        return r, 2 * np.arctan(tangent * r), height * r, fronts

    def radius_of(self, rho, z):
        radii, angles, heights, places = self.table
        rim = radii[-1]

        def seen(height, front):
            return np.interp(np.arctan2(rho - height, front - z), angles, radii)

        before = seen(0.0, self.pupil)
        r = seen(np.interp(before, radii, heights), np.interp(before, radii, places))
        off_before, off = self.beside(before, rho, z)[0], self.beside(r, rho, z)[0]
        for _ in range(SECANTS):
            step = np.where(off == off_before, 0.0, off * (r - before) / (off - off_before))
            before, off_before = r, off
            r = np.clip(r - step, 0.0, rim)
            off = self.beside(r, rho, z)[0]
            if not (np.abs(r - before) > SETTLED * rim).any():
                break
        lost = ~(np.abs(r - before) <= 16 * SETTLED * rim) | ~(np.abs(off) <= 1e-9 * (rho + np.abs(z) + rim))
        if lost.any():
            r[lost] = self._bracketed(rho[lost], z[lost])
        ahead = self.beside(r, rho, z)[1] > 0
        return np.where(ahead, r, np.nan)

    def _bracketed(self, rho, z):
        """Return the least radii whose rays meet points, NaN where there are none, by brackets and bisection."""
        radii, _, _, _ = (column[::16] for column in self.table)
        off, ahead = self.beside(radii, rho[:, None], z[:, None])
        change = (off[:, :-1] * off[:, 1:] <= 0) & ((ahead[:, :-1] > 0) | (ahead[:, 1:] > 0))
        crossing, rows = np.argmax(change, axis=1), np.arange(len(rho))
        low, high = radii[crossing], radii[crossing + 1]
        below = off[rows, crossing]
        for _ in range(BISECTIONS):
            middle = (low + high) / 2
            same = self.beside(middle, rho, z)[0] * below > 0
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        return np.where(change.any(axis=1), (low + high) / 2, np.nan)
