"""The equidistant fisheye: Blender's FISHEYE_EQUIDISTANT.

Assumption: the angle from the axis grows evenly with the radius, on an ellipse that touches all four sides of the frame
(sensor, pixel aspect and the frame's shape are ignored, so that a frame that is not square squeezes the picture).
Formula: theta = r fov / 2 with r = 1 at the rim; no ray beyond. A fov above 360 degrees goes around more than once.
Singular: the point straight behind the eye, which appears as a whole circle in the picture.
Reference: Blender manual, Cameras > Panoramic; rays read out of Cycles.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..records import BlenderCamera, Raster
from .model import IN_CASTS, Step
from .parts.film import SHIFT, Window
from .parts.radial import FISHEYE_FOV, RADIUS, RAY, WHOLE_PLANE, Radial, factors_of, radii_of
from .parts.settings import Setting


@dataclass(frozen=True)
class FisheyeEquidistant(Radial):
    """A fisheye with theta = half_fov r, r up to 1."""

    half_fov: float
    """Half the field of view, radians."""

    key = "FISHEYE_EQUIDISTANT"
    label = "Fisheye Equidistant"
    description = "The angle from the axis is proportional to the radius"
    group = "Blender's Own"
    polynomials = IN_CASTS
    SETTINGS: ClassVar[tuple[Setting, ...]] = (FISHEYE_FOV, *SHIFT)
    FORMULA: ClassVar[tuple[Step, ...]] = (WHOLE_PLANE, RADIUS, Step("Angle from the axis", "theta = rho fov / 2"), RAY)

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> FisheyeEquidistant:
        fov = FISHEYE_FOV.read(raw)
        return cls(raster.size, Window.over_frame(raw, raster, (-1.0, 1.0), (-1.0, 1.0)), 1.0, fov / 2)

    def factors(self, r_squared):
        r = radii_of(r_squared)
        theta = r * self.half_fov
        return factors_of(theta, r)

    def radius(self, theta):
        return theta / self.half_fov

    @property
    def widest(self) -> float:
        return self.half_fov
