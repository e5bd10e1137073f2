"""The orthographic camera: Blender's ORTHO, a parallel projection.

Assumption: all rays are parallel to the viewing direction w and leave the camera's plane z = 0.
Formula: origin (X, Y, 0), direction (0, 0, -1); the fitted side of the frame is ortho_scale long. Over [-1, 1]^2 the
same is often written as origin = e + x size u + y size v.
Reference: Blender manual, Cameras; measured against Camera.calc_matrix_camera.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..conventions import gamma
from ..records import BlenderCamera, Raster
from .model import Step, WindowModel
from .parts.film import FILM, ORTHO_SCALE, Window, off_axis
from .parts.silhouette import pixel_bounds

PLANE = (
    Step("Pixel on the camera's plane", "X = (x - W/2 + shift_x V) q, Y = ((y - H/2) p + shift_y V) q"),
    Step("Pixel width on the plane (V: pixels along the fitted side; p: pixel height / width)", "q = ortho_scale / V"),
)
"""The first steps of models with an orthographic frame."""


@dataclass(frozen=True)
class Orthographic(WindowModel):
    """A camera with parallel rays along -Z; its window lies on z = 0, in Blender units."""

    key = "ORTHO"
    label = "Orthographic"
    description = "Parallel rays: no foreshortening, no vanishing point"
    group = "Blender's Own"
    planar = True
    straight = True
    central = False
    parallel = True
    ray_rounding = gamma(2)
    SETTINGS = (ORTHO_SCALE, *FILM)
    FORMULA = (
        *PLANE,
        Step("Origin", "o = eye + X u + Y v"),
        Step("Direction, the same for all", "r = w"),
        Step(
            "Normalized form over [-1, 1]², moved by the shift; size is half the frame's width",
            "o = e + x size u + aspect y size v, size = W q / 2, aspect = p H / W",
        ),
    )

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Orthographic:
        return cls(raster.size, Window.from_blender(raw, raster, ORTHO_SCALE.read(raw)))

    @classmethod
    def off_axis(cls, raw: BlenderCamera, slope: float) -> BlenderCamera:
        """See Model: as Blender does, with the lens that these cameras do not use otherwise."""
        return off_axis(raw, slope)

    def rays(self, x, y):
        """See Model. The origin is right to gamma(3) of the sum of its parts' magnitudes, the direction is exact."""
        return (*self.window.plane_from_pixels(x, y), 0.0), (0.0, 0.0, -1.0)

    def project(self, points):
        """Return the pixel coordinates (..., 2) of camera-frame points (..., 3), also of points behind."""
        return np.stack(self.window.pixels_from_plane(points[..., 0], points[..., 1]), axis=-1)

    def bounds(self, centers, radii):
        x, y = centers[:, 0], centers[:, 1]
        behind = centers[:, 2] - radii > 0
        radii = np.where(behind, np.nan, radii)
        return pixel_bounds(self.window, (x - radii, x + radii), (y - radii, y + radii))

    def facts(self) -> dict[str, object]:
        """Return the width and height of the frame in Blender units."""
        width, height = self.size
        return {"frame": [width * self.window.pitch_x, height * self.window.pitch_y]}
