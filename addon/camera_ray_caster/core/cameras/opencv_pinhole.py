"""OpenCV's calibrated camera: a pinhole whose picture a lens distorts.

Assumption: the distortion is that of radial_tangential.py, inverted by Newton's method to full precision. Beyond the
radius up to which it is one-to-one, where the picture would fold, pixels have no ray and points have no pixel.
Formula: K in OpenCV's convention, skew included, takes the pixel to the sensor's coordinates, and parts/tilt.py takes
these to distorted coordinates; undistorted, they are (X, -Y) at unit depth.
Singular: that radius, and the line in which a tilted sensor meets the plane of the eye.
Reference: OpenCV documentation, Camera Calibration and 3D Reconstruction (calibrateCamera, projectPoints).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import atan

import numpy as np

from ..conventions import gamma
from ..maths.panels import on_raster
from ..maths.recording.scalars import plain
from ..maths.vector import components
from ..records import BlenderCamera, Pose, Raster
from .model import IN_CASTS, NOWHERE, Step, WindowModel
from .parts.aperture import Aperture
from .parts.calibration import CALIBRATION, PINHOLE, Calibration
from .parts.film import OFF_AXIS, Film, raster_from
from .parts.radial import DISTORTED, up_to
from .parts.radial_tangential import RadialTangential
from .parts.silhouette import pixel_bounds
from .parts.tilt import Tilt

EDGE_POINTS, EDGE_MARGIN = 129, 1.01
"""Number of points along a side of the frame at which radii are computed, and a factor for those between them."""


@dataclass(frozen=True)
class OpencvPinhole(WindowModel):
    """A pinhole with distortion and tilt, whose window has the sensor's coordinates, y up."""

    distortion: RadialTangential
    tilt: Tilt

    key = "OPENCV_PINHOLE"
    label = "OpenCV Pinhole"
    description = "A calibrated lens: radial, tangential and thin prism distortion, a tilted sensor"
    group = "Calibrated"
    number = 4
    planar = True
    SETTINGS = (*CALIBRATION, *PINHOLE)
    FORMULA = (
        DISTORTED,
        Step("Without the tilt by tau_x and tau_y", "m = u t_1 + v t_2 + t_3, a = m_x / m_z, b = m_y / m_z"),
        Step(
            "Gain at the undistorted X and Y, y down, found by Newton's method",
            "rho = sqrt(X² + Y²), g = (1 + k1 rho² + k2 rho⁴ + k3 rho⁶) / (1 + k4 rho² + k5 rho⁴ + k6 rho⁶)",
        ),
        Step("Their distortion across gives a", "a = X g + 2 p1 X Y + p2 (rho² + 2 X²) + s1 rho² + s2 rho⁴"),
        Step("Their distortion down gives b", "b = Y g + p1 (rho² + 2 Y²) + 2 p2 X Y + s3 rho² + s4 rho⁴"),
        Step("Direction", "r = (X, -Y, -1)"),
    )

    def formula_values(self, x, y):
        """See Model: the columns of the tilt's inverse, and the undistorted coordinates."""
        X, up = map(plain, self._undistorted(x, y))
        return {f"t_{i}": column for i, column in enumerate(self.tilt.columns, 1)} | {"X": X, "Y": -up}

    @property
    def straight(self) -> bool:  # type: ignore[override]
        """See Model: without distortion and tilt; casts of a street and a room take 0.55 times."""
        return not self._bends

    @property
    def guarded(self) -> bool:  # type: ignore[override]
        """See Model: rays iterate to undo the distortion."""
        return not self._bends

    @property
    def polynomials(self) -> int:  # type: ignore[override]
        """See Model: if there is distortion or tilt."""
        return IN_CASTS if self._bends else NOWHERE

    @property
    def ray_rounding(self) -> float:
        """See Model; gamma(2) without distortion and tilt."""
        return gamma(16) if self._bends else gamma(2)

    @property
    def _bends(self) -> bool:
        return self.distortion.bends or bool(self.tilt)

    @property
    def K(self) -> np.ndarray:
        return self.window.matrix(self.size[1])

    @cached_property
    def _reach(self) -> float:
        """An upper bound of the undistorted radii in the frame, which are largest at its edge."""
        radius = np.hypot(*self._undistorted(*self._edge))
        return self.distortion.limit if np.isnan(radius).any() else EDGE_MARGIN * float(radius.max())

    @property
    def _edge(self) -> tuple[np.ndarray, np.ndarray]:
        """Pixel coordinates x and y on the edge of the frame, a pixel outside."""
        width, height = self.size
        ends = [np.linspace(-1.0, side + 1.0, EDGE_POINTS) for side in (width, height)]
        x = np.concatenate((ends[0], ends[0], *np.full((2, EDGE_POINTS), ((-1.0,), (width + 1.0,)))))
        y = np.concatenate((*np.full((2, EDGE_POINTS), ((-1.0,), (height + 1.0,))), ends[1], ends[1]))
        return x, y

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> OpencvPinhole:
        calibration = Calibration.from_blender(raw, raster, PINHOLE)
        coefficients = dict(calibration.coefficients)
        tilt = Tilt(coefficients.pop("tau_x"), coefficients.pop("tau_y"))
        return cls(raster.size, calibration.window(), RadialTangential(**coefficients), tilt)

    @classmethod
    def off_axis(cls, raw: BlenderCamera, slope: float) -> BlenderCamera:
        """See Model: exactly for an undistorted lens, which sees the point that far from its center."""
        return replace(raw, settings={**raw.settings, OFF_AXIS: slope})

    def aperture(self, raw: BlenderCamera, pose: Pose) -> Aperture | None:
        """See Model. A tilted sensor tilts the plane of focus; the focal length is Blender's, and a pixel as large as
        on Blender's sensor. Distortion does not move the plane.
        """
        lens = super().aperture(raw, pose)
        focal = raw.lens * 1e-3
        if lens is None or not self.tilt or lens.focus <= focal:
            return lens
        film = Film.from_blender(raw, raster_from(raw))
        size = 1e3 / (1 / focal - 1 / lens.focus) / (self.K[0, 0] * film.size / film.fitted_pixels)
        across, down = self.tilt.slopes
        lens = replace(lens, tilt=(focal, across, -down, size))
        x, y = self._edge
        sharp = lens.sharpness(self.rays(x, y)[1])
        return replace(lens, nearest=(float(np.nanmin(sharp)), float(np.nanmax(sharp))))

    def rays(self, x, y):
        """See Model. The direction's x and y are NaN where there is no ray."""
        straight = self.window.plane_from_pixels
        across, up = on_raster(self._undistorted, x, y) if self._bends else straight(x, y)
        return (0.0, 0.0, 0.0), (across, up, -1.0)

    def _undistorted(self, x, y):
        u, v = self.window.plane_from_pixels(x, y)
        u, v = self.tilt.upright(u, -v) if self.tilt else (u, -v)
        across, down = self.distortion.undistort(u, v) if self.distortion.bends else (u, v)
        return across, -down

    def project(self, points):
        """See Model: NaN at and behind the eye's plane, and beyond the radius at which rays end."""
        x, y, z = components(np.asarray(points, np.float64))
        depth = np.where(z < 0, -z, np.nan)
        across, down = x / depth, -y / depth
        r = np.hypot(across, down)
        kept = up_to(self.distortion.limit, r) / np.where(r > 0, r, 1.0)  # 1, or slightly less at the rim
        kept = np.where(r > 0, kept, 1.0)
        across, down = across * kept, down * kept
        u, v = self.distortion.distort(across, down)
        u, v = self.tilt.onto_sensor(u, v) if self.tilt else (u, v)
        return np.stack(self.window.pixels_from_plane(u, -v), axis=-1)

    def bounds(self, centers, radii):
        widest = atan(self.distortion.limit)
        (left, right), (low, high) = self.distortion.intervals(centers, radii, np.tan, widest, self._reach)
        if self.tilt:
            (left, right), (low, high) = self.tilt.intervals((left, right), (-high, -low))
            low, high = -high, -low
        return pixel_bounds(self.window, (left, right), (low, high))
