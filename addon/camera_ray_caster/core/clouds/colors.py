"""Colors of points, by their rings, ranges or labels: linear RGBA."""

import numpy as np

from .cloud import PointCloud

RING, RANGE, LABEL = "RING", "RANGE", "LABEL"
GOLDEN = 0.6180339887498949
"""Step of the hue from label to label: no two of few are alike."""


def colors_of(cloud: PointCloud, by: str) -> np.ndarray:
    """Return the colors of the points, (n, 4) float32: from blue for the lowest beam or the least range to red for the
    highest or the largest, or a color for each category. Ranges are shown by their logarithms: most are near.
    """
    if by == LABEL:
        return _hues(cloud.category * GOLDEN % 1.0)
    values = cloud.row.astype(float) if by == RING else np.log(cloud.range)
    span = np.ptp(values) if len(values) else 0.0
    return _hues((1 - (values - values.min(initial=np.inf)) / (span or 1.0)) * 2 / 3)


def _hues(hue: np.ndarray) -> np.ndarray:
    """Return fully saturated colors of hues from 0, red, to 1."""
    wheel = np.abs((hue[:, None] * 6 + np.array((0, 4, 2))) % 6 - 3) - 1  # red, green, blue around the circle
    return np.column_stack((np.clip(wheel, 0, 1), np.ones(len(hue)))).astype(np.float32)
