"""A lens whose axis is turned up or down from the viewing direction: for projectors of domes and little planets."""

from dataclasses import dataclass
from math import pi

import numpy as np

from ...maths.recording import cos, sin
from ...maths.vector import components
from ..model import Step
from .radial import RAY, Radial
from .settings import Number

TILT = Number("tilt", "Dome Tilt", "Angle by which the dome is tilted towards the front", 0.0, 0.0, pi / 2, "angle", 4)

LENS_RAY = Step("Direction in the frame of the lens, with the same azimuth", RAY.symbols.replace("r = ", "d = ", 1))
PITCH = Step(
    "Turned up by the elevation e about the camera's X", "r = (d_x, d_y cos(e) - d_z sin(e), d_y sin(e) + d_z cos(e))"
)


@dataclass(frozen=True)
class Pitched(Radial):
    """A mixin that turns a Radial, the base class listed after this one, about the camera's X axis."""

    elevation: float
    """Angle of the lens's axis above the viewing direction, radians. At 90 degrees the front is at the bottom."""

    def rays(self, x, y):
        origin, direction = super().rays(x, y)
        return origin, self._pitched(direction, self.elevation)

    def project(self, points):
        return super().project(self._in_lens(points))

    def bounds(self, centers, radii):
        return super().bounds(self._in_lens(centers), radii)

    def _in_lens(self, points):
        return np.stack(self._pitched(components(np.asarray(points, np.float64)), -self.elevation), axis=-1)

    def _pitched(self, vector, angle):
        x, y, z = vector
        return x, cos(angle) * y - sin(angle) * z, sin(angle) * y + cos(angle) * z
