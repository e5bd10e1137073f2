"""A sensor that is tilted to the lens (Scheimpflug): a projective map of the picture, and its inverse.

With R = Ry(tau_y) Rx(tau_x), the rotation of the sensor about its x and then its y axis, the point (x, y, 1) of the
upright picture is R (x, y, 1) in the sensor's coordinates, and is projected onto the sensor along the axis:
    T = ((R33, 0, -R13), (0, R33, -R23), (0, 0, 1)) R,  (u, v) = (T1 . (x, y, 1), T2 . (x, y, 1)) / (T3 . (x, y, 1)).
A point has an image on the sensor if that denominator is positive.
Reference: OpenCV documentation, Camera Calibration and 3D Reconstruction (tau_x, tau_y).
"""

from dataclasses import dataclass
from functools import cached_property
from itertools import product

import numpy as np

from ...maths.recording import array, cos, sin
from ...maths.vector import inverse


@dataclass(frozen=True)
class Tilt:
    """Two angles, in radians, of less than 90 degrees; coordinates are OpenCV's, y down."""

    tau_x: float
    tau_y: float

    def __bool__(self) -> bool:
        """Whether the sensor is tilted at all."""
        return bool(self.tau_x or self.tau_y)

    @cached_property
    def rotation(self) -> np.ndarray:
        """R."""
        (cx, sx), (cy, sy) = ((cos(tau), sin(tau)) for tau in (self.tau_x, self.tau_y))
        return array([[cy, 0, -sy], [0, 1, 0], [sy, 0, cy]]) @ array([[1, 0, 0], [0, cx, sx], [0, -sx, cx]])

    @property
    def slopes(self) -> tuple[float, float]:
        """Return a, b such that the sensor meets the direction (x, y, 1) at the depth 1 / (1 + a x + b y), if it is at
        depth 1 on the axis.
        """
        return self.rotation[2, 0] / self.rotation[2, 2], self.rotation[2, 1] / self.rotation[2, 2]

    @cached_property
    def _matrix(self) -> np.ndarray:
        turn = self.rotation
        return array([[turn[2, 2], 0, -turn[0, 2]], [0, turn[2, 2], -turn[1, 2]], [0, 0, 1]]) @ turn

    @cached_property
    def _inverse(self) -> np.ndarray:
        return inverse(self._matrix)

    @property
    def columns(self) -> np.ndarray:
        """The columns, one a row, of the matrix that takes (u, v, 1) to a multiple of (x, y, 1)."""
        return self._inverse.T

    def onto_sensor(self, x, y):
        """Return (u, v) on the sensor of points of the upright picture; NaN for points without an image there."""
        return _mapped(self._matrix, x, y)

    def upright(self, u, v):
        """Return (x, y) in the upright picture of points of the sensor: the inverse of ``onto_sensor``."""
        return _mapped(self._inverse, u, v)

    def intervals(self, interval_x, interval_y):
        """Return the intervals in u and v that hold the images of all points of the intervals, (n,) each.

        They are those around the four corners' images, since the map keeps straight lines.
        """
        with np.errstate(invalid="ignore"):
            images = np.array([self.onto_sensor(x, y) for x, y in product(interval_x, interval_y)])
        return intervals_around(images, interval_x, interval_y)


def intervals_around(images, interval_x, interval_y):
    """Return the intervals around the images, (k, 2, n), of the corners of intervals, (n,) each: endless if a corner
    has no image. NaN, which means nowhere, stays NaN.
    """
    endless = np.isnan(images).any(axis=(0, 1)) & ~np.isnan(interval_x[0]) & ~np.isnan(interval_y[0])
    low, high = np.where(endless, -np.inf, images.min(axis=0)), np.where(endless, np.inf, images.max(axis=0))
    return (low[0], high[0]), (low[1], high[1])


def _mapped(matrix, x, y):
    first, second, below = (row[0] * x + row[1] * y + row[2] for row in matrix.tolist())
    below = np.where(below > 0, below, np.nan)
    return first / below, second / below
