"""Omnidirectional stereo: the equirectangular panorama of an eye that moves on its circle as the head turns.

Each column has its own eye, half the interocular distance to the left or right of the center, and looks straight ahead
of itself: the rays are tangents of the circle. With side = (cos lon, 0, sin lon), s = -1 the left eye, +1 the right:
origin = s (d / 2) side, direction = (cos lat sin lon, sin lat, -cos lat cos lon).
The frame spans 360 x 180 degrees an eye; for both eyes it is halved: TOP_BOTTOM has the left eye's picture above,
SIDE_BY_SIDE on the left. Shift has no meaning here and is ignored. It is Blender's spherical stereo of a panorama
without convergence and pole merge. With distance 0 it is the equirectangular panorama.
Singular: the poles, each a whole row; the seam behind; the circle itself. The cylinder over it, no ray enters.
References: S. Peleg, M. Ben-Ezra and Y. Pritch, Omnistereo: Panoramic Stereo Imaging, PAMI 23 (2001); Google Inc.,
Rendering Omni-directional Stereo Content (2015).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import pi

import numpy as np

from ..maths.vector import components
from ..records import BlenderCamera, InputError, Raster
from .model import Step, WindowModel
from .parts.film import Window
from .parts.settings import FULL_TURN, STEREO, Choice, Item, Number
from .parts.silhouette import longitude_latitude, pixel_bounds, turned

EYES = {"LEFT": (-1.0, -1.0), "RIGHT": (1.0, 1.0), "TOP_BOTTOM": (1.0, -1.0), "SIDE_BY_SIDE": (-1.0, 1.0)}
"""The eye, s, of the lower half of the frame (or the left one, side by side) and of the other half."""


EYE = Choice(
    "eye", "Eye", "Whose picture it is; the interocular distance is the camera's stereoscopy setting",
    "LEFT",
    (
        Item("LEFT", "Left", "The left eye", 0),
        Item("RIGHT", "Right", "The right eye", 1),
        Item("TOP_BOTTOM", "Top-Bottom", "Both, the left eye above", 2),
        Item("SIDE_BY_SIDE", "Side by Side", "Both, the left eye on the left", 3),
    ),
)  # fmt: skip
DISTANCE = Number(
    "interocular_distance", "Interocular Distance", "From eye to eye", 0.065, 0.0, unit="length", owner=STEREO
)


@dataclass(frozen=True)
class OmnidirectionalStereo(WindowModel):
    """A window of longitude and latitude for one eye; ``radius`` of the eyes' circle; one of EYES."""

    radius: float
    eyes: str

    key = "OMNIDIRECTIONAL_STEREO"
    label = "Omnidirectional Stereo"
    description = "A panorama for eyes on a turning head"
    group = "Panorama"
    number = 16
    central = False
    smooth = False  # where both eyes have a picture, it jumps between them
    SETTINGS = (EYE, DISTANCE)
    FORMULA = (
        Step("Longitude and latitude in the eye's picture", "lon = (x/W - 1/2) 360°, lat = (y/H - 1/2) 180°"),
        Step("Origin, s = -1 the left eye, +1 the right one", "o = s distance/2 (cos(lon), 0, sin(lon))"),
        Step("Direction", "d = (cos(lat) sin(lon), sin(lat), -cos(lat) cos(lon))"),
    )

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> OmnidirectionalStereo:
        """Build it from the interocular distance and the eye."""
        window = Window(raster.width / 2, raster.height / 2, FULL_TURN / raster.width, pi / raster.height)
        return cls(raster.size, window, DISTANCE.read(raw) / 2, EYE.read(raw))

    @classmethod
    def eye(cls, raw: BlenderCamera, view: str) -> BlenderCamera:
        """Return the record with the eye of that name. Raises InputError for a picture that shows both eyes."""
        first, second = EYES[EYE.read(raw)]
        if first != second:
            both = f"camera {raw.name!r} has both eyes in one picture"
            raise InputError(f"{both}: let it show one, or switch Stereoscopy off")
        return replace(raw, settings={**raw.settings, EYE.name: view.upper()})

    def rays(self, x, y):
        """Return origin and direction, each a tuple of three broadcastable arrays, camera frame, unit length.

        x and y are pixel coordinates of broadcastable shapes. Each component is right to some EPS.
        """
        x, y, side = self._one_eye(x, y)
        longitude, latitude = self.window.plane_from_pixels(x, y)
        sine, cosine, flat = np.sin(longitude), np.cos(longitude), np.cos(latitude)
        offset = side * self.radius
        return (offset * cosine, 0.0, offset * sine), (flat * sine, np.sin(latitude), -flat * cosine)

    def project(self, points):
        """Return the pixel coordinates (..., 2) of camera-frame points (..., 3); NaN within the eyes' circle.

        Where both eyes have a picture, the left eye's pixel. At a distance r from the axis the eye looks past the
        center by asin(d / 2 r), and has sqrt(r^2 - d^2 / 4) to go.
        """
        x, y, z = components(np.asarray(points, np.float64))
        first, second = EYES[self.eyes]
        side = min(first, second)
        across = np.hypot(x, z)
        outside = (across >= self.radius) & ((across > self.radius) | (y != 0))
        way = np.sqrt(np.where(outside, (across - self.radius) * (across + self.radius), np.nan))
        longitude = np.arctan2(x, -z) - side * np.arctan2(self.radius, way)
        longitude -= FULL_TURN * np.rint(longitude / FULL_TURN)
        column, row = self.window.pixels_from_plane(longitude, np.arctan2(y, way))
        return np.stack(self._in_frame(column, row, first != side), axis=-1)

    def bounds(self, centers, radii):
        """Return (n, 4) pixel bounds x0, x1, y0, y1 outside of which no point of the spheres (camera frame) is seen.

        Both eyes' pictures of a sphere share one rectangle.
        """
        x, y, z = components(centers)
        (low, high), _ = longitude_latitude(centers, radii)
        across = np.hypot(x, z)
        near, far = (
            np.sqrt(np.maximum(r - self.radius, 0) * (r + self.radius)) for r in (across - radii, across + radii)
        )
        past = [-side * np.arctan2(self.radius, way) for side in EYES[self.eyes] for way in (near, far)]
        inside = np.where(across - radii > self.radius, 0.0, np.inf)
        low, high = low + np.minimum.reduce(past) - inside, high + np.maximum.reduce(past) + inside
        columns = turned((low, high), (-pi, pi), FULL_TURN)
        bottom, top = y - radii, y + radii
        rows = np.arctan2(bottom, np.where(bottom > 0, far, near)), np.arctan2(top, np.where(top > 0, near, far))
        x0, x1, y0, y1 = pixel_bounds(self.window, columns, rows).T
        x0, y0 = self._in_frame(x0, y0, False)
        x1, y1 = self._in_frame(x1, y1, EYES[self.eyes][0] != EYES[self.eyes][1])
        return np.stack((x0, x1, y0, y1), axis=-1)

    def _one_eye(self, x, y):
        """Return the pixel coordinates in a frame of one eye alone, and the eye."""
        first, second = EYES[self.eyes]
        if first == second:
            return x, y, first
        length, place = (self.frame[1], y) if self.eyes == "TOP_BOTTOM" else (self.frame[0], x)
        later = place >= length / 2
        place = 2 * (place - np.where(later, length / 2, 0.0))
        side = np.where(later, second, first)
        return (x, place, side) if self.eyes == "TOP_BOTTOM" else (place, y, side)

    def _in_frame(self, x, y, later):
        """Return where pixel coordinates of one eye's frame lie in the frame: in its later half, or in the first."""
        if self.eyes == "TOP_BOTTOM":
            y = (y + later * self.frame[1]) / 2
        elif self.eyes == "SIDE_BY_SIDE":
            x = (x + later * self.frame[0]) / 2
        return x, y
