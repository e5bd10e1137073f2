"""The equisolid fisheye: Blender's FISHEYE_EQUISOLID, the usual photographic lens.

Assumption: equal areas of the sensor see equal solid angles; the sensor is fitted to the frame as a pinhole's is.
Formula: r = 2 f sin(theta / 2), r and f in millimeters; no ray beyond r = 2 f sin(fov / 4), which Cycles keeps for a
fov above 360 degrees, too, where it shrinks again, to nothing at 720.
No angle is computed: with s = r / 2f, sin(theta) / r = sqrt(1 - s^2) / f and cos(theta) = 1 - 2 s^2.
Singular: r = 2 f, the point straight behind the eye.
Reference: Blender manual, Cameras > Panoramic; rays read out of Cycles.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import asin, sin

import numpy as np

from ..records import BlenderCamera, Raster
from .parts.film import Film, Window
from .parts.radial import Radial, up_to
from .parts.settings import WIDEST_FISHEYE, positive


@dataclass(frozen=True)
class FisheyeEquisolid(Radial):
    """s = r / 2f = sin(theta / 2); the window gives s."""

    key = "FISHEYE_EQUISOLID"
    smooth = False

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> FisheyeEquisolid:
        """Build it from fisheye_lens (mm), fisheye_fov, sensor and shift; InputError where one has no meaning."""
        film = Film.from_blender(raw, raster)
        diameter = 2 * positive(raw, "fisheye_lens")
        fov = positive(raw, "fisheye_fov", WIDEST_FISHEYE, "deg")
        window = Window.round_pixels(raw, raster, film.size / film.fitted_pixels / diameter)
        return cls(window, max(sin(fov / 4), 0.0))

    def factors(self, r_squared):
        """See Radial."""
        return 2 * np.sqrt(1 - r_squared), 1 - 2 * r_squared

    def radius(self, theta):
        """See Radial."""
        return up_to(self.rim, np.sin(theta / 2))

    @property
    def widest(self) -> float:
        """See Radial."""
        return 2 * asin(self.rim)
