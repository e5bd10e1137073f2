"""The pinhole camera: Blender's PERSP, the lecture's eye-image pyramid.

Assumption: every ray passes through the eye, the image plane is perpendicular to the viewing direction w.
Formula: direction = X u + Y v + w in camera axes (X, Y, -1), with (X, Y) the pixel on the plane at unit depth,
so that one sensor of S mm behind a lens of f mm spans S / f there. The lecture writes the same ray as
x u + aspect y v + d w over [-1, 1]^2, with d = 1 / tan(fov / 2).
Reference: Blender manual, Cameras; measured against Camera.calc_matrix_camera.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..records import BlenderCamera, InputError, Raster
from .parts.film import Film, Window
from .parts.silhouette import pinhole_interval, pixel_bounds


@dataclass(frozen=True)
class Perspective:
    """A pinhole looking along -Z; its window lies at unit depth."""

    window: Window

    key = "PERSP"
    planar = True
    central = True

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Perspective:
        """Build it from lens (mm), sensor and shift; InputError where the lens is no positive number."""
        if not 0 < raw.lens < np.inf:
            raise InputError(f"the lens of camera {raw.name!r} is {raw.lens} mm: it must be positive")
        return cls(Window.from_blender(raw, raster, Film.from_blender(raw, raster).size / raw.lens))

    def rays(self, x, y):
        """Return origin and direction, each a tuple of three broadcastable arrays, camera frame, direction_z = -1.

        x and y are pixel coordinates of broadcastable shapes. Each component is right to gamma(3) of the sum of
        the magnitudes of its parts.
        """
        return (0.0, 0.0, 0.0), (*self.window.plane_from_pixels(x, y), -1.0)

    def project(self, points):
        """Return the pixel coordinates (..., 2) of camera-frame points (..., 3); NaN at and behind the eye's plane."""
        depth = -points[..., 2]
        depth = np.where(depth > 0, depth, np.nan)
        return np.stack(self.window.pixels_from_plane(points[..., 0] / depth, points[..., 1] / depth), axis=-1)

    def bounds(self, centers, radii):
        """Return (n, 4) pixel bounds x0, x1, y0, y1 outside of which no point of the spheres (camera frame) is seen."""
        x, y, depth = centers[:, 0], centers[:, 1], -centers[:, 2]
        return pixel_bounds(self.window, pinhole_interval(x, depth, radii), pinhole_interval(y, depth, radii))
