"""Points of an aperture from each of which a picture is a warp of faces; their mean has the camera's depth of field.

A planar camera has the points of its aperture. Any other has an aperture perpendicular to each pixel's chief ray, so
that no disc would do: its points fill a ball with the density 1 / sqrt(radius^2 - r^2), which, seen from any side, is a
disc of uniform density. The ray of every point passes through the point of focus of the chief ray, as in a cast.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..camera.camera import Camera
from ..cameras.model import Model

SEQUENCE_STEPS = 0.8191725133961645, 0.6710436067037893, 0.5497004779019703
"""Powers of the root of x^4 = x + 1: steps of a sequence that fills a cube evenly (M. Roberts, 2018)."""


@dataclass(frozen=True)
class LensPoint:
    """A point of an aperture, in the frame of the faces."""

    position: tuple[float, float, float]
    focus: float
    """Distance of the surface of focus; of a planar camera its depth."""
    is_planar: bool

    def directions(self, chief: np.ndarray) -> np.ndarray:
        """Return the unit directions (..., 3) of the rays through this point for unit directions of chief rays."""
        ahead = chief / -chief[..., 2:] if self.is_planar else chief
        there = ahead * self.focus - np.array(self.position)
        return there / np.linalg.norm(there, axis=-1, keepdims=True)


def lens_points(camera: Camera, count: int) -> tuple[LensPoint, ...]:
    """Return points that fill the aperture of a camera. A panorama's are those of a disc of its radius."""
    aperture: Any = camera.aperture
    is_planar = camera.model.planar
    u, v, w = np.mod(0.5 + np.outer(SEQUENCE_STEPS, np.arange(1, count + 1)), 1.0)
    if is_planar:
        x, y = aperture.points(u, v)
        z = np.zeros(count)
    else:
        # the share of the ball's points within r is (2 / pi) (a - sin a cos a) with r = radius sin a
        angles = np.linspace(0, np.pi / 2, 4097)
        radius = aperture.radius * np.sin(np.interp(u, (angles - np.sin(2 * angles) / 2) * 2 / np.pi, angles))
        z, turn = 2 * v - 1, 2 * np.pi * w
        x, y, z = radius * np.sqrt(1 - z * z) * np.cos(turn), radius * np.sqrt(1 - z * z) * np.sin(turn), radius * z
    places = zip(x.tolist(), y.tolist(), z.tolist(), strict=True)
    return tuple(LensPoint(position, aperture.focus, is_planar) for position in places)


def blur_refusal(camera: Camera) -> str:
    """Return why points of an aperture do not give a camera's depth of field; "" if they do."""
    aperture: Any = camera.aperture
    if aperture.is_hole or not np.isfinite(aperture.focus) or type(camera.model).through is not Model.through:
        return f"{camera.model.label} has rays of its own through its aperture"
    if aperture.tilt:
        return "the sensor is tilted"
    return "" if camera.model.planar or (aperture.blades < 3 and aperture.ratio == 1) else "its aperture is no disc"
