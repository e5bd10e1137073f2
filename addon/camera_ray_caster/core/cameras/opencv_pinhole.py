"""OpenCV's calibrated camera: a pinhole whose picture a lens distorts.

Assumption: the distortion of radial_tangential.py, inverted by Newton's method to full precision. Pixels and points
beyond the radius up to which it is one-to-one have no ray and no pixel, instead of those of a folded picture.
Formula: K in OpenCV's convention brings the pixel to distorted coordinates, undistorted they are (X, -Y) at unit depth.
Singular: that radius.
Reference: OpenCV documentation, Camera Calibration and 3D Reconstruction (calibrateCamera, projectPoints).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan

import numpy as np

from ..maths.chebyshev import on_raster
from ..maths.vector import components
from ..records import BlenderCamera, Raster
from .parts.calibration import RADIAL_TANGENTIAL, Calibration
from .parts.film import Window
from .parts.radial import AT_THE_RIM
from .parts.radial_tangential import RadialTangential
from .parts.silhouette import angular_radius, pixel_bounds, radial_intervals


@dataclass(frozen=True)
class OpencvPinhole:
    """A pinhole behind a window of distorted coordinates, y up."""

    window: Window
    distortion: RadialTangential

    key = "OPENCV_PINHOLE"
    planar = True
    central = True

    @property
    def by_panels(self) -> bool:
        """Whether polynomials give the rays of a picture; see panels."""
        return self.distortion.bends

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> OpencvPinhole:
        """Build it from the settings of the same names or a calibration file; see Calibration for what is refused."""
        calibration = Calibration.from_blender(raw, raster, RADIAL_TANGENTIAL)
        return cls(calibration.window(raster), RadialTangential(**calibration.coefficients))

    def rays(self, x, y):
        """Return origin and direction, each a tuple of three broadcastable arrays, camera frame, direction_z = -1.

        x and y are pixel coordinates of broadcastable shapes. x and y are NaN where there is no ray.
        """
        straight = self.window.plane_from_pixels
        across, up = on_raster(self._undistorted, x, y) if self.by_panels else straight(x, y)
        return (0.0, 0.0, 0.0), (across, up, -1.0)

    def _undistorted(self, x, y):
        u, v = self.window.plane_from_pixels(x, y)
        across, down = self.distortion.undistort(u, -v)
        return across, -down

    def project(self, points):
        """Return the pixel coordinates (..., 2) of camera-frame points (..., 3).

        NaN at and behind the eye's plane and beyond the radius up to which there are rays.
        """
        x, y, z = components(np.asarray(points, np.float64))
        depth = np.where(z < 0, -z, np.nan)
        across, down = x / depth, -y / depth
        seen = np.hypot(across, down) <= self.distortion.limit * AT_THE_RIM
        across, down = np.where(seen, across, np.nan), np.where(seen, down, np.nan)
        u, v = self.distortion.distort(across, down)
        return np.stack(self.window.pixels_from_plane(u, -v), axis=-1)

    def bounds(self, centers, radii):
        """Return (n, 4) pixel bounds x0, x1, y0, y1 outside of which no point of the spheres (camera frame) is seen."""
        widest = atan(self.distortion.limit)

        def radius(theta):
            r = np.tan(theta)
            return r * self.distortion.gain(r * r)[0]

        across = np.hypot(centers[:, 0], centers[:, 1])
        far = np.arctan2(across, -centers[:, 2]) + angular_radius(np.hypot(across, centers[:, 2]), radii)
        spread = self.distortion.off_radius(np.tan(np.minimum(far, widest)))
        intervals = radial_intervals(centers, radii, radius, widest)
        return pixel_bounds(self.window, *((low - spread, high + spread) for low, high in intervals))
