"""Transposed and flipped pictures for Cycles, whose rolling shutter exposes rows only from the top down.

For pixels that are exposed in another order, by columns or from the bottom up, the shader gives Cycles the rays of a
transposed or flipped picture, and the result is turned back.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..camera.pixel_time import LinearTime
from ..records import Raster


@dataclass(frozen=True)
class Turn:
    """Transformation from Cycles' raster to ours: rows counted from the other end, then rows and columns swapped."""

    flipped: bool = False
    transposed: bool = False

    @classmethod
    def of(cls, time: LinearTime) -> Turn:
        """Return the turn with which Cycles' order from the top row down gives the pixels the times of a clock."""
        return cls(flipped=time.per_column + time.per_row > 0, transposed=time.per_column != 0)

    @property
    def places(self) -> tuple[str, str]:
        """OSL expressions for our place on the raster, (x, y) in 0 .. 1, in terms of Cycles' ``place``."""
        up = "1 - place[1]" if self.flipped else "place[1]"
        return (up, "place[0]") if self.transposed else ("place[0]", up)

    def raster(self, ours: Raster) -> Raster:
        """Return Cycles' frame with the render window that corresponds to ours."""
        width, height, x0, y0, x1, y1 = ours.width, ours.height, ours.x0, ours.y0, ours.x1, ours.y1
        if self.transposed:
            width, height, x0, y0, x1, y1 = height, width, y0, x0, y1, x1
        if self.flipped:
            y0, y1 = height - y1, height - y0
        return Raster(width, height, ours.pixel_aspect, x0, y0, x1, y1)

    def back(self, pixels: np.ndarray) -> np.ndarray:
        """Return the picture that Cycles has rendered, turned back to ours, (rows, columns, ...)."""
        pixels = pixels[::-1] if self.flipped else pixels
        return pixels.swapaxes(0, 1) if self.transposed else pixels


UPRIGHT = Turn()


def shutter_of(time: LinearTime, raster: Raster) -> tuple[float, float]:
    """Return the frame at which Cycles' rolling shutter must open, and the number of frames for which it stays open.

    raster: ours. Cycles exposes row j of H, from the bottom, at the fraction (H - j) / H: by row, not by row center.
    """
    rows = Turn.of(time).raster(raster).height
    slope = time.per_column + time.per_row
    bottom = time.origin + max(slope, 0.0) * rows  # the latest edge of the frame
    return bottom - abs(slope) * (rows + 0.5), abs(slope) * rows
