"""The pinhole camera: Blender's PERSP.

Assumption: every ray passes through the eye; the image plane is perpendicular to the viewing direction w.
Formula: direction = X u + Y v + w, in camera axes (X, Y, -1), with (X, Y) the pixel on the plane at unit depth. A
sensor of S mm behind a lens of f mm spans S / f there. Over [-1, 1]^2 the same ray is often written as
x u + aspect y v + d w, with d = 1 / tan(fov / 2).
Reference: Blender manual, Cameras; measured against Camera.calc_matrix_camera.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan, degrees
from typing import ClassVar

import numpy as np

from ..conventions import gamma
from ..records import BlenderCamera, Raster
from .model import Step, WindowModel
from .parts.film import FILM, LENS, Film, Window, off_axis
from .parts.settings import Setting
from .parts.silhouette import pinhole_interval, pixel_bounds

PLANE = (
    Step("Pixel on the plane at unit depth", "X = (x - W/2 + shift_x V) q, Y = ((y - H/2) p + shift_y V) q"),
    Step(
        "Pixel width on the plane (V: pixels along the fitted side; p: pixel height / width)",
        "q = sensor / (lens V)",
    ),
)
"""The first steps of models with a perspective window."""


@dataclass(frozen=True)
class Perspective(WindowModel):
    """A pinhole looking along -Z; its window lies at unit depth."""

    key = "PERSP"
    label = "Perspective"
    description = "A pinhole camera: straight lines stay straight"
    group = "Blender's Own"
    planar = True
    straight = True
    ray_rounding = gamma(2)
    SETTINGS: ClassVar[tuple[Setting, ...]] = (LENS, *FILM)
    FORMULA: ClassVar[tuple[Step, ...]] = (
        *PLANE,
        Step("Direction along the axes u, v, w", "r = X u + Y v + w"),
        Step("Normalized form over [-1, 1]², moved by the shift", "r = x u + aspect y v + d w, d = 1 / tan(fov / 2)"),
    )

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Perspective:
        film = Film.from_blender(raw, raster)
        return cls(raster.size, Window.before_eye(raw, raster, film.size / LENS.read(raw), (LENS, film.sensor)))

    @classmethod
    def off_axis(cls, raw: BlenderCamera, slope: float) -> BlenderCamera:
        return off_axis(raw, slope)

    def rays(self, x, y):
        """See Model. Each component is right to gamma(3) of the sum of the magnitudes of its parts."""
        return (0.0, 0.0, 0.0), (*self.window.plane_from_pixels(x, y), -1.0)

    def project(self, points):
        """Return the pixel coordinates (..., 2) of camera-frame points (..., 3); NaN at and behind the eye's plane."""
        depth = -points[..., 2]
        depth = np.where(depth > 0, depth, np.nan)
        return np.stack(self.window.pixels_from_plane(points[..., 0] / depth, points[..., 1] / depth), axis=-1)

    def bounds(self, centers, radii):
        x, y, depth = centers[:, 0], centers[:, 1], -centers[:, 2]
        return pixel_bounds(self.window, pinhole_interval(x, depth, radii), pinhole_interval(y, depth, radii))

    @property
    def K(self) -> np.ndarray | None:
        return self.window.matrix(self.size[1])

    def facts(self) -> dict[str, object]:
        """Return the field of view across and up (degrees, without shift, as in Blender's panel), and d and aspect of
        the normalized ray x u + aspect y v + d w over [-1, 1]², d the distance of its image plane.
        """
        width, height = self.size
        tan_x, tan_y = self.window.pitch_x * width / 2, self.window.pitch_y * height / 2
        return {
            "field_of_view": [degrees(2 * atan(tan_x)), degrees(2 * atan(tan_y))],
            "d": 1 / tan_x,
            "aspect": tan_y / tan_x,
        }
