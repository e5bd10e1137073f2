"""Omnidirectional stereo: the equirectangular panorama of an eye that moves on a circle as the head turns.

Each column has its own eye, half the interocular distance to the left or right of the center, which looks straight
ahead: the rays are tangents of the circle. With side = (cos lon, 0, sin lon), s = -1 for the left eye, +1 for the
right: origin = s (d / 2) side, direction = (cos lat sin lon, sin lat, -cos lat cos lon).
The frame spans 360 x 180 degrees per eye. For both eyes it is halved: TOP_BOTTOM has the left eye's picture above,
SIDE_BY_SIDE on the left. Shift is ignored. The camera equals Blender's spherical stereo of a panorama without
convergence and pole merge. With distance 0 it is the equirectangular panorama.
Singular: the poles, each a whole row; the seam behind; the circle itself. No ray enters the cylinder over the circle.
References: S. Peleg, M. Ben-Ezra and Y. Pritch, Omnistereo: Panoramic Stereo Imaging, PAMI 23 (2001); Google Inc.,
Rendering Omni-directional Stereo Content (2015).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import pi

import numpy as np

from ..maths.recording.scalars import plain
from ..maths.vector import components
from ..records import BlenderCamera, InputError, Raster
from .model import Step, WindowModel
from .parts.film import Window
from .parts.meridians import RAY
from .parts.settings import FULL_TURN, STEREO, Choice, Item, Number
from .parts.silhouette import longitude_latitude, pixel_bounds, turned

EYES = {"LEFT": (-1.0, -1.0), "RIGHT": (1.0, 1.0), "TOP_BOTTOM": (1.0, -1.0), "SIDE_BY_SIDE": (-1.0, 1.0)}
"""The eyes, s, of the lower half of the frame (the left half if side by side) and of the other half."""


EYE = Choice(
    "eye", "Eye", "Eye that sees the picture. The interocular distance is in the camera's Stereoscopy settings",
    "LEFT",
    (
        Item("LEFT", "Left", "Left eye", 0),
        Item("RIGHT", "Right", "Right eye", 1),
        Item("TOP_BOTTOM", "Top-Bottom", "Both eyes, the left eye above the right eye", 2),
        Item("SIDE_BY_SIDE", "Side by Side", "Both eyes side by side, the left eye on the left", 3),
    ),
)  # fmt: skip
DISTANCE = Number(
    "interocular_distance", "Interocular Distance", "Distance between the eyes", 0.065, 0.0, unit="length", owner=STEREO
)


@dataclass(frozen=True)
class OmnidirectionalStereo(WindowModel):
    """A camera whose window has longitude and latitude for one eye."""

    radius: float
    """Radius of the eyes' circle."""
    eyes: str
    """A key of EYES."""

    key = "OMNIDIRECTIONAL_STEREO"
    label = "Omnidirectional Stereo"
    description = "A panorama for the eyes of a turning head"
    group = "Panorama"
    number = 16
    central = False
    guarded = False
    smooth = False  # if both eyes have a picture, rays jump between them
    SETTINGS = (EYE, DISTANCE)
    FORMULA = (
        Step("Longitude and latitude at X, Y of the eye's picture", "lon = (X/W - 1/2) 360°, lat = (Y/H - 1/2) 180°"),
        Step(
            "Origin, on the circle of the eyes; s = -1 for the left eye, +1 for the right eye",
            "o = (s radius cos(lon), 0, s radius sin(lon))",
        ),
        RAY,
    )

    def formula_values(self, x, y):
        """See Model: the place in the eye's picture, the eye's side, and half the distance of the eyes."""
        return dict(zip("XYs", map(plain, self._one_eye(x, y)), strict=True)) | {"radius": self.radius}

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> OmnidirectionalStereo:
        window = Window(raster.width / 2, raster.height / 2, FULL_TURN / raster.width, pi / raster.height)
        return cls(raster.size, window, DISTANCE.read(raw) / 2, EYE.read(raw))

    @classmethod
    def eye(cls, raw: BlenderCamera, view: str) -> BlenderCamera:
        """Return the record of the eye with this name. Raises InputError for a picture that shows both eyes."""
        first, second = EYES[EYE.read(raw)]
        if first != second:
            problem = f"camera {raw.name!r} has both eyes in one picture"
            raise InputError(f"{problem}: choose one eye, or disable Stereoscopy")
        return replace(raw, settings={**raw.settings, EYE.name: view.upper()})

    @property
    def shape(self) -> float:
        first, second = EYES[self.eyes]
        return 2.0 if first == second else 1.0 if self.eyes == "TOP_BOTTOM" else 4.0

    def rays(self, x, y):
        """See Model. Each component is right to some EPS."""
        x, y, side = self._one_eye(x, y)
        longitude, latitude = self.window.plane_from_pixels(x, y)
        sine, cosine, flat = np.sin(longitude), np.cos(longitude), np.cos(latitude)
        offset = side * self.radius
        return (offset * cosine, 0.0, offset * sine), (flat * sine, np.sin(latitude), -flat * cosine)

    def project(self, points):
        """See Model: NaN within the eyes' circle; the left eye's pixel if both have a picture. The eye sees a point at
        the distance r from the axis past the center by asin(d / 2 r), at the horizontal distance sqrt(r^2 - d^2 / 4).
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
        """See Model. Both eyes' pictures of a sphere share one rectangle."""
        x, y, z = components(centers)
        (low, high), _ = longitude_latitude(centers, radii)
        across = np.hypot(x, z)
        ends = across - radii, across + radii
        near, far = (np.sqrt(np.maximum(end - self.radius, 0) * (end + self.radius)) for end in ends)
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
        """Return the pixel coordinates in a frame of one eye alone, and that eye, s."""
        first, second = EYES[self.eyes]
        if first == second:
            return x, y, first
        length, position = (self.size[1], y) if self.eyes == "TOP_BOTTOM" else (self.size[0], x)
        later = position >= length / 2
        position = 2 * (position - np.where(later, length / 2, 0.0))
        side = np.where(later, second, first)
        return (x, position, side) if self.eyes == "TOP_BOTTOM" else (position, y, side)

    def _in_frame(self, x, y, later):
        """Return the frame's pixel coordinates of a place in one eye's frame, which is its second half if ``later``."""
        if self.eyes == "TOP_BOTTOM":
            y = (y + later * self.size[1]) / 2
        elif self.eyes == "SIDE_BY_SIDE":
            x = (x + later * self.size[0]) / 2
        return x, y
