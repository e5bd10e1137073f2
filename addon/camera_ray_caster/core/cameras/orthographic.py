"""The orthographic camera: Blender's ORTHO, the lecture's parallel projection.

Assumption: all rays are parallel to the viewing direction w and leave the camera's plane z = 0.
Formula: origin (X, Y, 0), direction (0, 0, -1); the fitted side of the frame is ortho_scale long. The lecture
writes origin = e + x size u + y size v over [-1, 1]^2.
Reference: Blender manual, Cameras; measured against Camera.calc_matrix_camera.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..records import BlenderCamera, InputError, Raster
from .parts.film import Window
from .parts.silhouette import pixel_bounds


@dataclass(frozen=True)
class Orthographic:
    """Parallel rays along -Z; the window lies on z = 0, in Blender units."""

    window: Window

    key = "ORTHO"
    planar = True
    central = False

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Orthographic:
        """Build it from the orthographic scale and shift; InputError where the scale is no positive number."""
        if not 0 < raw.ortho_scale < np.inf:
            raise InputError(f"the orthographic scale of camera {raw.name!r} is {raw.ortho_scale}: it must be positive")
        return cls(Window.from_blender(raw, raster, raw.ortho_scale))

    def rays(self, x, y):
        """Return origin and direction, each a tuple of three broadcastable arrays, camera frame, direction_z = -1.

        x and y are pixel coordinates of broadcastable shapes. The origin is right to gamma(3) of the sum of the
        magnitudes of its parts, the direction is exact.
        """
        return (*self.window.plane_from_pixels(x, y), 0.0), (0.0, 0.0, -1.0)

    def project(self, points):
        """Return the pixel coordinates (..., 2) of camera-frame points (..., 3): defined for all, behind too."""
        return np.stack(self.window.pixels_from_plane(points[..., 0], points[..., 1]), axis=-1)

    def bounds(self, centers, radii):
        """Return (n, 4) pixel bounds x0, x1, y0, y1 outside of which no point of the spheres (camera frame) is seen."""
        x, y = centers[:, 0], centers[:, 1]
        behind = centers[:, 2] - radii > 0
        radii = np.where(behind, np.nan, radii)
        return pixel_bounds(self.window, (x - radii, x + radii), (y - radii, y + radii))
