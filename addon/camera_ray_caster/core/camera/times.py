"""Pixel times: the frame of each pixel as a function of its coordinates; see ``pixel_time``."""

from dataclasses import dataclass
from typing import Protocol, TypeVar

import numpy as np


@dataclass(frozen=True)
class LinearTime:
    """frame = origin + per_column x + per_row y, over the pixel coordinates of the full frame."""

    origin: float
    per_column: float
    per_row: float
    first: float
    """The earliest frame of a pixel center; ``last`` is the latest."""
    last: float
    tolerance: float
    """Allowed error, in pixels, of motion between evaluations of the scene."""
    max_evaluations: int
    """Maximum number of evaluations of the scene."""

    @property
    def span(self) -> tuple[float, float]:
        """The earliest and the latest frame within the picture, half a pixel beyond the outermost pixel centers."""
        margin = (abs(self.per_column) + abs(self.per_row)) / 2
        return self.first - margin, self.last + margin

    def frame_at(self, x, y):
        """Return the frame at pixel coordinates, in their broadcast shape or one that broadcasts to it."""
        if self.per_column == 0:
            return self.origin + self.per_row * y
        return self.origin + self.per_column * x


@dataclass(frozen=True)
class ImageTime:
    """The frame of every pixel of the full raster, (height, width); other fields as in ``LinearTime``."""

    frames: np.ndarray
    tolerance: float
    max_evaluations: int

    @property
    def first(self) -> float:
        """The earliest frame."""
        return float(self.frames.min())

    @property
    def last(self) -> float:
        """The latest frame."""
        return float(self.frames.max())

    @property
    def span(self) -> tuple[float, float]:
        """The earliest and the latest frame within the picture."""
        return self.first, self.last

    def frame_at(self, x, y):
        """Return the frame of the pixels that contain the coordinates; beyond the raster, that of the nearest pixel;
        NaN for coordinates that are NaN.
        """
        row, column = (
            np.nan_to_num(np.clip(np.floor(coordinate), 0, size - 1)).astype(int)
            for coordinate, size in zip((y, x), self.frames.shape, strict=True)
        )
        return np.where(np.isnan(x) | np.isnan(y), np.nan, self.frames[row, column])


@dataclass(frozen=True, eq=False)
class SweepTime:
    """The frames at which a scanner's beams fire: as LinearTime, plus what each row adds. The time is that of the
    pixel's middle along a row, and goes on beside it.
    """

    origin: float
    per_column: float
    rows: np.ndarray
    """(height,): frames that each row adds."""
    width: int
    tolerance: float
    max_evaluations: int

    @property
    def first(self) -> float:
        """The earliest frame of a pixel center."""
        return self.origin + self.per_column / 2 + float(self.rows.min())

    @property
    def last(self) -> float:
        """The latest frame of a pixel center."""
        return self.origin + self.per_column * (self.width - 0.5) + float(self.rows.max())

    @property
    def span(self) -> tuple[float, float]:
        """The earliest and the latest frame within the picture, half a pixel beyond the outermost pixel centers."""
        return self.first - self.per_column / 2, self.last + self.per_column / 2

    def frame_at(self, x, y):
        """Return the frame at pixel coordinates, in their broadcast shape; NaN for coordinates that are NaN."""
        row = np.nan_to_num(np.clip(np.floor(y), 0, len(self.rows) - 1)).astype(int)
        return self.origin + self.per_column * x + np.where(np.isnan(y), np.nan, self.rows[row])


PixelTime = LinearTime | ImageTime | SweepTime


OneTime = TypeVar("OneTime", covariant=True)
"""The type of the cameras at one time."""


class MovingCamera(Protocol[OneTime]):
    """An object that returns the camera of a scene at any frame, such as ``Motion``."""

    @property
    def is_still(self) -> bool:
        """Whether neither the camera nor the shapes move."""

    @property
    def camera_is_still(self) -> bool:
        """Whether the camera has the same model and pose at all frames."""

    @property
    def cuts(self) -> tuple[float, ...]:
        """The frames at which motion may change abruptly."""

    def camera_at(self, frame: float) -> OneTime:
        """Return the camera at a frame, without its pixel times."""

    def poses_at(self, frames: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
        """Return the eyes (n, 3) and bases (n, 3, 3) of the camera at frames (n,); None if its model changes."""

    def in_words(self) -> list[str]:
        """Return lines for the report on the accuracy of the motion."""
