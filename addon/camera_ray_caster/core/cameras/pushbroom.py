"""The pushbroom camera: the eye flies along a slit and sees one line of the picture, across the slit, at a time.

All rays start on the slit and are parallel to one plane. Let a be the slit's direction as seen in the picture, and n
the direction across it, both in the image plane. A pixel at (X, Y) of the perspective window has the eye on the slit
where a . eye = k a . (X, Y), and the direction (n . (X, Y)) n - Z. The picture is perspective across the slit, by lens
and sensor, and orthographic along it, by ortho_scale, which has the same length as in Blender's ORTHO (k is the size of
the ORTHO frame over that of the perspective frame).
A slit parallel to the image plane gives a general linear camera; a slit that comes nearer is still a pushbroom.
Singular: points in the plane through the slit and n. Each point on the slit is the eye of a whole line of pixels; no
pixel sees the others.
Reference: R. Gupta and R. Hartley, Linear Pushbroom Cameras, PAMI 19 (1997).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..maths.intervals import Interval
from ..maths.vector import along as point_along
from ..maths.vector import components, difference, dot
from ..records import BlenderCamera, Raster
from .model import IN_RAYS, Step, WindowModel
from .orthographic import Orthographic
from .parts.film import ORTHO_SCALE
from .parts.lines import SLIT, image_axes, slit_from
from .parts.silhouette import pinhole_interval, pixel_bounds
from .perspective import PLANE, Perspective


@dataclass(frozen=True)
class Pushbroom(WindowModel):
    """A slit through ``start``, with a . start = 0; the eye that sees a point is start + (a . point) step."""

    stretch: float
    """The factor k along the slit: Blender units per unit of the window."""
    along: np.ndarray
    across: np.ndarray
    start: np.ndarray
    step: np.ndarray

    key = "PUSHBROOM"
    label = "Pushbroom"
    description = "The eye moves along a slit: perspective across it, orthographic along it"
    group = "Multiperspective"
    number = 12
    central = False
    polynomials = IN_RAYS
    SETTINGS = (SLIT, ORTHO_SCALE, *Perspective.SETTINGS)
    FORMULA = (
        *PLANE,
        Step(
            "Origin, on the slit through s, with steps c of length 1 along its picture a; k is the orthographic frame "
            "over the perspective one",
            "P = X u + Y v, o = s + k (a . P) c",
        ),
        Step("Direction, n across the slit's picture", "m = n . P, r = m n + w"),
    )

    def formula_values(self, x, y):
        """See Model: the slit."""
        return {"s": self.start, "c": self.step, "a": self.along, "n": self.across, "k": self.stretch}

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Pushbroom:
        window = Perspective.from_blender(raw, raster).window
        stretch = Orthographic.from_blender(raw, raster).window.pitch_x / window.pitch_x
        point, direction = slit_from(raw)
        along, across = image_axes(raw, direction)
        step = direction / (along @ direction)
        return cls(raster.size, window, stretch, along, across, point - (along @ point) * step, step)

    def rays(self, x, y):
        """See Model. The origin is right to some EPS of the slit's length in view and its distance, the direction to
        some EPS.
        """
        plane = *self.window.plane_from_pixels(x, y), 0.0
        slope = dot(self.across, plane)
        scale = 1 / np.sqrt(slope * slope + 1)
        origin = point_along(self.start, self.step, self.stretch * dot(self.along, plane))
        return origin, (self.across[0] * slope * scale, self.across[1] * slope * scale, -scale)

    def project(self, points):
        """Return the pixel coordinates (..., 2) of camera-frame points (..., 3); NaN at and behind the eye's plane."""
        point = components(np.asarray(points, np.float64))
        position = dot(self.along, point)
        beside = difference(point, point_along(self.start, self.step, position))
        depth = np.where(beside[2] < 0, -beside[2], np.nan)
        plane = self._plane(position, dot(self.across, beside) / depth)
        return np.stack(self.window.pixels_from_plane(*plane), axis=-1)

    def bounds(self, centers, radii):
        inward = self.along * self.step[2] - (0.0, 0.0, 1.0)  # a point's depth before its eye is linear in the point
        length = np.linalg.norm(inward)
        beside = centers - self.start
        slope = pinhole_interval(beside @ self.across, beside @ inward / length, radii)
        x, y = self._plane(Interval.around(centers @ self.along, radii), Interval(*slope) * (1 / length))
        bounds = pixel_bounds(self.window, (x.low, x.high), (y.low, y.high))
        bounds[np.isnan(slope[0])] = np.nan
        return bounds

    def _plane(self, position, slope):
        """Return the image-plane X, Y of places along the slit and slopes across it, numbers or intervals."""
        a, n = self.along, self.across
        position = position * (1 / self.stretch)
        return position * a[0] + slope * n[0], position * a[1] + slope * n[1]
