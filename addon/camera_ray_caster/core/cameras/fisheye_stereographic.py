"""The stereographic fisheye: angles between lines are kept, and circles on the sphere stay circles.

Assumption: the picture is round and touches the nearer sides of the frame.
Formula: tan(theta / 2) = r tan(fov / 4) with r = 1 at the rim; no ray beyond. fov is below 360 degrees. No angle is
computed: with w = tan(theta / 2), sin(theta) / w = 2 / (1 + w^2) and cos(theta) = (1 - w^2) / (1 + w^2).
Singular: the point straight behind the eye, whose image is infinitely far out.
Reference: Snyder (1987), chapter 21.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan, radians
from typing import ClassVar

import numpy as np

from ..maths.recording import tan
from ..records import BlenderCamera, Raster
from .model import Step
from .parts.film import SHIFT, Window
from .parts.radial import FOV, RADIUS, RAY, ROUND_PLANE, Radial
from .parts.settings import Setting

WIDEST = radians(359)


@dataclass(frozen=True)
class FisheyeStereographic(Radial):
    """A fisheye whose window gives tan(theta / 2); the rim is tan(fov / 4), or inf if there is no rim."""

    key = "FISHEYE_STEREOGRAPHIC"
    label = "Fisheye Stereographic"
    description = "Keeps angles: circles stay circles"
    number = 3
    SETTINGS: ClassVar[tuple[Setting, ...]] = (FOV, *SHIFT)
    FORMULA: ClassVar[tuple[Step, ...]] = (
        ROUND_PLANE,
        RADIUS,
        Step("Angle from the axis", "theta = 2 atan(rho tan(fov / 4))"),
        RAY,
    )

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> FisheyeStereographic:
        rim = tan(FOV.read(raw, high=WIDEST) / 4)
        return cls(raster.size, Window.inscribed_circle(raw, raster, rim), rim)

    def factors(self, r_squared):
        scale = 1 / (1 + r_squared)
        return 2 * scale, (1 - r_squared) * scale

    def radius(self, theta):
        return np.tan(theta / 2)

    @property
    def widest(self) -> float:
        return 2 * atan(self.rim)
