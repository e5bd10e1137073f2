"""One face of an equiangular cube map: Blender's EQUIANGULAR_CUBEMAP_FACE.

Assumption: columns are evenly spaced in the angle to the left and right of the viewing direction, rows in the angle
above and below it. Both angles span 90 degrees over the frame.
Formula: direction ~ (tan alpha, tan beta, -1), alpha = (u - 1/2) pi/2, beta = (v - 1/2) pi/2. Shift moves the angles;
beyond 90 degrees the tangent begins again and the picture repeats, as in Cycles.
Singular: angles of 90 degrees, which are reached only by shift. They have no ray: the tangent has no sign there.
Reference: Blender manual, Cameras > Panoramic; rays read out of Cycles.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import pi

import numpy as np

from ..maths.vector import components
from ..records import BlenderCamera, Raster
from .model import IN_RAYS, Step, WindowModel
from .parts.film import SHIFT, Window
from .parts.silhouette import pinhole_interval, pixel_bounds, turned

STEEPEST = 1e15
"""Tangent of an angle that is 90 degrees to rounding."""


@dataclass(frozen=True)
class CubemapFace(WindowModel):
    """A camera whose window has the two angles, rad."""

    key = "EQUIANGULAR_CUBEMAP_FACE"
    label = "Equiangular Cubemap Face"
    description = "90 degrees across and up, with columns and rows at equal angles"
    group = "Blender's Own"
    polynomials = IN_RAYS
    SETTINGS = SHIFT
    FORMULA = (
        Step("Angles across and up", "alpha = (x/W - 1/2 + shift_x) pi/2, beta = (y/H - 1/2 + shift_y) pi/2"),
        Step("Direction, of any length", "r = (tan(alpha), tan(beta), -1)"),
    )

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> CubemapFace:
        return cls(raster.size, Window.over_frame(raw, raster, (-pi / 4, pi / 4), (-pi / 4, pi / 4)))

    @cached_property
    def extent(self) -> tuple[float, float, float, float]:
        """The angles that the frame shows: lowest and highest across, lowest and highest up."""
        return self.window.extent(self.size)

    def rays(self, x, y):
        """See Model. Each component is right to some EPS."""
        tangents = (np.tan(angle) for angle in self.window.plane_from_pixels(x, y))
        tangent_x, tangent_y = (np.where(np.abs(tangent) < STEEPEST, tangent, np.nan) for tangent in tangents)
        scale = 1 / np.sqrt(tangent_x * tangent_x + (tangent_y * tangent_y + 1))
        return (0.0, 0.0, 0.0), (tangent_x * scale, tangent_y * scale, -scale)

    def project(self, points):
        """See Model: NaN at and behind the eye's plane; of images in a shifted frame the one nearest to its middle."""
        x, y, z = components(np.asarray(points, np.float64))
        depth = np.where(z < 0, -z, np.nan)
        angles = []
        for side, low, high in ((x, *self.extent[:2]), (y, *self.extent[2:])):
            angle = np.arctan2(side, depth)
            angles.append(angle - pi * np.rint((angle - (low + high) / 2) / pi))
        return np.stack(self.window.pixels_from_plane(*angles), axis=-1)

    def bounds(self, centers, radii):
        x, y, z = components(centers)
        intervals = []
        for side, frame in ((x, self.extent[:2]), (y, self.extent[2:])):
            tangents = pinhole_interval(side, -z, radii, through=True)
            intervals.append(turned(tuple(np.arctan(tangent) for tangent in tangents), frame, pi))
        return pixel_bounds(self.window, *intervals)
