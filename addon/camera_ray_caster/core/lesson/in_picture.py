"""Points and line segments of the world where a camera's picture shows them: through its model, within its frame."""

import numpy as np

from ..camera.camera import Camera

PIECES = 16
"""Number of straight pieces of a drawn segment: most models bend lines."""

JUMP = 0.25
"""Pieces longer than this fraction of the frame's longer side are left out: they cross a seam, such as the one behind a
panorama, where the picture goes on at its other edge.
"""


def points_in_picture(camera: Camera, points) -> np.ndarray:
    """Return the pixel coordinates (m, 2), float64, of those of the world points (n, 3) that lie in the frame."""
    pixels = camera.project(np.asarray(points, np.float64).reshape(-1, 3))
    return pixels[((pixels >= 0) & (pixels <= camera.raster.size)).all(axis=1)]


def lines_in_picture(camera: Camera, segments) -> np.ndarray:
    """Return pieces (m, 2, 2), in pixel coordinates, of world segments (n, 2, 3), as far as they lie in the frame."""
    segments = np.asarray(segments, np.float64).reshape(-1, 2, 3)
    along = np.linspace(0.0, 1.0, PIECES + 1)[:, None]
    places = camera.project(segments[:, None, 0] + along * (segments[:, None, 1] - segments[:, None, 0]))
    pieces = np.stack((places[:, :-1], places[:, 1:]), axis=2).reshape(-1, 2, 2)
    pieces = pieces[np.isfinite(pieces).all(axis=(1, 2))]
    longest = np.abs(pieces[:, 1] - pieces[:, 0]).max(axis=1)
    return _clipped(pieces[longest <= JUMP * max(camera.raster.size)], camera.raster.size)


def _clipped(pieces: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """Return the parts of pieces (n, 2, 2) within the frame; those wholly outside are left out.

    Reference: Y.-D. Liang and B. A. Barsky, A New Concept and Method for Line Clipping, 1984.
    """
    start, way = pieces[:, 0], pieces[:, 1] - pieces[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        crossings = np.stack((-start / way, (np.array(size) - start) / way))
    outside = (way == 0) & ((start < 0) | (start > size))
    enter = np.where(way == 0, np.where(outside, np.inf, -np.inf), crossings.min(axis=0)).max(axis=1).clip(min=0.0)
    leave = np.where(way == 0, np.inf, crossings.max(axis=0)).min(axis=1).clip(max=1.0)
    seen = enter <= leave
    start, way = start[seen, None], way[seen, None]
    return start + np.stack((enter[seen], leave[seen]), axis=1)[..., None] * way
