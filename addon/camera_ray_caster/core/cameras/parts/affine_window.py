"""A window whose axes are not the pixels' axes: for a skewed camera matrix, or a sensor that is tilted slightly."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .film import Window


@dataclass(frozen=True)
class AffineWindow(Window):
    """X = dx pitch_x + dy shear_x, Y = dx shear_y + dy pitch_y, with (dx, dy) the pixel's offset from the center.

    X and Y are right to gamma(3) of the sum of the magnitudes of their two terms. The determinant must not be 0.
    """

    shear_x: float
    shear_y: float

    @cached_property
    def _inverse(self) -> tuple[float, float, float, float]:
        """Return the derivatives of dx by X, dx by Y, dy by X and dy by Y."""
        volume = self.pitch_x * self.pitch_y - self.shear_x * self.shear_y
        return self.pitch_y / volume, -self.shear_x / volume, -self.shear_y / volume, self.pitch_x / volume

    def plane_from_pixels(self, x, y):
        across, up = x - self.center_x, y - self.center_y
        return across * self.pitch_x + up * self.shear_x, across * self.shear_y + up * self.pitch_y

    def pixels_from_plane(self, plane_x, plane_y):
        xx, xy, yx, yy = self._inverse
        return plane_x * xx + plane_y * xy + self.center_x, plane_x * yx + plane_y * yy + self.center_y

    def pixel_intervals(self, interval_x, interval_y):
        xx, xy, yx, yy = self._inverse
        terms = (_times(interval_x, xx), _times(interval_y, xy)), (_times(interval_x, yx), _times(interval_y, yy))
        return tuple(
            (center + from_x[0] + from_y[0], center + from_x[1] + from_y[1])
            for center, (from_x, from_y) in zip((self.center_x, self.center_y), terms, strict=True)
        )

    def rounding(self, x, y, frame):
        xx, xy, yx, yy = (abs(entry) for entry in self._inverse)
        across, up = (shift * 4 / 3 for shift in super().rounding(x, y, frame))  # of eight operations, not six
        plane_x = across * abs(self.pitch_x) + up * abs(self.shear_x)
        plane_y = across * abs(self.shear_y) + up * abs(self.pitch_y)
        return plane_x * xx + plane_y * xy, plane_x * yx + plane_y * yy

    def matrix(self, height: int) -> np.ndarray:
        xx, xy, yx, yy = self._inverse
        return np.array([
            [xx, -xy, self.center_x - 0.5],
            [-yx, yy, height - self.center_y - 0.5],
            [0.0, 0.0, 1.0],
        ])  # fmt: skip


def _times(interval, factor: float):
    """Return an interval times a number; an infinite end times 0 is 0."""
    low, high = (end * factor if factor else np.where(np.isnan(end), np.nan, 0.0) for end in interval)
    return np.minimum(low, high), np.maximum(low, high)
