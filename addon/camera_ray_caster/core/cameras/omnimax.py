"""Omnimax: the fisheye of IMAX Dome films, whose axis lies below the middle of the frame.

Assumption: the film is seen from the dome's center; the dome's ``tilt`` pitches the lens up from the camera's viewing
direction. The picture spans about 180 degrees across, 90 degrees above the axis and 45 degrees below it.
Formula: theta = 1.411269 r - 0.09439 r^3 + 0.25674 r^5, azimuth kept. The circle r = 1 touches the frame's top and
sides. The film's frame is 1.283458 times as wide as high. A wider frame stays empty at the sides, a narrower one shows
more below the axis, and a frame higher than wide has the axis in the middle. There is no ray where r > 1, nor more than
45 degrees below the axis.
Singular: nowhere.
References: N. Max, Computer Graphics Distortion for IMAX and OMNIMAX Projection (1983); POV-Ray's omnimax camera.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..conventions import gamma
from ..maths.inversion import Inverse
from ..maths.vector import components
from ..records import BlenderCamera, Raster
from .model import IN_CASTS, Step
from .parts.film import SHIFT, Window
from .parts.pitched import LENS_RAY, PITCH, TILT, Pitched
from .parts.radial import RADIUS, Radial, factors_of, radii_of

ASPECT = 1.283458
LINEAR, CUBIC, QUINTIC = 1.411269, -0.09439, 0.25674


def angle(r):
    """Return theta (rad) of radii; the lens uses radii up to 1."""
    return r * (LINEAR + r * r * (CUBIC + r * r * QUINTIC))


def slope(r):
    """Return the derivative of theta by the radius, which is positive."""
    return LINEAR + r * r * (3 * CUBIC + r * r * 5 * QUINTIC)


RADIUS_OF = Inverse(angle, slope, 0.0, 1.0)
"""The radius of an angle."""


@dataclass(frozen=True)
class OmnimaxLens(Radial):
    """The lens alone, with its axis along the viewing direction."""

    def project(self, points):
        _, y, z = components(points)
        below = y - z < -gamma(16) * (np.abs(y) + np.abs(z))
        return np.where(below[..., None], np.nan, super().project(points))

    def factors(self, r_squared):
        r = radii_of(r_squared)
        theta = angle(r)
        return factors_of(theta, r)

    def _factors_at(self, x, y):
        scale, cosine = super()._factors_at(x, y)
        below = self._plane(x, y)[1] * scale < -cosine
        return np.where(below, np.nan, scale), np.where(below, np.nan, cosine)

    def radius(self, theta):
        """See Radial: by Newton's method."""
        return RADIUS_OF(theta)

    @property
    def widest(self) -> float:
        return angle(1.0)


@dataclass(frozen=True)
class Omnimax(Pitched, OmnimaxLens):
    """The lens, pitched up by the dome's tilt."""

    key = "OMNIMAX"
    label = "Omnimax"
    description = "The film of IMAX Dome theaters"
    group = "Dome"
    number = 6
    polynomials = IN_CASTS
    SETTINGS = (TILT, *SHIFT)
    FORMULA = (
        Step(
            "Pixel on the film, its top at 1, at most 1.283458 as wide as high",
            "a = left + x/W (right - left), b = bottom + y/H (top - bottom)",
        ),
        RADIUS,
        Step("Angle from the axis", "theta = 1.411269 rho - 0.09439 rho³ + 0.25674 rho⁵"),
        Step(f"{LENS_RAY.words}; no ray more than 45° below the axis, where d_y < d_z", LENS_RAY.symbols),
        PITCH,
        Step("Elevation of the axis", "e = tilt"),
    )

    def formula_values(self, x: float, y: float) -> dict[str, Any]:
        """See Model: the frame's edges on the film."""
        return dict(zip(("left", "right", "bottom", "top"), self.window.extent(self.size), strict=True))

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Omnimax:
        aspect = raster.width / (raster.height * raster.pixel_aspect)
        across = max(aspect / ASPECT, 1.0)
        bottom, top = (1 - 2 / min(aspect, ASPECT), 1.0) if aspect > 1 else (-1 / aspect, 1 / aspect)
        window = Window.over_frame(raw, raster, (-across, across), (bottom, top))
        return cls(raster.size, window, 1.0, elevation=TILT.read(raw))
