"""The equisolid fisheye: Blender's FISHEYE_EQUISOLID, the usual photographic lens.

Assumption: equal areas of the sensor see equal solid angles; the sensor is fitted to the frame as for a pinhole.
Formula: r = 2 f sin(theta / 2), r and f in millimeters; no ray beyond r = 2 f sin(fov / 4). As in Cycles, that limit
also holds for a fov above 360 degrees, where it shrinks again, to nothing at 720 degrees.
No angle is computed: with s = r / 2f, sin(theta) / r = sqrt(1 - s^2) / f and cos(theta) = 1 - 2 s^2.
Singular: r = 2 f, the point straight behind the eye.
Reference: Blender manual, Cameras > Panoramic; rays read out of Cycles.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import asin
from typing import ClassVar

import numpy as np

from ..maths.recording import sin
from ..records import BlenderCamera, Raster
from .model import Step
from .parts.film import FILM, Film, Window
from .parts.radial import FISHEYE_FOV, FISHEYE_LENS, RADIUS, RAY, SENSOR_PLANE, Radial
from .parts.settings import Setting


@dataclass(frozen=True)
class FisheyeEquisolid(Radial):
    """A fisheye with s = r / 2f = sin(theta / 2); the window gives s."""

    key = "FISHEYE_EQUISOLID"
    label = "Fisheye Equisolid"
    description = "Equal areas of the sensor see equal solid angles: the usual photographic lens"
    group = "Blender's Own"
    SETTINGS: ClassVar[tuple[Setting, ...]] = (FISHEYE_LENS, FISHEYE_FOV, *FILM)
    FORMULA: ClassVar[tuple[Step, ...]] = (
        SENSOR_PLANE,
        RADIUS,
        Step("Angle from the axis", "theta = 2 asin(rho / (2 lens))"),
        RAY,
    )

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> FisheyeEquisolid:
        film = Film.from_blender(raw, raster)
        diameter = 2 * FISHEYE_LENS.read(raw)
        fov = FISHEYE_FOV.read(raw)
        window = Window.round_pixels(raw, raster, film.size / film.fitted_pixels / diameter)
        return cls(raster.size, window, max(sin(fov / 4), 0.0))

    def factors(self, r_squared):
        return 2 * np.sqrt(1 - r_squared), 1 - 2 * r_squared

    def radius(self, theta):
        return np.sin(theta / 2)

    @property
    def widest(self) -> float:
        return 2 * asin(self.rim)
