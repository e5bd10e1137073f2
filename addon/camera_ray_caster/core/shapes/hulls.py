"""Convex hulls of points, such as triangles and boxes: the pixels in which they may be seen, and their least t."""

import numpy as np

from ..maths.speed import taken
from .kind import PixelBounds
from .shape_frames import BOUNDS_FACTOR


class HullPoints:
    """Points in the camera's frame whose hulls are bounded by their images, or by balls if a line may look curved."""

    def __init__(self, pixels: PixelBounds, count: int):
        self.places = np.empty((3, count))
        self._pixels = pixels
        self._type = np.int16 if pixels.whole.max() < 2**15 else np.int32
        self._images = np.empty((count, 4), self._type) if pixels.has_straight_lines else None

    @property
    def _unknown(self) -> int:
        """Marks the x0 of a point without an image."""
        return np.iinfo(self._type).min

    def write(self, at: slice | np.ndarray, places: np.ndarray) -> None:
        """Write the places, (3, m), of some points, which may be given by index, and their images."""
        self.places[:, at] = places
        if self._images is None:
            return
        images = np.empty((places.shape[1], 4), self._type)
        others = np.flatnonzero(~self._pixels.of_points(places.T, images))
        images[others] = self._pixels.whole
        _turn_ends(images)  # the bounds of a hull are the minima over its corners then
        images[others, 0] = self._unknown
        self._images[at] = images

    def at(self, corners: np.ndarray) -> np.ndarray:
        """Return the places of the corners, (c, 3, k): corner, component."""
        return self.places.take(corners, axis=1).swapaxes(0, 1)

    def hulls(self, corners: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the pixel bounds of hulls, (k, 4), lower bounds of their t, (k,), and their indices, (k,): those that
        some pixel may see, among the hulls with the corners given, (c, n) indices of points.
        """
        if self._images is None:
            return self._in_balls(corners)
        least = self._images.take(corners[0], axis=0)
        for corner in corners[1:]:
            np.minimum(least, self._images.take(corner, axis=0), out=least)
        seen = np.flatnonzero((least[:, 0] < -least[:, 1]) & (least[:, 2] < -least[:, 3]))
        bounds, corners = least.take(seen, axis=0), corners.take(seen, axis=1)
        _turn_ends(bounds)
        near = -np.maximum.reduce([taken(self.places[2], corner) for corner in corners])
        unknown = bounds[:, 0] == self._unknown
        if not unknown.any():
            return bounds, near, seen
        known, unknown = np.flatnonzero(~unknown), np.flatnonzero(unknown)
        ball_bounds, ball_near, in_balls = self._in_balls(corners[:, unknown])
        position = np.concatenate((known, unknown[in_balls]))
        order = np.argsort(position)
        bounds, near = np.concatenate((bounds[known], ball_bounds)), np.concatenate((near[known], ball_near))
        return bounds[order], near[order], seen[position[order]]

    def _in_balls(self, corners: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the same as ``hulls``, from balls around the corners."""
        places = self.at(corners)
        low, high = np.minimum.reduce(places), np.maximum.reduce(places)
        middle = low / 2 + high / 2
        radius = BOUNDS_FACTOR * np.sqrt(np.maximum.reduce([((corner - middle) ** 2).sum(axis=0) for corner in places]))
        bounds, seen = self._pixels.of_balls(middle.T, radius)
        at = np.flatnonzero(seen)
        return bounds[at].astype(self._type), self._pixels.least_t(middle.T, radius)[at], at


def _turn_ends(bounds: np.ndarray) -> None:
    """Turn x0, x1, y0, y1 into x0, -x1, y0, -y1 or back, in place."""
    for column in bounds.T[1::2]:
        np.negative(column, out=column)
