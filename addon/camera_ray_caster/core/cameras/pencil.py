"""The pencil camera: all rays meet one slit, and the rays in one plane through the slit meet at one point of it.

In the plane at an angle with the tangent m from the viewing direction, the eye has moved by ``slide`` m along the slit
from the object's point: each line of the picture has its own pinhole. With slide 0 all are the pinhole at that point.
A pixel at (X, Y) of the perspective window has the direction v = (X, Y, -1) and the eye p + slide m l, with
m = (n . v) / (w . v): l is the slit's direction, n is across it in the image plane, w is across both and points ahead.
A slit parallel to the image plane gives a general linear camera.
Singular: points and directions in the plane of l and n, where m is infinite. Near it there is no ray: the rounding of
a point at unit distance moves its eye by about EPS slide^2 m^3, which is at most CLEAR EPS.
Reference: J. Yu and L. McMillan, General Linear Cameras, ECCV 2004.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..maths.intervals import Interval
from ..maths.recording.scalars import cbrt
from ..maths.vector import along, components, difference, dot, norm
from ..records import BlenderCamera, Raster
from .model import IN_RAYS, Step, WindowModel
from .parts.lines import SLIT, image_axes, slit_from
from .parts.settings import Number
from .parts.silhouette import pinhole_interval, pixel_bounds
from .perspective import PLANE, Perspective

SLIDE = Number(
    "pencil_slide", "Slide",
    "Distance that the eye moves along the slit for rays at 45 degrees across it; 0 is a pinhole", 1.0, unit="length",
)  # fmt: skip


CLEAR = 1e10
"""Largest slide^2 |m|^3 of a ray."""


@dataclass(frozen=True)
class Pencil(WindowModel):
    """A slit through ``point``; ``axes`` holds l, n and w in its rows, an orthonormal basis of the camera's frame."""

    point: np.ndarray
    axes: np.ndarray
    slide: float

    key = "PENCIL"
    label = "Pencil"
    description = "Each line of the picture has its own eye on a slit"
    group = "Multiperspective"
    number = 13
    central = False
    polynomials = IN_RAYS
    SETTINGS = (SLIT, SLIDE, *Perspective.SETTINGS)
    FORMULA = (
        *PLANE,
        Step("Direction", "r = (X, Y, -1)"),
        Step("Its tangent across the slit, l along it, n across, c ahead", "m = (n . r) / (c . r)"),
        Step("Origin, on the slit through s", "o = s + slide m l"),
    )

    def formula_values(self, x, y):
        """See Model: the slit."""
        return dict(zip("slnc", (self.point, *self.axes), strict=True))

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Pencil:
        point, direction = slit_from(raw)
        _, across = image_axes(raw, direction)
        axes = np.stack((direction, across, np.cross(across, direction)))
        return cls(raster.size, Perspective.from_blender(raw, raster).window, point, axes, SLIDE.read(raw))

    def rays(self, x, y):
        """See Model. The direction is NaN in the plane of l and n. The origin is right to some EPS of its parts over
        the cosine of the angle between w and v, the direction to some EPS.
        """
        direction = *self.window.plane_from_pixels(x, y), -1.0
        origin, known = self._eye(direction)
        scale = np.where(known, 1.0, np.nan) / norm(direction)
        return origin, tuple(component * scale for component in direction)

    def project(self, points):
        """Return the pixel coordinates (..., 2) of camera-frame points (..., 3); NaN at and behind the eye's plane."""
        points = np.asarray(points, np.float64)
        eye, known = self._eye(components(points - self.point))
        x, y, z = difference(components(points), eye)
        depth = np.where(known & (z < 0), -z, np.nan)
        return np.stack(self.window.pixels_from_plane(x / depth, y / depth), axis=-1)

    def bounds(self, centers, radii):
        beside, rise, ahead = ((centers - self.point) @ self.axes.T).T
        side = np.where(ahead < 0, -1.0, 1.0)  # a line through the slit has the same m on both sides of it
        m, tangent = (
            Interval(*pinhole_interval(side * component, side * ahead, radii, through=True))
            for component in (rise, beside)
        )
        depth = Interval.around(ahead, radii)
        lag = m * self.slide
        tangent = tangent - lag / depth
        across, up, away = (a * tangent + b * m + c for a, b, c in self.axes.T.tolist())
        x, y = across / -away, up / -away
        bounds = pixel_bounds(self.window, (x.low, x.high), (y.low, y.high))
        height = Interval.around(centers[:, 2] - self.point[2], radii) - lag * self.axes[0, 2]
        bounds[height.low >= 0] = np.nan
        return bounds

    @cached_property
    def _flattest(self) -> float:
        """Return the smallest 1 / |m| of a ray; 0 for a pinhole."""
        return cbrt(self.slide / CLEAR * self.slide)

    def _eye(self, direction):
        """Return the eye of rays in a direction, or in the plane of a place relative to ``point``; and if it exists."""
        rise, ahead = dot(self.axes[1], direction), dot(self.axes[2], direction)
        known = (ahead != 0) & (np.abs(rise) * self._flattest <= np.abs(ahead))
        return along(self.point, self.axes[0], self.slide * rise / np.where(known, ahead, 1.0)), known
