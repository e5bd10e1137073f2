"""The cross-slit camera: all rays meet two slits.

A pixel's ray passes through its point on the perspective window, at unit depth before the camera, and meets both slits.
It is the intersection of the two planes through that point and each slit, so its direction is the cross product of
their normals. A point of the scene is projected along the intersection of the planes through it and each slit onto the
window. Rays start on the camera's plane z = 0.
If the slits meet, the camera is the pinhole at that point. Slits parallel to the image plane give a general linear
camera.
Singular: points on a slit; a plane through one slit that is parallel to the other; the planes z = 0 and the window's
where a slit crosses them.
Reference: A. Zomet, D. Feldman, S. Peleg and D. Weinshall, Mosaicing New Views: The Crossed-Slits Projection, PAMI 25
(2003).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..conventions import gamma
from ..maths.intervals import Interval
from ..maths.vector import components, cross, difference, dot, norm
from ..records import BlenderCamera, InputError, Raster
from .model import IN_RAYS, Step, WindowModel
from .parts.lines import LINE_ROUNDING, SECOND_SLIT, SLIT, slit_from
from .parts.silhouette import pinhole_interval, pixel_bounds
from .perspective import Perspective

MIDDLE = np.array((0.0, 0.0, -1.0))
"""Middle of the window's plane."""


@dataclass(frozen=True)
class CrossSlit(WindowModel):
    """Two slits, each given by its point nearest to the window's middle and a unit direction, camera frame."""

    slits: tuple[tuple[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]
    farthest: float
    """Distance of the farthest point that gives a slit: the points above are right to some EPS of it."""

    key = "CROSS_SLIT"
    label = "Cross-Slit"
    description = "Every ray meets two slits: objects of the scene"
    group = "Multiperspective"
    number = 11
    central = False
    polynomials = IN_RAYS
    ray_rounding = gamma(4)
    SETTINGS = (SLIT, SECOND_SLIT, *Perspective.SETTINGS)
    FORMULA = (
        Step("Point on the perspective window", "P = (X, Y, -1)"),
        Step(
            "Normals of the planes through P and each slit (point s, direction l)",
            "n_1 = l_1 × (P - s_1), n_2 = l_2 × (P - s_2)",
        ),
        Step("Direction, ahead", "m = n_1 × n_2, r = -m / m_z"),
        Step("Origin, on the camera's plane", "o = P - r"),
    )

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> CrossSlit:
        """See Model. Slits that are parallel, or in the window's plane, determine no ray and are refused."""
        slits, farthest = [], 0.0
        for slit in (SLIT, SECOND_SLIT):
            point, direction = slit_from(raw, slit)
            farthest = max(farthest, float(np.linalg.norm(point)))
            point = point + direction * ((MIDDLE - point) @ direction)  # small numbers keep the digits
            if max(abs(direction[2]), abs(point[2] + 1)) <= LINE_ROUNDING:
                raise InputError(
                    f"{slit.name} of camera {raw.name!r} lies in the picture's own plane, at depth {-point[2]:.6g}: it "
                    "must be nearer or farther than depth 1, or not parallel to the picture"
                )
            slits.append((point, direction))
        first, second = slits
        if np.linalg.norm(np.cross(first[1], second[1])) <= LINE_ROUNDING:
            raise InputError(f"slit_1 and slit_2 of camera {raw.name!r} are parallel: turn one of them")
        return cls(raster.size, Perspective.from_blender(raw, raster).window, (first, second), farthest)

    @property
    def formula_reach(self) -> float:
        return self.farthest

    def formula_values(self, x, y):
        """See Model: the pixel's point on the window, and the slits."""
        points = {f"s_{i}": point for i, (point, _) in enumerate(self.slits, 1)}
        directions = {f"l_{i}": direction for i, (_, direction) in enumerate(self.slits, 1)}
        return points | directions | dict(zip("XY", self.window.plane_from_pixels(x, y), strict=True))

    def rays(self, x, y):
        """See Model. NaN if the ray would be parallel to the image plane, or the pixel's point lies on a slit. Both are
        right to some EPS over the sine of the angle between the two planes.
        """
        plane_x, plane_y = self.window.plane_from_pixels(x, y)
        direction = cross(*self._normals((plane_x, plane_y, -1.0)))
        rise = np.where(direction[2] != 0, direction[2], np.nan)
        origin = plane_x + direction[0] / rise, plane_y + direction[1] / rise, 0.0
        scale = -np.sign(rise) / norm(direction)
        return origin, tuple(component * scale for component in direction)

    def formula_rounding(self, x, y):
        """See Model: the normals are rounded relative to the distances of the slits, their product is short where the
        planes are nearly one, and the origin is a difference. The slits are taken as they are in the camera's frame.
        """
        plane = *self.window.plane_from_pixels(x, y), -1.0
        first, second = self._normals(plane)
        direction = cross(first, second)
        size = norm(direction)
        away = norm(plane) + self.formula_reach
        turned = gamma(12) * away * (norm(first) + norm(second)) / np.where(size > 0, size, np.nan)
        slope = size / np.where(direction[2] != 0, direction[2], np.nan)
        return gamma(4) * norm(plane) + turned * slope * slope, turned

    def project(self, points):
        """Return the pixel coordinates (..., 2) of camera-frame points (..., 3); NaN on slits and behind z = 0."""
        point, planes = components(np.asarray(points, np.float64)), []
        for (start, (x, y, z)), turned in zip(self.slits, self._turned, strict=True):
            right, up, ahead = beside = difference(point, start)
            planes.append((y * ahead - z * up, z * right - x * ahead, dot(turned, beside)))
        across, up, scale = _crossing(*planes)
        scale = np.where((point[2] <= 0) & (scale != 0), scale, np.nan)
        return np.stack(self.window.pixels_from_plane(across / scale, up / scale), axis=-1)

    def bounds(self, centers, radii):
        """See Model. Along a slit, two planes through it that touch a sphere are tangents from a point to a disc."""
        normals = []
        for point, direction in self.slits:
            across, ahead = _axes_about(direction)
            beside = centers - point
            rise, depth = beside @ across, beside @ ahead
            side = np.where(depth < 0, -1.0, 1.0)  # a plane continues behind its slit
            tangent = Interval(*pinhole_interval(side * rise, side * depth, radii, through=True))
            normals.append(tuple(a - tangent * b for a, b in zip(across.tolist(), ahead.tolist(), strict=True)))
        planes = zip(normals, self.slits, strict=True)
        across, up, scale = _crossing(*((n[0], n[1], dot(n, start - MIDDLE)) for n, (start, _) in planes))
        x, y = across / scale, up / scale
        bounds = pixel_bounds(self.window, (x.low, x.high), (y.low, y.high))
        bounds[centers[:, 2] > radii] = np.nan
        return bounds

    def _normals(self, point):
        """Return the normals of the planes through a point and each slit."""
        return (cross(direction, difference(point, start)) for start, direction in self.slits)

    @cached_property
    def _turned(self) -> list[np.ndarray]:
        """Return vectors whose product with b is that of the plane's normal, l x b, and the slit's place."""
        return [np.cross(start - MIDDLE, direction) for start, direction in self.slits]


def _crossing(first, second):
    """Return s X, s Y and s of the point (X, Y) where planes a X + b Y = e, of numbers or intervals, intersect."""
    (a, b, e), (c, d, f) = first, second
    return e * d - f * b, f * a - e * c, a * d - b * c


def _axes_about(direction):
    """Return two unit vectors perpendicular to a direction: the first in the image plane, the second pointing ahead."""
    across = np.array((-direction[1], direction[0], 0.0))
    length = np.linalg.norm(across)
    across = across / length if length > LINE_ROUNDING else np.array((1.0, 0.0, 0.0))
    ahead = np.cross(across, direction)
    return across, ahead / np.linalg.norm(ahead)
