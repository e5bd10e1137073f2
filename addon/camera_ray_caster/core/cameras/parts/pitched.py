"""A lens that does not look where the camera looks, but up or down from there: projectors of domes, little planets."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin

import numpy as np

from ...maths.vector import components
from .radial import Radial


@dataclass(frozen=True)
class Pitched(Radial):
    """Turns another Radial, the next class of its heirs, about the camera's X axis."""

    elevation: float
    """Of the lens's axis above the viewing direction, radians. At 90 degrees the picture's bottom is the front."""

    def rays(self, x, y):
        """See Radial."""
        origin, direction = super().rays(x, y)
        return origin, self._pitched(direction, self.elevation)

    def write_directions(self, matrix, x, y, out) -> None:
        """See Radial."""
        super().write_directions(matrix @ np.array(self._pitched(np.eye(3), self.elevation)), x, y, out)

    def project(self, points):
        """See Radial."""
        return super().project(self._in_lens(points))

    def bounds(self, centers, radii):
        """See Radial."""
        return super().bounds(self._in_lens(centers), radii)

    def _in_lens(self, points):
        return np.stack(self._pitched(components(np.asarray(points, np.float64)), -self.elevation), axis=-1)

    def _pitched(self, vector, angle):
        x, y, z = vector
        return x, cos(angle) * y - sin(angle) * z, sin(angle) * y + cos(angle) * z
