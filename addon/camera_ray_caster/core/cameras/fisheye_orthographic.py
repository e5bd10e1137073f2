"""The orthographic fisheye: the half sphere before the eye, as if seen from far away.

Assumption: the picture is round and touches the nearer sides of the frame.
Formula: sin(theta) = r sin(fov / 2) with r = 1 at the rim; no ray beyond. fov is at most 180 degrees.
Singular: 90 degrees from the axis, where the angle's derivative by the radius is infinite.
Reference: Snyder (1987), chapter 20; H. Bettonvil, Fisheye Lenses (2005).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import asin, pi

import numpy as np

from ..maths.recording import sin
from ..records import BlenderCamera, Raster
from .model import Step
from .parts.film import SHIFT, Window
from .parts.radial import FOV, RADIUS, RAY, ROUND_PLANE, Radial


@dataclass(frozen=True)
class FisheyeOrthographic(Radial):
    """A fisheye whose window gives sin(theta); the rim is sin(fov / 2)."""

    key = "FISHEYE_ORTHOGRAPHIC"
    label = "Fisheye Orthographic"
    description = "The half sphere ahead, as seen from far away"
    number = 2
    SETTINGS = (FOV, *SHIFT)
    FORMULA = (ROUND_PLANE, RADIUS, Step("Angle from the axis", "theta = asin(rho sin(fov / 2))"), RAY)

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> FisheyeOrthographic:
        rim = sin(min(FOV.read(raw, high=pi), pi) / 2)
        return cls(raster.size, Window.inscribed_circle(raw, raster, rim), rim)

    def factors(self, r_squared):
        return 1.0 + 0 * r_squared, np.sqrt(1 - r_squared)

    def radius(self, theta):
        return np.sin(theta)

    @property
    def widest(self) -> float:
        return asin(self.rim)
